//! Corrections with the tangent of an earlier state, near the end of an increment.
//!
//! Newton's method squares the residual: from `r_0` it comes to about `r = r_0^2`. A further
//! correction with the tangent and the factors at `r_0` leaves about `r_0 r`. Where `r_0` is
//! small that is below the tolerance, and neither a tangent nor factors are needed for it. So
//! states that a small residual leads to are evaluated without derivatives; where that does not
//! bring the increment to its end, derivatives are evaluated after all.

use striae_contact::{segment::Derivatives, unknowns::Status};

use crate::{
    assembly::{Assembled, Imposed, Trial},
    state::State,
};

/// Residual from which on a state is evaluated without derivatives first.
const LATE: f64 = 1e-4;
/// How much more than `r_0 r` a correction with an earlier tangent is taken to leave.
const MARGIN: f64 = 10.0;

/// What is wanted of the state that a correction from the residual `norm` leads to.
pub(super) fn wanted(norm: f64) -> Derivatives {
    match norm <= LATE {
        true => Derivatives::None,
        false => Derivatives::First,
    }
}

/// What the tangent is of that the matrix holds.
#[derive(Debug, Default)]
pub(super) struct Chord {
    norm: f64,
    statuses: Vec<Status>,
}

impl Chord {
    /// The tangent at a state that is evaluated with derivatives.
    pub(super) fn at(assembled: &Assembled) -> Self {
        Self {
            norm: assembled.norms.largest(),
            statuses: statuses(assembled).collect(),
        }
    }

    /// Whether a correction from a later state comes to the tolerance with it.
    pub(super) fn serves(&self, assembled: &Assembled, tolerance: f64) -> bool {
        MARGIN * self.norm * assembled.norms.largest() <= tolerance && self.holds(assembled)
    }

    /// Whether nodes have the statuses that they had then; rows of others are different ones.
    pub(super) fn holds(&self, assembled: &Assembled) -> bool {
        statuses(assembled).eq(self.statuses.iter().copied())
    }
}

/// Largest part of the way of a prescribed position that a trial state is away from it.
pub(super) fn share_to_go(trial: &Trial, state: &State, imposed: &Imposed) -> f64 {
    let ways = imposed.positions.iter().map(|&(node, axis, end)| {
        [&trial.positions, &state.positions].map(|x| (end - x[node][axis]).abs())
    });
    let [left, whole] = ways.fold([0.0; 2], |sum: [f64; 2], way| {
        [0, 1].map(|at| sum[at].max(way[at]))
    });
    if left > 0.0 {
        left / whole.max(left)
    } else {
        0.0
    }
}

/// Statuses of all nodes.
fn statuses(assembled: &Assembled) -> impl Iterator<Item = Status> {
    let contacts = assembled.contacts.iter();
    let nodes = contacts.flat_map(|contact| contact.nodes.iter().flatten());
    nodes.map(|node| node.status)
}
