//! Topology of a mesh: faces on the boundary, and nodes and elements that touch each other.
//!
//! Two elements share a face when they have all its nodes in common; a face of one
//! element only is on the boundary.

use crate::{ElementId, Face, Mesh, MeshError, NodeId, mesh::face_nodes};

impl Mesh {
    /// Faces that belong to one element only, in ascending order.
    pub fn boundary_faces(&self) -> Vec<Face> {
        alone(&self.faces_by_nodes())
    }

    /// Boundary faces with all their nodes in `nodes`, in ascending order.
    pub fn faces_of_nodes(&self, nodes: &[NodeId]) -> Vec<Face> {
        let mut chosen = vec![false; self.positions.len()];
        for node in nodes {
            chosen[node.index()] = true;
        }
        let mut faces = self.boundary_faces();
        faces.retain(|&face| {
            self.face_nodes(face)
                .iter()
                .all(|node| chosen[node.index()])
        });
        faces
    }

    /// Nodes of faces, in ascending order and without repeats.
    pub fn nodes_of_faces(&self, faces: &[Face]) -> Vec<NodeId> {
        let mut nodes: Vec<NodeId> = faces
            .iter()
            .flat_map(|&face| self.face_nodes(face))
            .collect();
        nodes.sort_unstable();
        nodes.dedup();
        nodes
    }

    /// For every node the elements that have it as a corner, in ascending order.
    pub fn elements_of_nodes(&self) -> Vec<Vec<ElementId>> {
        let mut elements = vec![Vec::new(); self.positions.len()];
        for (index, corners) in self.elements().enumerate() {
            for node in corners {
                elements[node.index()].push(ElementId::new(index));
            }
        }
        elements
    }

    /// The boundary faces of a mesh in which no face has three elements.
    pub(crate) fn matched_boundary(&self) -> Result<Vec<Face>, MeshError> {
        let faces = self.faces_by_nodes();
        match faces
            .chunk_by(|a, b| a.0 == b.0)
            .find(|group| group.len() > 2)
        {
            Some(group) => Err(MeshError::CrowdedFace { face: group[0].1 }),
            None => Ok(alone(&faces)),
        }
    }

    /// All faces of all elements, sorted by their sorted nodes.
    fn faces_by_nodes(&self) -> Vec<([NodeId; 4], Face)> {
        // Few faces share their first node, so that the rest is sorted in linear time.
        let mut ends = vec![0; self.positions.len() + 1];
        self.each_face(|nodes, _| ends[nodes[0].index() + 1] += 1);
        let mut total = 0;
        for end in &mut ends {
            total += *end;
            *end = total;
        }
        let none = Face {
            element: ElementId::new(0),
            side: 0,
        };
        let mut faces = vec![([NodeId::new(0); 4], none); total];
        // The entry of a node begins at its first place and ends at that of the next node.
        self.each_face(|nodes, face| {
            let place = &mut ends[nodes[0].index()];
            faces[*place] = (nodes, face);
            *place += 1;
        });
        for of_node in faces.chunk_by_mut(|a, b| a.0[0] == b.0[0]) {
            of_node.sort_unstable();
        }
        faces
    }

    /// Visits all faces of all elements with their sorted nodes.
    fn each_face(&self, mut visit: impl FnMut([NodeId; 4], Face)) {
        let mut element = 0;
        for block in &self.blocks {
            let sides = block.kind.shape().faces.len() as u8;
            for at in 0..block.len() {
                let id = ElementId::new(element + at);
                for side in 0..sides {
                    let nodes = sorted_face(face_nodes(block, at, side));
                    visit(nodes, Face { element: id, side });
                }
            }
            element += block.len();
        }
    }
}

/// Faces of one element, in ascending order.
fn alone(sorted: &[([NodeId; 4], Face)]) -> Vec<Face> {
    let mut alone: Vec<Face> = sorted
        .chunk_by(|a, b| a.0 == b.0)
        .filter(|group| group.len() == 1)
        .map(|group| group[0].1)
        .collect();
    alone.sort_unstable();
    alone
}

/// Nodes of a face in the order that two elements agree on: ascending, and a triangle
/// repeats its largest.
pub fn sorted_face(mut nodes: [NodeId; 4]) -> [NodeId; 4] {
    if nodes[2] == nodes[3] {
        nodes[..3].sort_unstable();
        nodes[3] = nodes[2];
    } else {
        nodes.sort_unstable();
    }
    nodes
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generate::Block;
    use std::collections::HashSet;

    fn block() -> Mesh {
        Block {
            divisions: [3, 4, 2],
            irregularity: 0.2,
            ..Block::default()
        }
        .mesh()
        .unwrap()
    }

    #[test]
    fn boundary_agrees_with_brute_force() {
        let mesh = block();
        let node_set = |face| -> HashSet<NodeId> { mesh.face_nodes(face).into_iter().collect() };
        let all: Vec<Face> = (0..mesh.element_count())
            .flat_map(|e| {
                (0..6).map(move |side| Face {
                    element: ElementId::new(e),
                    side,
                })
            })
            .collect();
        let alone: Vec<Face> = all
            .iter()
            .copied()
            .filter(|&a| !all.iter().any(|&b| a != b && node_set(a) == node_set(b)))
            .collect();
        assert_eq!(mesh.boundary_faces(), alone);
        assert_eq!(alone.len(), 2 * (3 * 4 + 4 * 2 + 2 * 3));
    }

    #[test]
    fn faces_and_nodes_of_sets_come_back() {
        let mesh = block();
        for (name, faces) in mesh.facet_sets.iter() {
            let nodes = mesh.nodes_of_faces(faces);
            assert_eq!(mesh.node_sets.get(name), Some(nodes.as_slice()));
            assert_eq!(mesh.faces_of_nodes(&nodes), faces);
        }
    }

    #[test]
    fn elements_of_nodes_count_corners() {
        let mesh = block();
        let touching = mesh.elements_of_nodes();
        assert_eq!(
            touching.iter().map(Vec::len).sum::<usize>(),
            8 * mesh.element_count()
        );
        for (node, elements) in touching.iter().enumerate() {
            for element in elements {
                assert!(mesh.corners(*element).contains(&NodeId::new(node)));
            }
        }
    }
}
