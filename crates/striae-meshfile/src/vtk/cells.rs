//! Types of VTK's cells.
//!
//! Nodes on edges come in the order of Abaqus; middles of the faces of a hexahedron are those
//! at the ends of the first, second and third axis. A wedge has its first triangle outward by
//! VTK's documentation and inward as many programs write it: the order is taken in which its
//! volume is positive. Source: VTK file formats and `vtkCellType.h`.

use super::super::{MeshFileFault, Place};
use striae_mesh::{CellKind, Vec3};

/// Content of a cell.
#[derive(Debug, PartialEq)]
pub(super) enum Cell {
    /// A solid with its nodes in the order of `division.rs`.
    Solid(CellKind, Vec<u64>),
    /// A cell of a dimension below three.
    Lower(usize, Vec<u64>),
    /// One without nodes.
    Empty,
}

/// Codes of solids: name, kind, number of nodes.
const SOLIDS: [(u8, &str, CellKind, usize); 11] = [
    (10, "tetrahedron", CellKind::Tetrahedron, 4),
    (11, "voxel", CellKind::Hexahedron, 8),
    (12, "hexahedron", CellKind::Hexahedron, 8),
    (13, "wedge", CellKind::Wedge, 6),
    (14, "pyramid", CellKind::Pyramid, 5),
    (
        24,
        "quadratic tetrahedron",
        CellKind::CompositeTetrahedron,
        10,
    ),
    (25, "quadratic hexahedron", CellKind::Hexahedron, 20),
    (26, "quadratic wedge", CellKind::Wedge, 15),
    (29, "triquadratic hexahedron", CellKind::Hexahedron, 27),
    (32, "biquadratic wedge", CellKind::Wedge, 18),
    (
        71,
        "Lagrange tetrahedron",
        CellKind::CompositeTetrahedron,
        10,
    ),
];

/// The cell of a code with these nodes.
pub(super) fn cell(
    place: Place,
    code: i64,
    nodes: &[u64],
    points: &[Vec3],
) -> Result<Cell, MeshFileFault> {
    let lower = |dimension| Ok(Cell::Lower(dimension, nodes.to_vec()));
    match (code, nodes) {
        (0, _) => return Ok(Cell::Empty),
        (1 | 2, _) => return lower(0),
        (3 | 4 | 21 | 35 | 68, _) => return lower(1),
        (8, &[a, b, c, d]) => return Ok(Cell::Lower(2, vec![a, b, d, c])),
        (34, [six @ .., _]) => return Ok(Cell::Lower(2, six.to_vec())),
        (5..=9 | 22 | 23 | 28 | 34 | 69 | 70, _) => return lower(2),
        _ => {}
    }
    let mut solids = SOLIDS.iter();
    let Some((_, name, kind, count)) = solids.find(|solid| i64::from(solid.0) == code) else {
        let expected = "tetrahedra, pyramids, wedges or hexahedra, of 4, 5, 6, 8, 10, 15, 18, 20 \
                        or 27 points";
        let found = format!("a cell of type {code}");
        return Err(MeshFileFault::at(place, expected, found)
            .with_remedy("mesh with elements of first or second order"));
    };
    if nodes.len() != *count {
        let expected = format!("{count} points of a {name}");
        return Err(MeshFileFault::at(place, expected, nodes.len().to_string()));
    }
    let nodes = match kind {
        CellKind::Wedge => turned(nodes, points),
        CellKind::Hexahedron => ordered(code, nodes),
        _ => nodes.to_vec(),
    };
    Ok(Cell::Solid(*kind, nodes))
}

/// Nodes of a hexahedron in our order.
fn ordered(code: i64, nodes: &[u64]) -> Vec<u64> {
    const VOXEL: [usize; 8] = [0, 1, 3, 2, 4, 5, 7, 6];
    const FACES: [usize; 7] = [24, 25, 22, 21, 23, 20, 26];
    match code {
        11 => VOXEL.map(|at| nodes[at]).to_vec(),
        29 => (0..20).chain(FACES).map(|at| nodes[at]).collect(),
        _ => nodes.to_vec(),
    }
}

/// Nodes of a wedge with its first triangle inward.
fn turned(nodes: &[u64], points: &[Vec3]) -> Vec<u64> {
    const MIRRORED: [usize; 18] = [0, 2, 1, 3, 5, 4, 8, 7, 6, 11, 10, 9, 12, 14, 13, 17, 16, 15];
    let at = |corner: usize| points.get(nodes[corner] as usize);
    let (Some(a), Some(b), Some(c), Some(d)) = (at(0), at(1), at(2), at(3)) else {
        return nodes.to_vec();
    };
    if (b - a).cross(&(c - a)).dot(&(d - a)) >= 0.0 {
        return nodes.to_vec();
    }
    MIRRORED[..nodes.len()]
        .iter()
        .map(|at| nodes[*at])
        .collect()
}
