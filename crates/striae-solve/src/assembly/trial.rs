//! A state under iteration.

use striae_contact::unknowns::Tractions;
use striae_mesh::Vec3;

use crate::{problem::Problem, rigid::Pose};

/// A state that is not converged.
#[derive(Clone, Debug)]
pub struct Trial {
    /// Position of every global node.
    pub positions: Vec<Vec3>,
    /// Traction unknowns of every pair.
    pub tractions: Vec<Tractions>,
    /// Poses of the rigid bodies.
    pub rigid: Vec<Pose>,
    /// Pressures in all cavities.
    pub pressures: Vec<f64>,
}

impl Trial {
    /// Puts nodes that are tied to rigid bodies, and those that follow others in ties, in place.
    pub(crate) fn place_tied(&mut self, problem: &Problem) {
        for (rigid, nodes) in problem.tied.iter().enumerate() {
            let reference = &problem.model.rigid_surfaces[rigid].reference;
            let placement = self.rigid[rigid].placement(reference);
            for &node in nodes {
                self.positions[node] = placement.point(&problem.reference[node]);
            }
        }
        problem.ties.follow(&mut self.positions);
    }
}
