//! Which faces bound the body, which nodes and elements touch which.
//!
//! Two elements are neighbours across a face when they have its four nodes in
//! common; a face of one element only is on the boundary.

use crate::{ElementId, Face, Mesh, MeshError, NodeId};

impl Mesh {
    /// Faces that belong to one element only, in ascending order.
    pub fn boundary_faces(&self) -> Vec<Face> {
        let mut boundary: Vec<Face> = self
            .faces_by_nodes()
            .chunk_by(|a, b| a.0 == b.0)
            .filter(|group| group.len() == 1)
            .map(|group| group[0].1)
            .collect();
        boundary.sort_unstable();
        boundary
    }

    /// Boundary faces with all four nodes in `nodes`, in ascending order.
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

    /// For every element its neighbours across the six faces, `None` on the boundary.
    pub fn element_neighbours(&self) -> Vec<[Option<ElementId>; 6]> {
        let mut neighbours = vec![[None; 6]; self.elements.len()];
        for group in self.faces_by_nodes().chunk_by(|a, b| a.0 == b.0) {
            if let [(_, a), (_, b)] = group {
                neighbours[a.element.index()][a.side as usize] = Some(b.element);
                neighbours[b.element.index()][b.side as usize] = Some(a.element);
            }
        }
        neighbours
    }

    /// For every node the elements that have it as a corner, in ascending order.
    pub fn elements_of_nodes(&self) -> Vec<Vec<ElementId>> {
        let mut elements = vec![Vec::new(); self.positions.len()];
        for (index, corners) in self.elements.iter().enumerate() {
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
            None => Ok(self.boundary_faces()),
        }
    }

    /// All faces of all elements, sorted by their sorted nodes.
    fn faces_by_nodes(&self) -> Vec<([NodeId; 4], Face)> {
        let mut faces: Vec<([NodeId; 4], Face)> = (0..self.elements.len())
            .flat_map(|index| {
                (0..6).map(move |side| Face {
                    element: ElementId::new(index),
                    side,
                })
            })
            .map(|face| {
                let mut nodes = self.face_nodes(face);
                nodes.sort_unstable();
                (nodes, face)
            })
            .collect();
        faces.sort_unstable();
        faces
    }
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
        let all: Vec<Face> = (0..mesh.elements.len())
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
    fn neighbours_are_mutual_and_complete() {
        let mesh = block();
        let neighbours = mesh.element_neighbours();
        for (index, across) in neighbours.iter().enumerate() {
            for neighbour in across.iter().flatten() {
                assert!(neighbours[neighbour.index()].contains(&Some(ElementId::new(index))));
            }
        }
        let open = neighbours.iter().flatten().filter(|n| n.is_none()).count();
        assert_eq!(open, mesh.boundary_faces().len());
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
            8 * mesh.elements.len()
        );
        for (node, elements) in touching.iter().enumerate() {
            for element in elements {
                assert!(mesh.elements[element.index()].contains(&NodeId::new(node)));
            }
        }
    }
}
