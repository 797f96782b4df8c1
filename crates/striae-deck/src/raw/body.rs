//! `[[body]]` and `[[rigid]]`.

use super::{
    super::declare::{either, table, words},
    ElementSet, FacetSet, Mesh, NodeSet,
};
use crate::{
    read::At,
    value::{Number, Positive, Text, Whole},
};

table! {
    /// A deformable body.
    Body {
        /// Unique name.
        required name: Text,
        /// Name of its material outside of sections. Default: none; then every element must be in a
        /// section.
        optional material: Text,
        /// Its mesh, read from a file or generated.
        required mesh: Mesh,
        /// Parts of other materials.
        optional sections: Vec<At<BodySection>>,
        /// Formulation of its elements, except in sections with one of their own. Default: the one
        /// that elements of Abaqus with an `H` (`mean-dilatation`) or `I` (`assumed-strain`)
        /// request, `mean-dilatation` if Poisson's ratio is above 0.45 or the material yields,
        /// else `standard`.
        optional formulation: Formulation,
        /// Mass of the nodes of its contact surfaces in dynamic steps. Default: `consistent`.
        optional contact_mass: ContactMass,
        /// Additional sets of nodes.
        optional node_sets: Vec<At<NodeSet>>,
        /// Additional sets of facets.
        optional facet_sets: Vec<At<FacetSet>>,
        /// Additional sets of elements.
        optional element_sets: Vec<At<ElementSet>>,
    }
}

table! {
    /// Elements of a body with their own material.
    BodySection {
        /// Name of the element set; no element is in two sections.
        required elements: Text,
        /// Name of their material.
        required material: Text,
        /// Formulation of these elements. Default: that of the body if it states one, else the one
        /// that elements of Abaqus with an `H` or `I` request, else the one that suits their
        /// material, as for bodies.
        optional formulation: Formulation,
    }
}

words! {
    /// Formulation of elements.
    Formulation {
        /// Displacements alone; locks if the material is nearly incompressible.
        Standard = "standard",
        /// Pressure and volume constant in the element; linear tetrahedra lock even so.
        MeanDilatation = "mean-dilatation",
        /// Deformation gradient of hexahedra enhanced for bending; other elements as `standard`.
        AssumedStrain = "assumed-strain",
    }
}

words! {
    /// Mass of the nodes of contact surfaces.
    ContactMass {
        /// Mass from the consistent mass matrix.
        Consistent = "consistent",
        /// No mass: it is moved to the nodes behind, to avoid oscillations of contact.
        Redistributed = "redistributed",
    }
}

table! {
    /// A rigid body: a surface to touch, or a body that nodes are tied to.
    Rigid {
        /// Unique name.
        required name: Text,
        /// Its shape.
        include shape: RigidShape,
        /// Point about which it rotates, and centre of a given `mass`. Default: the centre of mass
        /// with `density`, else the origin.
        optional reference: [Number; 3],
        /// Density of the solid inside a closed `mesh`, from which mass, centre and moments of inertia follow. Default: none.
        optional density: Positive,
        /// Mass; needs `inertia`. Default: none.
        optional mass: Positive,
        /// Principal moments of inertia about the coordinate axes through the reference point; needs `mass`.
        optional inertia: [Positive; 3],
    }
}

either! {
    /// Shape of a rigid surface.
    RigidShape {
        Plane(RigidPlane),
        Mesh(RigidMesh),
        Tied(RigidTied),
    }
}

table! {
    /// An unbounded plane.
    RigidPlane {
        /// The plane, given by a point and its normal.
        required plane: Plane,
    }
}

table! {
    /// Nodes that follow the body.
    RigidTied {
        /// Sets of nodes that are tied to it.
        required tied: Vec<At<Tie>>,
    }
}

table! {
    /// Nodes of a deformable body.
    Tie {
        /// Name of the body.
        required body: Text,
        /// Name of its node set.
        required nodes: Text,
    }
}

table! {
    /// A point and a normal.
    Plane {
        /// A point of the plane.
        required point: [Number; 3],
        /// Normal of any length, out of the rigid half space.
        required normal: [Number; 3],
    }
}

table! {
    /// A surface of triangles and quadrilaterals.
    RigidMesh {
        /// Its facets, outward by the right-hand rule.
        required mesh: SurfaceMesh,
    }
}

either! {
    /// A surface mesh.
    SurfaceMesh {
        File(super::MeshFile),
        Inline(InlineSurface),
    }
}

table! {
    /// A surface mesh written in the deck.
    InlineSurface {
        /// Positions of the nodes.
        required positions: Vec<At<[Number; 3]>>,
        /// Nodes of the facets, counted from 0, outward by the right-hand rule; a triangle repeats its last node.
        required facets: Vec<At<[Whole<0>; 4]>>,
    }
}
