//! `mesh = { ... }` of a body.

use crate::{
    declare::{either, table},
    law::Stated,
    read::At,
    value::{All, Number, Text, Truth, Whole},
};
use striae_mesh::generate::Generator;

either! {
    /// A mesh of a body.
    Mesh {
        File(BodyFile),
        Inline(InlineMesh),
        Generated(Stated<Generator>),
    }
}

table! {
    /// A mesh of a body read from a file.
    BodyFile {
        /// Path relative to the deck.
        required file: Text,
        /// The part of the file that makes up the body: an element set, a physical volume of Gmsh,
        /// or an instance of Abaqus. Sets are restricted to it. Default: the whole file.
        optional elements: Text,
        /// `true`: elements have the materials that the file assigns to them, by `*SOLID SECTION`
        /// of Abaqus. Default: `false`.
        optional materials: Truth,
    }
}

table! {
    /// A mesh read from a file.
    MeshFile {
        /// Path relative to the deck.
        required file: Text,
        /// The part of an Abaqus file that makes up the surface: an element set or an instance.
        /// Default: all facets.
        optional elements: Text,
    }
}

table! {
    /// A mesh of a body written in the deck, without sets.
    InlineMesh {
        /// Positions of the nodes.
        required positions: Vec<At<[Number; 3]>>,
        /// Corners of the elements, with nodes counted from 0 and ordered as in Abaqus and Gmsh:
        /// eight of a hexahedron, six of a wedge, five of a pyramid, four of a tetrahedron, ten of
        /// one with midside nodes.
        required cells: Vec<At<All<Whole<0>>>>,
    }
}
