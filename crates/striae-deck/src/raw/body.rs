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
        /// Name of its material, where no section is. Default: none; then every element must be in a section.
        optional material: Text,
        /// Its mesh, read from a file or generated.
        required mesh: Mesh,
        /// Parts of other materials.
        optional sections: Vec<At<BodySection>>,
        /// How its elements, but for those of sections, take up strain. Default: what elements of Abaqus with an `H` (`mean-dilatation`) or `I` (`assumed-strain`) ask for, `mean-dilatation` where Poisson's ratio is above 0.45 or the material yields, else `standard`.
        optional formulation: Formulation,
        /// Mass of the nodes of its contact surfaces in dynamic steps. Default: `consistent`.
        optional contact_mass: ContactMass,
        /// More sets of nodes.
        optional node_sets: Vec<At<NodeSet>>,
        /// More sets of facets.
        optional facet_sets: Vec<At<FacetSet>>,
        /// More sets of elements.
        optional element_sets: Vec<At<ElementSet>>,
    }
}

table! {
    /// Elements of a body that are of a material of their own.
    BodySection {
        /// Name of the element set; no element is in two sections.
        required elements: Text,
        /// Name of their material.
        required material: Text,
        /// How they take up strain. Default: what elements of Abaqus with an `H` or `I` ask for, else what suits their material, as for bodies.
        optional formulation: Formulation,
    }
}

words! {
    /// How elements take up strain.
    Formulation {
        /// By displacements alone; locks where volumes can hardly change.
        Standard = "standard",
        /// With pressure and volume constant in the element; linear tetrahedra lock also with it.
        MeanDilatation = "mean-dilatation",
        /// With a deformation gradient of hexahedra that is enhanced for bending; other elements as `standard`.
        AssumedStrain = "assumed-strain",
    }
}

words! {
    /// Mass of the nodes of contact surfaces.
    ContactMass {
        /// Mass from the consistent mass matrix.
        Consistent = "consistent",
        /// None: it is moved to the nodes behind, against oscillations of contact.
        Redistributed = "redistributed",
    }
}

table! {
    /// A rigid body: a surface to touch, or what nodes are tied to.
    Rigid {
        /// Unique name.
        required name: Text,
        /// Its shape.
        include shape: RigidShape,
        /// Point about which it turns, and centre of a given `mass`. Default: the centre of the mass with `density`, else the origin.
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
        /// The plane by a point of it and its normal.
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
