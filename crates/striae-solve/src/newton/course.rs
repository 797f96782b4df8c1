//! Start of an increment, extrapolated from the previous ones.
//!
//! Within a step, positions and tractions change smoothly. An increment of the size `dt` starts
//! where the last state and the one or two before it in the same step lead to (one in dynamics),
//! `dt_0` being the size of the last increment and `t` its own end:
//!
//! ```text
//! x = x_n + dt/dt_0 (x_n - x_(n-1))                                 two states
//! x = x_n + c_1 (x_(n-1) - x_n) + c_2 (x_(n-2) - x_n)               three
//! c_1 = (t - t_n)(t - t_(n-2)) / ((t_(n-1) - t_n)(t_(n-1) - t_(n-2))),   c_2 with n-1, n-2 swapped
//! ```
//!
//! The error is of the order `dt^2` with two states, that of an iteration with the tangent at
//! `x_n`, and `dt^3` with three where the course is as smooth as that. With inertia it is not:
//! accelerations jump where contact changes, and a parabola would carry the jump on. Newton's
//! method needs an iteration or two less from there; an increment that fails from there starts
//! again from `x_n`. What is prescribed, and what is tied to a rigid body, is put where it
//! belongs by the first correction and by the poses.

use serde::{Deserialize, Serialize};
use striae_contact::side::Side;
use striae_mesh::Vec3;

use crate::{
    assembly::{StepContext, Trial},
    rigid::Pose,
    state::State,
};
use striae_model::Strategy;

/// Start of an increment: a continued step extrapolates from it to start the next one.
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
    /// The course of the increment before, if it belongs to the same step, which has no inertia.
    pub before: Option<Box<Course>>,
}

impl Course {
    /// The course of an increment from `state` to a time.
    pub(crate) fn new(step: usize, state: &State, end: f64, before: Option<Self>) -> Self {
        let tractions = state.pairs.iter().map(|pair| pair.tractions.nodes.clone());
        Self {
            step,
            start: state.time,
            end,
            positions: state.positions.clone(),
            rigid: state.rigid.clone(),
            tractions: tractions.collect(),
            before: before.map(|before| {
                Box::new(Self {
                    before: None,
                    ..before
                })
            }),
        }
    }

    /// Returns whether an increment from `state` continues this one.
    pub(super) fn leads_on(&self, context: &StepContext, state: &State) -> bool {
        let semismooth = context.problem.model.solver.strategy == Strategy::Semismooth;
        // Loads bend at the start of a step, and the paper's strategy predicts stick from the
        // converged state.
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
        let before = self.before.as_deref();
        let weights = Weights::new(self, time);
        for (rigid, pose) in trial.rigid.iter_mut().enumerate() {
            let now = state.rigid[rigid];
            // Driven bodies are where they are driven to.
            if *pose == now {
                let older = before.map(|before| before.rigid[rigid].coordinates());
                let (now_at, last) = (now.coordinates(), self.rigid[rigid].coordinates());
                let led = |at: usize| weights.on(now_at[at], last[at], older.map(|x| x[at]));
                *pose = now.moved_to(&std::array::from_fn(led));
            }
        }
        let problem = context.problem;
        for (node, position) in trial.positions.iter_mut().enumerate() {
            let (now, last) = (state.positions[node], self.positions[node]);
            let older = before.map(|before| before.positions[node]);
            *position = Vec3::from_fn(|at, _| weights.on(now[at], last[at], older.map(|x| x[at])));
        }
        // Extrapolated dependent nodes need not satisfy their ties.
        trial.place_tied(problem);
        for (pair, tractions) in trial.tractions.iter_mut().enumerate() {
            for side in Side::BOTH {
                let unknowns = tractions.nodes[side].iter_mut().enumerate();
                for (node, unknowns) in unknowns {
                    let now = state.pairs[pair].tractions.nodes[side][node];
                    let last = self.tractions[pair][side][node];
                    // Roles that change leave another field.
                    // A pressure that was zero has a kink, across which a line would predict
                    // tension.
                    if *unknowns == now && now[0] > 0.0 && last[0] > 0.0 {
                        let older = before.map(|before| before.tractions[pair][side][node]);
                        let older = older.filter(|older| older[0] > 0.0);
                        *unknowns = std::array::from_fn(|at| {
                            weights.on(now[at], last[at], older.map(|older| older[at]))
                        });
                    }
                }
            }
        }
    }
}

/// Weights of the last states.
struct Weights {
    /// `dt/dt_0`.
    ratio: f64,
    /// `c_1` and `c_2`.
    quadratic: [f64; 2],
}

impl Weights {
    fn new(course: &Course, time: f64) -> Self {
        let (now, last) = (course.end, course.start);
        let weight =
            |own: f64, other: f64| (time - now) * (time - other) / ((own - now) * (own - other));
        let quadratic = course.before.as_ref().map_or([0.0; 2], |before| {
            [weight(last, before.start), weight(before.start, last)]
        });
        Self {
            ratio: (time - now) / (now - last),
            quadratic,
        }
    }

    /// Extrapolation of a quantity from its last two or three values.
    fn on(&self, now: f64, last: f64, older: Option<f64>) -> f64 {
        let [c_1, c_2] = self.quadratic;
        match older {
            Some(older) => now + c_1 * (last - now) + c_2 * (older - now),
            None => now + self.ratio * (now - last),
        }
    }
}
