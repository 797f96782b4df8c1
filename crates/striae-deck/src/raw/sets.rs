//! `node_sets`, `facet_sets` and `element_sets` of a body.

use crate::{
    declare::{either, table},
    read::At,
    value::{All, HalfTurn, Number, Positive, Text, Whole},
};

table! {
    /// A set of nodes in addition to those of the mesh.
    NodeSet {
        /// Name that no other node set of the body has.
        required name: Text,
        /// Its members.
        include members: NodeMembers,
    }
}

either! {
    /// Members of a node set.
    NodeMembers {
        Nearest(NearestNode),
        Common(CommonMembers),
        Union(SetUnion),
        Box(InBox),
        Sphere(InSphere),
        Cylinder(InCylinder),
        HalfSpace(InHalfSpace),
        Facets(OfFacets),
        Elements(OfElements),
        Border(OfBorder),
        Listed(ListedNumbers),
    }
}

table! {
    /// A set of elements in addition to those of the mesh.
    ElementSet {
        /// Name that no other element set of the body has.
        required name: Text,
        /// Its members.
        include members: ElementMembers,
    }
}

either! {
    /// Members of an element set; regions contain elements with all their corners.
    ElementMembers {
        Common(CommonMembers),
        Union(SetUnion),
        Box(InBox),
        Sphere(InSphere),
        Cylinder(InCylinder),
        HalfSpace(InHalfSpace),
        Nodes(OfNodes),
        Facets(OfFacets),
        Listed(ListedNumbers),
    }
}

table! {
    /// The node nearest to a place.
    NearestNode {
        /// The place.
        required nearest: [Number; 3],
    }
}

table! {
    /// Common members of several sets.
    CommonMembers {
        /// Names of the sets, of the mesh or of the deck.
        required common: Vec<At<Text>>,
    }
}

table! {
    /// Union of several sets.
    SetUnion {
        /// Names of the sets, of the mesh or of the deck.
        required union: Vec<At<Text>>,
    }
}

table! {
    /// Members in a box along the axes.
    InBox {
        /// Corner of smallest coordinates.
        required from: [Number; 3],
        /// Corner of largest coordinates.
        required to: [Number; 3],
    }
}

table! {
    /// Members in a ball.
    InSphere {
        /// The ball.
        required sphere: Sphere,
    }
}

table! {
    /// A ball.
    Sphere {
        /// Its centre.
        required centre: [Number; 3],
        /// Its radius.
        required radius: Positive,
    }
}

table! {
    /// Members in a cylinder.
    InCylinder {
        /// The cylinder, without ends.
        required cylinder: Cylinder,
    }
}

table! {
    /// A round cylinder without ends.
    Cylinder {
        /// A point of its axis.
        required point: [Number; 3],
        /// Its axis, of any length.
        required axis: [Number; 3],
        /// Its radius.
        required radius: Positive,
    }
}

table! {
    /// Members on one side of a plane.
    InHalfSpace {
        /// The half space.
        required half_space: HalfSpace,
    }
}

table! {
    /// Region on one side of a plane.
    HalfSpace {
        /// A point of the plane.
        required point: [Number; 3],
        /// Normal of any length, out of the half space.
        required normal: [Number; 3],
    }
}

table! {
    /// Nodes or elements of facets.
    OfFacets {
        /// Name of the facet set.
        required facets: Text,
    }
}

table! {
    /// Nodes of elements.
    OfElements {
        /// Name of the element set.
        required elements: Text,
    }
}

table! {
    /// Facets or elements with all corners in a set of nodes.
    OfNodes {
        /// Name of the node set.
        required nodes: Text,
    }
}

table! {
    /// Border between the elements of a set and everything else: nodes, or facets on the boundary of the body.
    OfBorder {
        /// Name of the element set.
        required border: Text,
    }
}

table! {
    /// Nodes or elements by number.
    ListedNumbers {
        /// Numbers, counted from 0 in the order of the mesh.
        required numbers: All<Whole<0>>,
    }
}

table! {
    /// A set of facets in addition to those of the mesh.
    FacetSet {
        /// Name that no other facet set of the body has.
        required name: Text,
        /// Its members.
        include members: FacetMembers,
    }
}

either! {
    /// Members of a facet set.
    FacetMembers {
        Union(SetUnion),
        Common(CommonMembers),
        Box(FacetsInBox),
        Sphere(FacetsInSphere),
        Cylinder(FacetsInCylinder),
        HalfSpace(FacetsInHalfSpace),
        Direction(FacetsAlong),
        Around(FacetsAround),
        Nodes(OfNodes),
        Border(OfBorder),
        Listed(ListedFacets),
    }
}

table! {
    /// The facets of a set with all corners in a box along the axes.
    FacetsInBox {
        /// Name of the set. Default: `all`.
        optional of: Text,
        /// Corner of smallest coordinates.
        required from: [Number; 3],
        /// Corner of largest coordinates.
        required to: [Number; 3],
    }
}

table! {
    /// The facets of a set with all corners in a ball.
    FacetsInSphere {
        /// Name of the set. Default: `all`.
        optional of: Text,
        /// The ball.
        required sphere: Sphere,
    }
}

table! {
    /// The facets of a set with all corners in a cylinder.
    FacetsInCylinder {
        /// Name of the set. Default: `all`.
        optional of: Text,
        /// The cylinder, without ends.
        required cylinder: Cylinder,
    }
}

table! {
    /// The facets of a set with all corners on one side of a plane.
    FacetsInHalfSpace {
        /// Name of the set. Default: `all`.
        optional of: Text,
        /// The half space.
        required half_space: HalfSpace,
    }
}

table! {
    /// The facets of a set that face a direction.
    FacetsAlong {
        /// Name of the set. Default: `all`.
        optional of: Text,
        /// The direction, of any length.
        required direction: [Number; 3],
        /// Largest angle in degrees between it and the outward normal.
        required angle: HalfTurn,
    }
}

table! {
    /// The facets of a set that can be reached from the one nearest to a place without crossing a sharp edge.
    FacetsAround {
        /// Name of the set. Default: `all`.
        optional of: Text,
        /// The place.
        required around: [Number; 3],
        /// Largest angle in degrees between the normals on the two sides of an edge that is
        /// crossed.
        required feature_angle: HalfTurn,
    }
}

table! {
    /// Sides of elements by number.
    ListedFacets {
        /// Element and side of each facet, counted from 0; sides in the order of Abaqus.
        required sides: Vec<At<[Whole<0>; 2]>>,
    }
}
