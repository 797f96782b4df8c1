//! The mesh of one body.

use crate::{ElementId, Face, NodeId, Sets, Vec3};

/// Eight-node hexahedra over nodes in the reference configuration.
#[derive(Clone, Debug, PartialEq)]
pub struct Mesh {
    /// Reference position `X` of every node.
    pub positions: Vec<Vec3>,
    /// Corners of every element, numbered as VTK's hexahedron.
    pub elements: Vec<[NodeId; 8]>,
    /// Named sets of nodes.
    pub node_sets: Sets<NodeId>,
    /// Named sets of element faces on the boundary of the body.
    pub facet_sets: Sets<Face>,
    /// Named sets of elements.
    pub element_sets: Sets<ElementId>,
}

/// What can be wrong with a mesh.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum MeshError {
    /// An element names a node that does not exist.
    #[error("{element} refers to {node}, but the mesh has {nodes} nodes")]
    MissingNode {
        /// The element.
        element: ElementId,
        /// The node it names.
        node: NodeId,
        /// How many nodes there are.
        nodes: usize,
    },
}

impl Mesh {
    /// Nodes of a face, outward by the right-hand rule.
    pub fn face_nodes(&self, face: Face) -> [NodeId; 4] {
        let corners = &self.elements[face.element.index()];
        Face::CORNERS[face.side as usize].map(|corner| corners[corner])
    }
}
