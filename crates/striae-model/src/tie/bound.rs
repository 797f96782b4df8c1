//! Prescribed displacements of the nodes of ties.

use crate::{model::Model, node::GlobalNode};

/// Restraint of each component of each node.
pub(super) struct Bound {
    /// By component, three a node.
    prescribed: Vec<bool>,
}

impl Bound {
    pub(super) fn new(model: &Model, first_node: &[usize]) -> Self {
        let mut prescribed = vec![false; 3 * first_node[model.bodies.len()]];
        for condition in model.steps.iter().flat_map(|step| &step.displacements) {
            for node in &condition.nodes {
                let first = 3 * (first_node[condition.body.0] + node.index());
                if !condition.axes.are_global() {
                    prescribed[first..first + 3].fill(true);
                }
                for axis in (0..3).filter(|&axis| condition.components[axis].is_some()) {
                    prescribed[first + axis] = true;
                }
            }
        }
        for (body, nodes) in model.rigid_surfaces.iter().flat_map(|rigid| &rigid.ties) {
            for node in nodes {
                let first = 3 * (first_node[body.0] + node.index());
                prescribed[first..first + 3].fill(true);
            }
        }
        Self { prescribed }
    }

    pub(super) fn component(&self, node: GlobalNode, axis: usize) -> bool {
        self.prescribed[node.component(axis)]
    }

    pub(super) fn wholly(&self, node: GlobalNode) -> bool {
        (0..3).all(|axis| self.component(node, axis))
    }
}
