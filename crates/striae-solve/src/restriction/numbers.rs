//! Local numbers of what a rank holds, in the order of the whole.

use striae_contact::side::Side;
use striae_mesh::{ElementId, Face, NodeId};

use crate::{problem::Frame, share::Division};
use striae_model::{Model, node::GlobalNode, tie::first_nodes};

/// Marker of nodes and elements that are not held.
const NOWHERE: u32 = u32::MAX;

/// Local numbers of nodes and elements.
pub(super) struct Numbers {
    /// First node of every body in the whole, and the number of their nodes.
    first_whole: Vec<usize>,
    /// First local node of every body, and the number of local nodes.
    first_local: Vec<usize>,
    /// Local number of every node of all bodies.
    nodes: Vec<u32>,
    /// Local number of every element, by body.
    elements: Vec<Vec<u32>>,
    /// `true` for nodes of bodies that all ranks hold.
    replicated: Vec<bool>,
}

impl Numbers {
    /// Numbers of what a rank holds: its elements with their nodes, and what is replicated.
    pub(super) fn new(whole: &Frame, division: &Division, rank: usize) -> Self {
        let model = &whole.model;
        let first_whole = first_nodes(model);
        let replicated = replicated(whole, &first_whole);
        let mut held = replicated.clone();
        let bodies = model.bodies.iter().zip(division.elements());
        for ((body, ranks), first) in bodies.zip(&first_whole) {
            for (corners, of_element) in body.mesh.elements().zip(ranks) {
                if *of_element as usize == rank {
                    corners
                        .iter()
                        .for_each(|node| held[first + node.index()] = true);
                }
            }
        }
        let mut first_local = vec![0];
        for body in first_whole.windows(2) {
            let count = held[body[0]..body[1]].iter().filter(|held| **held).count();
            first_local.push(first_local[first_local.len() - 1] + count);
        }
        let own = |ranks: &Vec<u32>| numbered(ranks.iter().map(|of| *of as usize == rank));
        Self {
            nodes: numbered(held.into_iter()),
            elements: division.elements().iter().map(own).collect(),
            first_whole,
            first_local,
            replicated,
        }
    }

    /// First node of every body in the whole, and the number of their nodes.
    pub(super) fn first_whole(&self) -> &[usize] {
        &self.first_whole
    }

    /// Local number of a node, if it is held. Mass points always are.
    pub(super) fn node(&self, GlobalNode(node): GlobalNode) -> Option<GlobalNode> {
        match self.nodes.get(node) {
            Some(&NOWHERE) => None,
            Some(&local) => Some(GlobalNode(local as usize)),
            None => {
                let [bodies, local] =
                    [&self.first_whole, &self.first_local].map(|of| of[of.len() - 1]);
                Some(GlobalNode(node - bodies + local))
            }
        }
    }

    /// Local number of a node that is held.
    pub(super) fn held(&self, node: GlobalNode) -> GlobalNode {
        self.node(node).expect("all ranks hold what is replicated")
    }

    /// Local number of a node of the mesh of a body, if it is held.
    pub(super) fn in_mesh(&self, body: usize, node: NodeId) -> Option<NodeId> {
        let local = self.node(GlobalNode(self.first_whole[body] + node.index()))?;
        Some(NodeId::new(local.0 - self.first_local[body]))
    }

    /// Local number of a node of the mesh of a body that is held.
    pub(super) fn held_in_mesh(&self, body: usize, node: NodeId) -> NodeId {
        let local = self.in_mesh(body, node);
        local.expect("all ranks hold what is replicated")
    }

    /// Local number of an element of a body, if it is this rank's own.
    pub(super) fn element(&self, body: usize, element: ElementId) -> Option<ElementId> {
        let local = self.elements[body][element.index()];
        (local != NOWHERE).then_some(ElementId(local))
    }

    /// A face with its local element, if that is this rank's own.
    pub(super) fn face(&self, body: usize, face: Face) -> Option<Face> {
        let element = self.element(body, face.element)?;
        Some(Face { element, ..face })
    }

    /// Returns whether all ranks hold a node of the whole.
    pub(super) fn is_replicated(&self, node: GlobalNode) -> bool {
        self.replicated.get(node.0).is_none_or(|is| *is)
    }

    /// Values of local nodes, selected from those of all nodes of bodies.
    pub(super) fn of_bodies<T: Copy>(&self, values: &[T]) -> Vec<T> {
        let nodes = self.nodes.iter().zip(values);
        let local = nodes.filter(|(local, _)| **local != NOWHERE);
        local.map(|(_, value)| *value).collect()
    }
}

/// Numbers of what is held, from 0 in its order.
fn numbered(held: impl Iterator<Item = bool>) -> Vec<u32> {
    let mut next = 0;
    let number = |held: bool| {
        let own = if held { next } else { NOWHERE };
        next += u32::from(held);
        own
    };
    held.map(number).collect()
}

/// `true` for nodes that all ranks hold: those of contact surfaces and tied surfaces, around the
/// ends of fibres, and tied to rigid bodies.
fn replicated(whole: &Frame, first_node: &[usize]) -> Vec<bool> {
    let mut replicated = vec![false; first_node[whole.model.bodies.len()]];
    let mut mark = |body: usize, node: NodeId| replicated[first_node[body] + node.index()] = true;
    for pair in &whole.pairs {
        for side in Side::BOTH {
            let surface = pair.contact.sides[side].surface();
            if let (Some(body), Some(surface)) = (pair.bodies[side], surface) {
                surface.nodes().iter().for_each(|node| mark(body, *node));
                let ends = pair.fibres[side].iter().flatten();
                ends.flat_map(|fibre| fibre.nodes)
                    .for_each(|node| mark(body, node));
            }
        }
    }
    tied_to_rigid(&whole.model).for_each(|(body, node)| mark(body, node));
    for node in whole
        .ties
        .joints
        .iter()
        .flat_map(|joint| &joint.nodes)
        .flatten()
    {
        replicated[*node] = true;
    }
    replicated
}

fn tied_to_rigid(model: &Model) -> impl Iterator<Item = (usize, NodeId)> {
    let ties = model.rigid_surfaces.iter().flat_map(|rigid| &rigid.ties);
    ties.flat_map(|(body, nodes)| nodes.iter().map(|node| (body.0, *node)))
}
