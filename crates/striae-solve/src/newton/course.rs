//! Where an increment starts from: what the one before it leads to.
//!
//! In a step that goes on as it did, an increment of the size `dt` changes positions and
//! tractions about as the one before it, of the size `dt_0`, did:
//!
//! ```text
//! x = x_n + dt/dt_0 (x_n - x_(n-1))
//! ```
//!
//! The error is of the order `dt^2`, that of an iteration with the tangent at `x_n`. Newton's
//! method needs an iteration less from there; an increment that fails from there starts again
//! from `x_n`. What is prescribed, and what is tied to a rigid
//! body, is put where it belongs by the first correction and by the poses.

use serde::{Deserialize, Serialize};
use striae_mesh::Vec3;

use crate::{
    assembly::{StepContext, Trial},
    model::Strategy,
    rigid::Pose,
    state::State,
};

/// What an increment started from: a continued step starts the next one where both lead to,
/// `x_n + dt/dt_0 (x_n - x_(n-1))`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Course {
    /// Number of the step.
    pub step: usize,
    /// Time at its start.
    pub start: f64,
    /// Time at its end.
    pub end: f64,
    /// Positions of all nodes at its start.
    pub positions: Vec<Vec3>,
    /// Poses of rigid bodies at its start.
    pub rigid: Vec<Pose>,
    /// Tractions of nodes at its start, by pair and side.
    pub tractions: Vec<[Vec<[f64; 3]>; 2]>,
}

impl Course {
    /// The course of an increment from `state` to a time.
    pub(super) fn new(step: usize, state: &State, end: f64) -> Self {
        let tractions = state.pairs.iter().map(|pair| pair.tractions.nodes.clone());
        Self {
            step,
            start: state.time,
            end,
            positions: state.positions.clone(),
            rigid: state.rigid.clone(),
            tractions: tractions.collect(),
        }
    }

    /// Whether an increment from `state` continues this one.
    pub(super) fn leads_on(&self, context: &StepContext, state: &State) -> bool {
        let semismooth = context.problem.model.solver.strategy == Strategy::Semismooth;
        semismooth && self.step == context.index && self.end == state.time
    }

    /// Moves a trial state that is at `state` to where the course leads at a time.
    pub(super) fn follow(
        &self,
        context: &StepContext,
        state: &State,
        time: f64,
        trial: &mut Trial,
    ) {
        let ratio = (time - self.end) / (self.end - self.start);
        let on = |now: f64, before: f64| now + ratio * (now - before);
        for (rigid, pose) in trial.rigid.iter_mut().enumerate() {
            let (now, before) = (state.rigid[rigid], self.rigid[rigid].coordinates());
            // Driven bodies are where they are driven to.
            if *pose == now {
                let present = now.coordinates();
                *pose = now.moved_to(&std::array::from_fn(|at| on(present[at], before[at])));
            }
        }
        let problem = context.problem;
        for (node, position) in trial.positions.iter_mut().enumerate() {
            *position = match problem.tie_of[node] {
                Some(rigid) => {
                    let reference = &problem.model.rigid_surfaces[rigid].reference;
                    let placement = trial.rigid[rigid].placement(reference);
                    placement.point(&problem.reference[node])
                }
                None => {
                    let now = state.positions[node];
                    now + (now - self.positions[node]) * ratio
                }
            };
        }
        for (pair, tractions) in trial.tractions.iter_mut().enumerate() {
            for side in 0..2 {
                let now = &state.pairs[pair].tractions.nodes[side];
                let known = now.iter().zip(&self.tractions[pair][side]);
                for (unknowns, (now, before)) in tractions.nodes[side].iter_mut().zip(known) {
                    // Roles that change leave another field.
                    let pressed = now[0] > 0.0 && before[0] > 0.0;
                    if unknowns == now && pressed {
                        *unknowns = std::array::from_fn(|at| on(now[at], before[at]));
                    }
                }
            }
        }
    }
}
