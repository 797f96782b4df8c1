//! Residuals of nodes that follow others in ties, see [`striae_model::tie`]; how their rows and
//! columns are eliminated, see [`super::ties`].

use super::System;
use striae_model::tie::Ties;

impl System<'_> {
    /// Turns the residuals of nodes that follow into those of the nodes that they follow, and
    /// notes what ties exert.
    pub(super) fn pass_on(&mut self) {
        let problem = self.context.problem;
        if problem.ties.is_empty() {
            return;
        }
        let mut forces = self.position_rows();
        for (follower, own) in problem.ties.pass_on(&mut forces) {
            Ties::react(follower, &own, &mut self.forces.ties);
        }
        self.put_position_rows(&forces);
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
