//! Nodes that follow others in ties and nodes tied to rigid bodies, eliminated.
//!
//! Rows of a node that follows become rows of the nodes that it follows, and columns alike,
//! by its constant weights, see [`striae_model::tie`]. These may be tied to a rigid body in turn.
//!
//! Position unknowns of a tied node are no unknowns of the system: rows that
//! belong to them become rows of the body, `sum f` and `sum r x f`, and columns
//! become columns of its coordinates, `dx = du + (T dt) x r`. The forces `h` that
//! hold the tied nodes follow the average that time integration makes of internal
//! forces, `f = (1 - a_f) h_1 + a_f h_0`, so the rows are
//!
//! ```text
//! sum (f - a_f h_0) = (1 - a_f) F_1,    sum r x (f - a_f h_0) = (1 - a_f) M_1
//! ```
//!
//! with the force `F` and the torque `M` that drive or hold the body. Turning the arms gives the
//! tangent `d(r x h) = (dphi x r) x h`. The force of contact, see `pushed`, is added to `F` and
//! `M`, fully at the end.

use nalgebra::Matrix3;
use striae_contact::segment::Derivatives;
use striae_mesh::Vec3;

use super::{Imposed, System, Trial};
use crate::{
    problem::Problem,
    rigid::{Wrench, turn_tangent},
};
use striae_model::node::GlobalNode;

use crate::composition::Composition;

/// Dependence of a tied node on its body.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tie {
    pub(super) rigid: usize,
    pub(super) first: usize,
    pub(super) arm: Vec3,
    pub(super) tangent: Matrix3<f64>,
}

/// A rigid body whose coordinates are unknowns.
#[derive(Clone, Copy, Debug)]
pub(super) struct Moving {
    rigid: usize,
    first: usize,
    /// Position of the reference point.
    point: Vec3,
    tangent: Matrix3<f64>,
}

impl Moving {
    /// Tie of a point at `x` to the body.
    pub(super) fn tie(&self, x: &Vec3) -> Tie {
        Tie {
            rigid: self.rigid,
            first: self.first,
            arm: x - self.point,
            tangent: self.tangent,
        }
    }
}

impl Tie {
    /// Change of the node's position with the body's coordinates.
    pub(super) fn followed_by(&self, change: &[f64]) -> Vec3 {
        let at = |first: usize| Vec3::from_column_slice(&change[first..first + 3]);
        at(self.first) + (self.tangent * at(self.first + 3)).cross(&self.arm)
    }
}

impl System<'_> {
    /// Moving bodies and ties of all nodes at a trial state; no ties where nothing is tied.
    pub(super) fn find_ties(&mut self, trial: &Trial, imposed: &Imposed) {
        let problem = self.context.problem;
        let moving = (0..problem.tied.len()).map(|rigid| {
            let pose = &trial.rigid[rigid];
            Some(Moving {
                rigid,
                first: self.layout.rigid(rigid)?,
                point: problem.model.rigid_surfaces[rigid].reference + pose.displacement,
                tangent: turn_tangent(&(pose.turned - imposed.before[rigid].turned)),
            })
        });
        self.moving = moving.collect();
        if problem.tied.iter().all(Vec::is_empty) {
            return;
        }
        self.ties = vec![None; problem.reference.len()];
        for (moving, nodes) in self.moving.iter().zip(&problem.tied) {
            let Some(moving) = moving else { continue };
            for &node in nodes {
                self.ties[node] = Some(moving.tie(&trial.positions[node]));
            }
        }
    }

    pub(super) fn tie(&self, node: GlobalNode) -> Option<&Tie> {
        self.ties.get(node.0).and_then(Option::as_ref)
    }

    /// Returns whether the coordinates of a node are no unknowns of their own.
    pub(super) fn is_bound(&self, node: GlobalNode) -> bool {
        self.tie(node).is_some()
            || self.context.problem.ties.follower(node).is_some()
            || self.context.turned.frame(node).is_some()
    }

    /// Turns the residuals of tied nodes into those of their bodies, with the tangent
    /// of their arms.
    pub(super) fn condense(&mut self, imposed: &Imposed) {
        for (rigid, turning) in self.condense_forces(imposed) {
            if self.derivatives == Derivatives::First {
                self.add_turning(rigid, &turning);
            }
        }
    }

    /// Turns the residuals of tied nodes into those of their bodies; returns how
    /// their torques change as the angles do.
    pub(super) fn condense_forces(&mut self, imposed: &Imposed) -> Vec<(usize, Matrix3<f64>)> {
        let mut all = Vec::new();
        let share = self.inertia.share_of_end;
        let problem = self.context.problem;
        for (rigid, nodes) in problem.tied.iter().enumerate() {
            let Some(first) = self.layout.rigid(rigid) else {
                continue;
            };
            let (mut force, mut torque) = (Vec3::zeros(), Vec3::zeros());
            let mut turning = Matrix3::zeros();
            for &node in nodes {
                let Some(tie) = self.ties[node] else { continue };
                let at = self.layout.position(node);
                let mut held = Vec3::from_column_slice(&self.residual[at..at + 3]);
                if let Some(motion) = &imposed.motion {
                    held -= motion.held(node);
                }
                force += held;
                torque += tie.arm.cross(&held);
                let slope = tie.arm * held.transpose() - Matrix3::identity() * held.dot(&tie.arm);
                turning += slope * tie.tangent;
                self.forces.reaction[node] = held / share;
                for axis in 0..3 {
                    self.hold(at + axis, 0.0, 1.0);
                }
            }
            let held = Wrench { force, torque };
            let carried = imposed.motion.as_ref().map(|motion| motion.pushed(rigid));
            let carried = carried.unwrap_or_default();
            let [held, carried, pushed, driving] = [
                held,
                carried,
                self.forces.pushed[rigid],
                imposed.driving[rigid],
            ]
            .map(|wrench| wrench.components());
            let mut found = [0.0; 6];
            for at in 0..6 {
                let whole = held[at] + pushed[at] - carried[at];
                self.residual[first + at] = whole - driving[at] * share;
                found[at] = if self.context.fixed_rigid[rigid][at] {
                    held[at] / share + pushed[at]
                } else {
                    whole / share
                };
            }
            self.forces.rigid[rigid] = Wrench::from_components(&found);
            all.push((rigid, turning));
        }
        all
    }

    fn add_turning(&mut self, rigid: usize, turning: &Matrix3<f64>) {
        let Some(first) = self.layout.rigid(rigid).filter(|first| self.owns(*first)) else {
            return;
        };
        for row in 0..3 {
            if self.context.fixed_rigid[rigid][3 + row] {
                continue;
            }
            for column in 0..3 {
                let (row_at, column_at) = (first + 3 + row, first + 3 + column);
                self.matrix
                    .add(&[row_at], &[column_at], &[turning[(row, column)]])
                    .expect("the unknowns of a body are in the pattern");
            }
        }
    }

    /// Sum of squares of the residuals of free coordinates, torques over the
    /// longest arm.
    pub(super) fn free_squares(&self) -> f64 {
        let mut sum = 0.0;
        for (rigid, nodes) in self.context.problem.tied.iter().enumerate() {
            let Some(first) = self.layout.rigid(rigid) else {
                continue;
            };
            let arms = nodes.iter().filter_map(|&node| self.tie(node));
            let longest = arms
                .map(|tie| tie.arm.norm())
                .fold(self.longest_push[rigid].max(f64::MIN_POSITIVE), f64::max);
            for at in (0..6).filter(|&at| !self.context.fixed_rigid[rigid][at]) {
                let arm = if at < 3 { 1.0 } else { longest };
                sum += (self.residual[first + at] / arm).powi(2);
            }
        }
        sum
    }

    /// Holds the prescribed coordinates of bodies.
    pub(super) fn prescribe_rigid(&mut self, trial: &Trial, imposed: &Imposed) {
        let scale = stiffest(self.context.problem);
        for rigid in 0..imposed.rigid.len() {
            let Some(first) = self.layout.rigid(rigid) else {
                continue;
            };
            let present = trial.rigid[rigid].coordinates();
            for at in 0..6 {
                if let Some(target) = imposed.rigid[rigid][at] {
                    self.hold(first + at, (present[at] - target) * scale, scale);
                }
            }
        }
    }
}

fn stiffest(problem: &Problem) -> f64 {
    let bodies = problem.compositions.iter();
    bodies
        .map(Composition::stiffest_shear)
        .fold(f64::MIN_POSITIVE, f64::max)
}
