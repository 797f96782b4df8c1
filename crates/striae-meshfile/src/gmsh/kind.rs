//! Gmsh's element types.

use super::super::{MeshFileFault, Place};
use striae_mesh::CellKind;

/// An element type by its number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Kind(usize);

/// Name, dimension and number of nodes of the types 1 to 19.
const KINDS: [(&str, usize, usize); 19] = [
    ("line", 1, 2),
    ("triangle", 2, 3),
    ("quadrangle", 2, 4),
    ("tetrahedron", 3, 4),
    ("hexahedron", 3, 8),
    ("prism", 3, 6),
    ("pyramid", 3, 5),
    ("3-node line", 1, 3),
    ("6-node triangle", 2, 6),
    ("9-node quadrangle", 2, 9),
    ("10-node tetrahedron", 3, 10),
    ("27-node hexahedron", 3, 27),
    ("18-node prism", 3, 18),
    ("14-node pyramid", 3, 14),
    ("point", 0, 1),
    ("8-node quadrangle", 2, 8),
    ("20-node hexahedron", 3, 20),
    ("15-node prism", 3, 15),
    ("13-node pyramid", 3, 13),
];

impl Kind {
    pub(super) const TRIANGLE: Self = Self(2);
    pub(super) const QUADRANGLE: Self = Self(3);
    pub(super) const TRIANGLE_6: Self = Self(9);
    pub(super) const QUADRANGLE_9: Self = Self(10);

    /// The type of a number from 1 to 19.
    pub(super) fn new(place: Place, number: usize) -> Result<Self, MeshFileFault> {
        if (1..=KINDS.len()).contains(&number) {
            return Ok(Self(number));
        }
        let found = format!("element type {number}");
        Err(
            MeshFileFault::at(place, "an element type from 1 to 19", found)
                .with_remedy(LOWER_ORDER),
        )
    }

    /// The kind of cell that elements of this type are, or are divided into.
    pub(super) fn cell(self) -> Option<CellKind> {
        match self.0 {
            4 => Some(CellKind::Tetrahedron),
            5 | 12 | 17 => Some(CellKind::Hexahedron),
            6 | 13 | 18 => Some(CellKind::Wedge),
            7 => Some(CellKind::Pyramid),
            11 => Some(CellKind::CompositeTetrahedron),
            _ => None,
        }
    }

    /// Nodes of a cell in the order of Abaqus and of `division.rs`.
    pub(super) fn ordered(self, nodes: &[u64]) -> Vec<u64> {
        const EDGES_8: [usize; 12] = [8, 11, 13, 9, 16, 18, 19, 17, 10, 12, 14, 15];
        const FACES_8: [usize; 7] = [20, 25, 21, 23, 24, 22, 26];
        const EDGES_6: [usize; 9] = [6, 9, 7, 12, 14, 13, 8, 10, 11];
        const FACES_6: [usize; 3] = [15, 17, 16];
        let order: Vec<usize> = match self.0 {
            11 => (0..8).chain([9, 8]).collect(),
            12 => (0..8).chain(EDGES_8).chain(FACES_8).collect(),
            17 => (0..8).chain(EDGES_8).collect(),
            13 => (0..6).chain(EDGES_6).chain(FACES_6).collect(),
            18 => (0..6).chain(EDGES_6).collect(),
            _ => return nodes.to_vec(),
        };
        order.into_iter().map(|at| nodes[at]).collect()
    }

    pub(super) fn dimension(self) -> usize {
        KINDS[self.0 - 1].1
    }

    pub(super) fn node_count(self) -> usize {
        KINDS[self.0 - 1].2
    }

    /// The fault of this type where it cannot be used.
    pub(super) fn fault(self, place: Place) -> MeshFileFault {
        let expected = match self.dimension() {
            3 => "tetrahedra, prisms, hexahedra or linear pyramids",
            _ => "triangles, or quadrangles of 4 or 9 nodes",
        };
        let found = format!("element type {} ({})", self.0, KINDS[self.0 - 1].0);
        MeshFileFault::at(place, expected, found).with_remedy(LOWER_ORDER)
    }
}

const LOWER_ORDER: &str = "mesh with Mesh.ElementOrder = 1";
