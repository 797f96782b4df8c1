//! Hexahedra divided into cells of other kinds.
//!
//! - wedges: two, either side of the plane through the edges `0 4` and `2 6`;
//! - tetrahedra: six around the diagonal `0 6` (Kuhn): each goes along one edge a
//!   direction, so that neighbours in a lattice cut the face between them alike;
//! - ten-node tetrahedra: the same with nodes in the middles of their edges;
//! - pyramids: six, from the faces to a node in the middle.

use std::collections::HashMap;

use super::generator::{lattice_nodes, product};
use crate::{CellBlock, CellKind, ElementId, Face, NodeId, Vec3, mesh::face_nodes};
use striae_declared::{Parameter, Values};

/// Kind of cells; [`cells`] reads it.
pub(super) const CELLS: Parameter = Parameter::word(
    "cells",
    &[
        ("hexahedra", "Hexahedra with eight nodes, not divided."),
        (
            "wedges",
            "Wedges with six nodes, two in each hexahedron, along the third axis.",
        ),
        (
            "pyramids",
            "Pyramids with five nodes, six in each hexahedron.",
        ),
        (
            "tetrahedra",
            "Tetrahedra with four nodes, six in each hexahedron.",
        ),
        (
            "composite-tetrahedra",
            "Tetrahedra with ten nodes, six in each hexahedron, each linear in twelve parts.",
        ),
    ],
    "Kind of cells that the hexahedra are divided into.",
);

const WEDGES: [[usize; 6]; 2] = [[0, 1, 2, 4, 5, 6], [0, 2, 3, 4, 6, 7]];
const TETRAHEDRA: [[usize; 4]; 6] = [
    [0, 1, 2, 6],
    [0, 5, 1, 6],
    [0, 2, 3, 6],
    [0, 3, 7, 6],
    [0, 4, 5, 6],
    [0, 7, 4, 6],
];

/// The kind of cells that values of [`CELLS`] state.
pub(super) fn cells(values: &Values) -> CellKind {
    match values.word(CELLS.name) {
        "wedges" => CellKind::Wedge,
        "pyramids" => CellKind::Pyramid,
        "tetrahedra" => CellKind::Tetrahedron,
        "composite-tetrahedra" => CellKind::CompositeTetrahedron,
        _ => CellKind::Hexahedron,
    }
}

/// Number of cells that a hexahedron is divided into.
pub(super) fn parts(kind: CellKind) -> usize {
    match kind {
        CellKind::Hexahedron => 1,
        CellKind::Wedge => 2,
        _ => 6,
    }
}

/// Returns about how many nodes the cells of a divided lattice have.
pub(super) fn nodes(kind: CellKind, divisions: &[usize; 3]) -> u128 {
    // The edges of a divided hexahedron that are its own in the inside of a lattice are seven:
    // three of its edges, a diagonal of three faces and the one through its middle.
    let added = match kind {
        CellKind::Pyramid => 1,
        CellKind::CompositeTetrahedron => 7,
        _ => 0,
    };
    lattice_nodes(divisions).saturating_add(product(divisions).saturating_mul(added))
}

/// Hexahedra and what they are divided into.
pub(super) struct Division {
    hexahedra: CellBlock,
    /// The cells by those of their nodes that are their corners in the strict sense.
    plain: CellBlock,
    /// The cells, those of a hexahedron one after the other.
    pub(super) cells: CellBlock,
}

impl Division {
    /// Divides hexahedra of a lattice; pyramids add nodes.
    pub(super) fn new(hexahedra: CellBlock, kind: CellKind, positions: &mut Vec<Vec3>) -> Self {
        let corners = match kind {
            CellKind::CompositeTetrahedron => CellKind::Tetrahedron,
            other => other,
        };
        let nodes = match corners {
            CellKind::Wedge => picked(&hexahedra, WEDGES.as_flattened()),
            CellKind::Pyramid => pyramids(&hexahedra, positions),
            CellKind::Tetrahedron => picked(&hexahedra, TETRAHEDRA.as_flattened()),
            _ => hexahedra.nodes.clone(),
        };
        let plain = CellBlock {
            kind: corners,
            nodes,
        };
        let nodes = match kind {
            CellKind::CompositeTetrahedron => with_middles(&plain, positions),
            _ => plain.nodes.clone(),
        };
        Self {
            hexahedra,
            plain,
            cells: CellBlock { kind, nodes },
        }
    }

    /// Faces of the cells on faces of the hexahedra.
    pub(super) fn faces(&self, faces: &[Face]) -> Vec<Face> {
        let parts = self.cells.len() / self.hexahedra.len();
        let sides = self.plain.kind.shape().faces.len() as u8;
        let mut found = Vec::new();
        for face in faces {
            let hexahedron = face.element.index();
            let whole = face_nodes(&self.hexahedra, hexahedron, face.side);
            for at in parts * hexahedron..parts * (hexahedron + 1) {
                let on_face = |side: &u8| {
                    let nodes = face_nodes(&self.plain, at, *side);
                    nodes.iter().all(|node| whole.contains(node))
                };
                let sides = (0..sides).filter(on_face);
                let faces = sides.flat_map(|side| self.cells.kind.faces_of_side(side));
                found.extend(faces.map(|side| Face {
                    element: ElementId::new(at),
                    side,
                }));
            }
        }
        found
    }
}

/// Tetrahedra with nodes added in the middles of their edges.
fn with_middles(tetrahedra: &CellBlock, positions: &mut Vec<Vec3>) -> Vec<NodeId> {
    const EDGES: [[usize; 2]; 6] = [[0, 1], [1, 2], [2, 0], [0, 3], [1, 3], [2, 3]];
    let mut middles: HashMap<[NodeId; 2], NodeId> = HashMap::new();
    let mut nodes = Vec::new();
    for cell in tetrahedra.cells() {
        nodes.extend_from_slice(cell);
        for edge in EDGES {
            let [a, b] = edge.map(|end| cell[end]);
            let middle = middles.entry([a.min(b), a.max(b)]).or_insert_with(|| {
                positions.push((positions[a.index()] + positions[b.index()]) / 2.0);
                NodeId::new(positions.len() - 1)
            });
            nodes.push(*middle);
        }
    }
    nodes
}

fn picked(hexahedra: &CellBlock, corners: &[usize]) -> Vec<NodeId> {
    let cells = hexahedra.cells();
    cells
        .flat_map(|cell| corners.iter().map(|&corner| cell[corner]))
        .collect()
}

fn pyramids(hexahedra: &CellBlock, positions: &mut Vec<Vec3>) -> Vec<NodeId> {
    let mut nodes = Vec::new();
    for cell in hexahedra.cells() {
        let apex = NodeId::new(positions.len());
        let sum: Vec3 = cell.iter().map(|node| positions[node.index()]).sum();
        positions.push(sum / 8.0);
        for face in hexahedra.kind.shape().faces {
            // Seen from the apex the corners of the base turn the other way.
            nodes.extend([0, 3, 2, 1].map(|at| cell[face[at]]));
            nodes.push(apex);
        }
    }
    nodes
}
