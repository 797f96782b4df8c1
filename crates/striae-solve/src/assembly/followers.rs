//! Residuals of nodes that follow others in ties, see [`crate::tie`]; how their rows and
//! columns are eliminated, see [`super::ties`].

use striae_mesh::Vec3;

use super::System;
use crate::{node::GlobalNode, tie::Ties};

impl System<'_> {
    /// Turns the residuals of nodes that follow into those of the nodes that they follow, and
    /// notes what ties exert.
    pub(super) fn pass_on(&mut self) {
        let problem = self.context.problem;
        if problem.ties.is_empty() {
            return;
        }
        let place = |node: GlobalNode| self.layout.position(node);
        let mut forces: Vec<Vec3> = problem
            .global_nodes()
            .map(|node| Vec3::from_column_slice(&self.residual[place(node)..place(node) + 3]))
            .collect();
        for (follower, own) in problem.ties.pass_on(&mut forces) {
            Ties::react(follower, &own, &mut self.forces.ties);
        }
        for (node, force) in problem.global_nodes().zip(&forces) {
            let first = place(node);
            self.residual[first..first + 3].copy_from_slice(force.as_slice());
        }
    }

    /// Holds the positions of nodes that follow, which are no unknowns.
    pub(super) fn hold_followers(&mut self) {
        for follower in self.context.problem.ties.followers() {
            let first = self.layout.position(follower.node);
            for axis in (0..3).filter(|&axis| follower.row[axis].is_some()) {
                self.hold(first + axis, 0.0, 1.0);
            }
        }
    }
}
