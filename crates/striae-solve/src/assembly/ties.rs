//! Nodes tied to rigid bodies, eliminated.
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
//! with the force `F` and the torque `M` that drive or hold the body. Turning the
//! arms gives the tangent `d(r x h) = (dphi x r) x h`.

use nalgebra::Matrix3;
use striae_linalg::{OutsidePattern, Supervariable};
use striae_mesh::Vec3;

use super::{Imposed, System, Trial};
use crate::{problem::Problem, rigid::turn_tangent};

/// An unknown or an equation before ties are eliminated.
#[derive(Clone, Copy, Debug)]
pub(super) struct Slot {
    pub(super) unknown: usize,
    /// Node and component of a position.
    pub(super) position: Option<(usize, usize)>,
}

/// How a tied node follows its body.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tie {
    rigid: usize,
    first: usize,
    arm: Vec3,
    tangent: Matrix3<f64>,
}

/// What slots become: equations or unknowns, and their weights by slot.
struct Spread {
    targets: Vec<usize>,
    weights: Vec<Vec<(usize, f64)>>,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    Row,
    Column,
}

impl Tie {
    /// Change of the node's position with the body's coordinates.
    pub(super) fn followed_by(&self, change: &[f64]) -> Vec3 {
        let at = |first: usize| Vec3::from_column_slice(&change[first..first + 3]);
        at(self.first) + (self.tangent * at(self.first + 3)).cross(&self.arm)
    }
}

impl System<'_> {
    /// Ties of all nodes at a trial state; empty where nothing is tied.
    pub(super) fn find_ties(&mut self, trial: &Trial, imposed: &Imposed) {
        let problem = self.context.problem;
        if problem.tied.iter().all(Vec::is_empty) {
            return;
        }
        self.ties = vec![None; problem.reference.len()];
        for (rigid, nodes) in problem.tied.iter().enumerate() {
            let Some(first) = self.layout.rigid(rigid) else {
                continue;
            };
            let pose = &trial.rigid[rigid];
            let point = problem.model.rigid_surfaces[rigid].reference + pose.displacement;
            let tangent = turn_tangent(&(pose.turned - imposed.before[rigid].turned));
            for &node in nodes {
                self.ties[node] = Some(Tie {
                    rigid,
                    first,
                    arm: trial.positions[node] - point,
                    tangent,
                });
            }
        }
    }

    pub(super) fn tie(&self, node: usize) -> Option<&Tie> {
        self.ties.get(node).and_then(Option::as_ref)
    }

    /// Supervariable that a position of a node belongs to.
    pub(super) fn owner(&self, node: usize) -> Supervariable {
        self.layout.owner(self.context.problem, node)
    }

    /// Adds a block to the matrix, with ties eliminated.
    pub(super) fn scatter(
        &mut self,
        rows: &[Slot],
        columns: &[Slot],
        block: &[f64],
    ) -> Result<(), OutsidePattern> {
        let tied = |slot: &Slot| {
            let position = slot.position;
            position.is_some_and(|(node, _)| self.tie(node).is_some())
        };
        if !rows.iter().chain(columns).any(tied) {
            let unknowns = |slots: &[Slot]| slots.iter().map(|s| s.unknown).collect::<Vec<_>>();
            return self.matrix.add(&unknowns(rows), &unknowns(columns), block);
        }
        let rows = self.spread(rows, Kind::Row);
        let columns = self.spread(columns, Kind::Column);
        let width = columns.targets.len();
        let mut spread = vec![0.0; rows.targets.len() * width];
        for (row, row_weights) in rows.weights.iter().enumerate() {
            for (column, column_weights) in columns.weights.iter().enumerate() {
                let value = block[row * columns.weights.len() + column];
                for (at_row, in_row) in row_weights {
                    for (at_column, in_column) in column_weights {
                        spread[at_row * width + at_column] += in_row * in_column * value;
                    }
                }
            }
        }
        self.matrix.add(&rows.targets, &columns.targets, &spread)
    }

    fn spread(&self, slots: &[Slot], kind: Kind) -> Spread {
        let followed: Vec<Vec<(usize, f64)>> =
            slots.iter().map(|slot| self.followed(slot, kind)).collect();
        let mut targets: Vec<usize> = followed.iter().flatten().map(|entry| entry.0).collect();
        targets.sort_unstable();
        targets.dedup();
        let at = |unknown: usize| targets.partition_point(|&target| target < unknown);
        let weights = followed
            .into_iter()
            .map(|entries| entries.into_iter().map(|(u, w)| (at(u), w)).collect())
            .collect();
        Spread { targets, weights }
    }

    /// What a slot stands for, with weights.
    fn followed(&self, slot: &Slot, kind: Kind) -> Vec<(usize, f64)> {
        let tie = slot
            .position
            .and_then(|(node, axis)| Some((self.tie(node)?, axis)));
        let Some((tie, axis)) = tie else {
            return vec![(slot.unknown, 1.0)];
        };
        let mut entries = Vec::with_capacity(4);
        entries.push((tie.first + axis, 1.0));
        for turn in 0..3 {
            let spin = match kind {
                Kind::Row => Vec3::ith(turn, 1.0),
                Kind::Column => tie.tangent.column(turn).into(),
            };
            let weight = spin.cross(&tie.arm)[axis];
            if weight != 0.0 {
                entries.push((tie.first + 3 + turn, weight));
            }
        }
        if kind == Kind::Row {
            let fixed = &self.context.fixed_rigid[tie.rigid];
            entries.retain(|(unknown, _)| !fixed[unknown - tie.first]);
        }
        entries
    }

    /// Turns the residuals of tied nodes into those of their bodies, with the tangent
    /// of their arms.
    pub(super) fn condense(&mut self, imposed: &Imposed) {
        for (rigid, turning) in self.condense_forces(imposed) {
            self.add_turning(rigid, &turning);
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
            self.forces.rigid[rigid].force = force / share;
            self.forces.rigid[rigid].torque = torque / share;
            let driving = imposed.driving[rigid];
            let rows = [
                force - driving.force * share,
                torque - driving.torque * share,
            ];
            for axis in 0..3 {
                self.residual[first + axis] = rows[0][axis];
                self.residual[first + 3 + axis] = rows[1][axis];
            }
            all.push((rigid, turning));
        }
        all
    }

    fn add_turning(&mut self, rigid: usize, turning: &Matrix3<f64>) {
        let Some(first) = self.layout.rigid(rigid) else {
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
                .fold(f64::MIN_POSITIVE, f64::max);
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
    let bodies = problem.model.bodies.iter();
    bodies
        .map(|body| body.material.lame_constants().shear)
        .fold(f64::MIN_POSITIVE, f64::max)
}
