//! The mesh of one body and the checks it has to pass.

use crate::{CellBlock, CellKind, ElementId, Face, MeshError, NodeId, Sets, Vec3};
use serde::Serialize;

/// Cells over nodes in the reference configuration.
///
/// The cells of the blocks, counted through in their order, are the elements.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Mesh {
    /// Reference position `X` of every node.
    pub positions: Vec<Vec3>,
    /// The elements, in blocks of one kind each.
    pub blocks: Vec<CellBlock>,
    /// Named sets of nodes.
    pub node_sets: Sets<NodeId>,
    /// Named sets of element faces on the boundary of the body.
    pub facet_sets: Sets<Face>,
    /// Named sets of elements.
    pub element_sets: Sets<ElementId>,
}

impl Mesh {
    /// A mesh without sets.
    ///
    /// # Errors
    /// Returns the errors of [`Mesh::check`].
    pub fn new(positions: Vec<Vec3>, blocks: Vec<CellBlock>) -> Result<Self, MeshError> {
        let mesh = Self {
            positions,
            blocks,
            node_sets: Sets::default(),
            facet_sets: Sets::default(),
            element_sets: Sets::default(),
        };
        mesh.check()?;
        Ok(mesh)
    }

    /// Checks that the mesh is consistent: what is referred to exists, corners
    /// of an element differ, as do elements, every node is used, positions are finite, no
    /// face has three elements, facet sets lie on the boundary.
    ///
    /// The shape of the elements is not judged here but by [`Mesh::quality`]
    /// and [`Mesh::check_shape`].
    ///
    /// # Errors
    /// The first fault found, with its ids.
    pub fn check(&self) -> Result<(), MeshError> {
        self.check_elements()?;
        self.check_nodes()?;
        self.check_sets()
    }

    /// Number of elements.
    pub fn element_count(&self) -> usize {
        self.blocks.iter().map(CellBlock::len).sum()
    }

    /// Corners of every element in turn.
    pub fn elements(&self) -> impl Iterator<Item = &[NodeId]> {
        self.blocks.iter().flat_map(CellBlock::cells)
    }

    /// Corners of an element.
    pub fn corners(&self, element: ElementId) -> &[NodeId] {
        let (block, at) = self.place(element);
        block.corners(at)
    }

    /// Kind of an element.
    pub fn kind(&self, element: ElementId) -> CellKind {
        self.place(element).0.kind
    }

    /// Nodes of a face, outward by the right-hand rule; a triangle repeats its last node.
    pub fn face_nodes(&self, face: Face) -> [NodeId; 4] {
        let (block, at) = self.place(face.element);
        face_nodes(block, at, face.side)
    }

    /// Positions of the corners of a face, as [`Mesh::face_nodes`].
    pub fn face_positions(&self, face: Face) -> [Vec3; 4] {
        self.face_nodes(face)
            .map(|node| self.positions[node.index()])
    }

    /// Positions of the corners of an element.
    pub fn element_positions(&self, element: ElementId) -> Vec<Vec3> {
        let corners = self.corners(element).iter();
        corners.map(|node| self.positions[node.index()]).collect()
    }

    /// Block of an element and its place there.
    fn place(&self, element: ElementId) -> (&CellBlock, usize) {
        let mut first = 0;
        let placed = self.blocks.iter().find_map(|block| {
            let at = element.index() - first;
            first += block.len();
            (at < block.len()).then_some((block, at))
        });
        placed.expect("an element of this mesh")
    }

    fn check_elements(&self) -> Result<(), MeshError> {
        let nodes = self.positions.len();
        for (index, corners) in self.elements().enumerate() {
            let element = ElementId::new(index);
            if let Some(&node) = corners.iter().find(|node| node.index() >= nodes) {
                return Err(MeshError::MissingNode {
                    element,
                    node,
                    nodes,
                });
            }
            for (corner, &node) in corners.iter().enumerate() {
                if corners[..corner].contains(&node) {
                    return Err(MeshError::RepeatedNode {
                        element,
                        node,
                        kind: self.kind(element),
                    });
                }
            }
        }
        match self.first_repeated() {
            Some([element, other]) => Err(MeshError::RepeatedElement { element, other }),
            None => Ok(()),
        }
    }

    /// The first element with the corners of an earlier one, and that one. Their faces would be no
    /// boundary, as each of them belongs to both.
    fn first_repeated(&self) -> Option<[ElementId; 2]> {
        // Numbers that the same corners have in any order tell nearly all elements apart.
        let key = |corners: &[NodeId]| {
            let least = corners.iter().map(|node| node.index()).min();
            (
                least,
                corners.iter().map(|node| node.index()).sum::<usize>(),
            )
        };
        let mut keys: Vec<_> = self.elements().map(key).zip(0..).collect();
        keys.sort_unstable();
        let sorted = |at: usize| {
            let mut corners = self.corners(ElementId::new(at)).to_vec();
            corners.sort_unstable();
            corners
        };
        let groups = keys
            .chunk_by(|a, b| a.0 == b.0)
            .filter(|group| group.len() > 1);
        let repeated = groups.filter_map(|group| {
            let of_group = group.iter().map(|&(_, at)| (sorted(at), at));
            let mut of_group: Vec<(Vec<NodeId>, usize)> = of_group.collect();
            of_group.sort_unstable();
            let same = of_group.windows(2).filter(|pair| pair[0].0 == pair[1].0);
            same.map(|pair| [pair[1].1, pair[0].1]).min()
        });
        repeated.min().map(|pair| pair.map(ElementId::new))
    }

    fn check_nodes(&self) -> Result<(), MeshError> {
        let mut used = vec![false; self.positions.len()];
        for node in self.elements().flatten() {
            used[node.index()] = true;
        }
        let orphans: Vec<NodeId> = (0..used.len())
            .filter(|&index| !used[index])
            .map(NodeId::new)
            .collect();
        if !orphans.is_empty() {
            return Err(MeshError::OrphanNodes { nodes: orphans });
        }
        match self
            .positions
            .iter()
            .position(|x| x.iter().any(|c| !c.is_finite()))
        {
            Some(index) => Err(MeshError::NotFinite {
                node: NodeId::new(index),
            }),
            None => Ok(()),
        }
    }

    fn check_sets(&self) -> Result<(), MeshError> {
        let (nodes, elements) = (self.positions.len(), self.element_count());
        for (set, members) in self.node_sets.iter() {
            if let Some(&node) = members.iter().find(|node| node.index() >= nodes) {
                let set = set.to_owned();
                return Err(MeshError::MissingSetNode { set, node, nodes });
            }
        }
        for (set, members) in self.element_sets.iter() {
            if let Some(&element) = members.iter().find(|element| element.index() >= elements) {
                let set = set.to_owned();
                return Err(MeshError::MissingSetElement {
                    set,
                    element,
                    elements,
                });
            }
        }
        let boundary = self.matched_boundary()?;
        for (set, members) in self.facet_sets.iter() {
            if let Some(&face) = members
                .iter()
                .find(|face| boundary.binary_search(face).is_err())
            {
                let set = set.to_owned();
                return Err(MeshError::NotOnBoundary { set, face });
            }
        }
        Ok(())
    }
}

/// Nodes of a side of a cell in its place in a block; a triangle repeats its last node.
pub(crate) fn face_nodes(block: &CellBlock, at: usize, side: u8) -> [NodeId; 4] {
    let corners = block.corners(at);
    let face = block.kind.shape().faces[side as usize];
    [0, 1, 2, face.len() - 1].map(|at| corners[face[at]])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generate::Block;

    fn two_elements() -> Mesh {
        Block {
            divisions: [2, 1, 1],
            ..Block::default()
        }
        .mesh()
        .unwrap()
    }

    #[test]
    fn missing_and_repeated_nodes_are_named() {
        let mut mesh = two_elements();
        mesh.blocks[0].nodes[11] = NodeId(99);
        assert_eq!(
            mesh.check(),
            Err(MeshError::MissingNode {
                element: ElementId(1),
                node: NodeId(99),
                nodes: 12
            })
        );
        let node = mesh.blocks[0].nodes[8];
        mesh.blocks[0].nodes[11] = node;
        assert_eq!(
            mesh.check(),
            Err(MeshError::RepeatedNode {
                element: ElementId(1),
                node,
                kind: CellKind::Hexahedron,
            })
        );
    }

    #[test]
    fn orphans_and_infinite_positions_are_named() {
        let mut mesh = two_elements();
        mesh.positions.push(Vec3::zeros());
        let error = mesh.check().unwrap_err();
        assert_eq!(
            error,
            MeshError::OrphanNodes {
                nodes: vec![NodeId(12)]
            }
        );
        assert_eq!(
            error.to_string(),
            "1 nodes belong to no element, the first is node 12"
        );
        mesh.positions.pop();
        mesh.positions[4].y = f64::NAN;
        assert_eq!(mesh.check(), Err(MeshError::NotFinite { node: NodeId(4) }));
    }

    #[test]
    fn sets_refer_to_what_exists() {
        let mut mesh = two_elements();
        mesh.node_sets.insert("far", [NodeId(12)]);
        assert!(matches!(
            mesh.check(),
            Err(MeshError::MissingSetNode { set, node: NodeId(12), nodes: 12 }) if set == "far"
        ));
        let mut mesh = two_elements();
        mesh.element_sets.insert("far", [ElementId(2)]);
        assert!(matches!(
            mesh.check(),
            Err(MeshError::MissingSetElement {
                element: ElementId(2),
                ..
            })
        ));
    }

    #[test]
    fn elements_differ() {
        let mut mesh = two_elements();
        let mut again = mesh.blocks[0].nodes[8..].to_vec();
        again.rotate_left(3);
        mesh.blocks[0].nodes.extend(again);
        let fault = mesh.check().unwrap_err();
        assert_eq!(
            fault.to_string(),
            "element 2 has the same corners as element 1; remove one of them"
        );
    }

    #[test]
    fn facet_sets_lie_on_the_boundary() {
        for (element, side) in [(0, 3), (1, 5), (2, 0), (0, 6)] {
            let mut mesh = two_elements();
            let face = Face {
                element: ElementId(element),
                side,
            };
            mesh.facet_sets.insert("inside", [face]);
            assert_eq!(
                mesh.check(),
                Err(MeshError::NotOnBoundary {
                    set: "inside".into(),
                    face
                })
            );
        }
    }

    #[test]
    fn three_elements_in_one_face_are_refused() {
        let mut mesh = two_elements();
        let mut third = mesh.blocks[0].corners(1).to_vec();
        let shared = mesh.blocks[0].corners(0).to_vec();
        for corner in &mut third {
            if !shared.contains(corner) {
                let apart = mesh.positions[corner.index()] + Vec3::new(0.0, 2.0, 0.0);
                *corner = NodeId::new(mesh.positions.len());
                mesh.positions.push(apart);
            }
        }
        mesh.blocks[0].nodes.extend(third);
        assert!(matches!(mesh.check(), Err(MeshError::CrowdedFace { .. })));
    }
}
