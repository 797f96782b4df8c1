//! Gmsh's element types.

use super::super::MeshFileFault;
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

    /// The type of a number from 1 to 19.
    pub(super) fn new(line: usize, number: usize) -> Result<Self, MeshFileFault> {
        if (1..=KINDS.len()).contains(&number) {
            return Ok(Self(number));
        }
        let found = format!("element type {number}");
        Err(
            MeshFileFault::line(line, "an element type from 1 to 19", found)
                .with_remedy(LOWER_ORDER),
        )
    }

    /// The kind of cell that elements of this type are.
    pub(super) fn cell(self) -> Option<CellKind> {
        match self.0 {
            4 => Some(CellKind::Tetrahedron),
            5 => Some(CellKind::Hexahedron),
            6 => Some(CellKind::Wedge),
            7 => Some(CellKind::Pyramid),
            11 => Some(CellKind::CompositeTetrahedron),
            _ => None,
        }
    }

    pub(super) fn dimension(self) -> usize {
        KINDS[self.0 - 1].1
    }

    pub(super) fn node_count(self) -> usize {
        KINDS[self.0 - 1].2
    }

    /// The fault of this type where it cannot be used.
    pub(super) fn fault(self, line: usize) -> MeshFileFault {
        let expected = match self.dimension() {
            3 => "tetrahedra of 4 or 10 nodes, linear pyramids, prisms or hexahedra",
            _ => "triangles of 3 or 6 nodes or 4-node quadrangles as faces",
        };
        let found = format!("element type {} ({})", self.0, KINDS[self.0 - 1].0);
        MeshFileFault::line(line, expected, found).with_remedy(LOWER_ORDER)
    }
}

const LOWER_ORDER: &str = "mesh with Mesh.ElementOrder = 1";
