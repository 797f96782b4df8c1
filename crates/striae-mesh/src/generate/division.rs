//! Hexahedra divided into cells of other kinds.
//!
//! - wedges: two, either side of the plane through the edges `0 4` and `2 6`;
//! - tetrahedra: six around the diagonal `0 6` (Kuhn): each goes along one edge a
//!   direction, so that neighbours in a lattice cut the face between them alike;
//! - pyramids: six, from the faces to a node in the middle.

use crate::{CellBlock, CellKind, ElementId, Face, NodeId, Vec3, mesh::face_nodes};

const WEDGES: [[usize; 6]; 2] = [[0, 1, 2, 4, 5, 6], [0, 2, 3, 4, 6, 7]];
const TETRAHEDRA: [[usize; 4]; 6] = [
    [0, 1, 2, 6],
    [0, 5, 1, 6],
    [0, 2, 3, 6],
    [0, 3, 7, 6],
    [0, 4, 5, 6],
    [0, 7, 4, 6],
];

/// Hexahedra and what they are divided into.
pub(super) struct Division {
    hexahedra: CellBlock,
    /// The cells, those of a hexahedron one after the other.
    pub(super) cells: CellBlock,
}

impl Division {
    /// Divides hexahedra of a lattice; pyramids add nodes.
    pub(super) fn new(hexahedra: CellBlock, kind: CellKind, positions: &mut Vec<Vec3>) -> Self {
        let nodes = match kind {
            CellKind::Hexahedron => hexahedra.nodes.clone(),
            CellKind::Wedge => picked(&hexahedra, WEDGES.as_flattened()),
            CellKind::Tetrahedron => picked(&hexahedra, TETRAHEDRA.as_flattened()),
            CellKind::Pyramid => pyramids(&hexahedra, positions),
        };
        Self {
            hexahedra,
            cells: CellBlock { kind, nodes },
        }
    }

    /// Faces of the cells on faces of the hexahedra.
    pub(super) fn faces(&self, faces: &[Face]) -> Vec<Face> {
        let parts = self.cells.len() / self.hexahedra.len();
        let sides = self.cells.kind.shape().faces.len() as u8;
        let mut found = Vec::new();
        for face in faces {
            let hexahedron = face.element.index();
            let whole = face_nodes(&self.hexahedra, hexahedron, face.side);
            for at in parts * hexahedron..parts * (hexahedron + 1) {
                let on_face = |side: &u8| {
                    let nodes = face_nodes(&self.cells, at, *side);
                    nodes.iter().all(|node| whole.contains(node))
                };
                found.extend((0..sides).filter(on_face).map(|side| Face {
                    element: ElementId::new(at),
                    side,
                }));
            }
        }
        found
    }
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
