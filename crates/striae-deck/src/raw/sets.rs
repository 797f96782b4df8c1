//! `node_sets`, `facet_sets` and `element_sets` of a body.

use crate::{
    declare::{either, table},
    read::At,
    value::{All, Number, Text, Whole},
};

table! {
    /// A set of nodes besides those of the mesh.
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
        Common(CommonNodes),
        Union(SetUnion),
        Box(NodesInBox),
        Listed(ListedNodes),
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
    /// The nodes that several sets have in common.
    CommonNodes {
        /// Names of the sets, of the mesh or made before this one.
        required common: Vec<At<Text>>,
    }
}

table! {
    /// The members of several sets together.
    SetUnion {
        /// Names of the sets, of the mesh or made before this one.
        required union: Vec<At<Text>>,
    }
}

table! {
    /// The nodes in a box along the axes.
    NodesInBox {
        /// Corner of smallest coordinates.
        required from: [Number; 3],
        /// Corner of largest coordinates.
        required to: [Number; 3],
    }
}

table! {
    /// Nodes by number.
    ListedNodes {
        /// Numbers of the nodes, counted from 0 in the order of the mesh.
        required numbers: All<Whole<0>>,
    }
}

table! {
    /// A set of facets besides those of the mesh.
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
        Box(FacetsInBox),
        Listed(ListedFacets),
    }
}

table! {
    /// The facets of a set that lie in a box along the axes with all their corners.
    FacetsInBox {
        /// Name of the set.
        required of: Text,
        /// Corner of smallest coordinates.
        required from: [Number; 3],
        /// Corner of largest coordinates.
        required to: [Number; 3],
    }
}

table! {
    /// Sides of elements by number.
    ListedFacets {
        /// Element and side of each facet, counted from 0; sides in the order of Abaqus.
        required sides: Vec<At<[Whole<0>; 2]>>,
    }
}

table! {
    /// A set of elements besides those of the mesh.
    ElementSet {
        /// Name that no other element set of the body has.
        required name: Text,
        /// Its members.
        include members: ElementMembers,
    }
}

either! {
    /// Members of an element set.
    ElementMembers {
        Union(SetUnion),
        Box(ElementsInBox),
        Listed(ListedElements),
    }
}

table! {
    /// The elements that lie in a box along the axes with all their corners.
    ElementsInBox {
        /// Corner of smallest coordinates.
        required from: [Number; 3],
        /// Corner of largest coordinates.
        required to: [Number; 3],
    }
}

table! {
    /// Elements by number.
    ListedElements {
        /// Numbers of the elements, counted from 0 in the order of the mesh.
        required numbers: All<Whole<0>>,
    }
}
