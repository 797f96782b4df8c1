//! Corrections with the tangent of an earlier state, near the end of an increment.
//!
//! Newton's method squares the residual: it reduces `r_0` to `r_1 = C r_0^2`. A further correction
//! with the tangent and the factors at `r_0` leaves `C r_0 r_1`, so each one shrinks the residual
//! by `r_1 / r_0`. Where a few of them reach the tolerance, neither a tangent nor factors are
//! needed for them. So states that a small residual leads to are evaluated without derivatives;
//! where that does not bring the increment to its end, derivatives are evaluated after all.

use striae_contact::{segment::Derivatives, unknowns::Status};

use crate::{
    assembly::{Assembled, Imposed, StepContext, Trial},
    state::State,
};

/// Residual from which on a state is evaluated without derivatives first.
const LATE: f64 = 3e-3;
/// Number of corrections with an earlier tangent that cost as much as one with a new one.
const CORRECTIONS: i32 = 2;

/// Derivatives needed of the state that a correction from the residual `norm` leads to.
pub(super) fn wanted(norm: f64) -> Derivatives {
    match norm <= LATE {
        true => Derivatives::None,
        false => Derivatives::First,
    }
}

/// State that the tangent in the matrix belongs to, and start of the last correction.
#[derive(Debug, Default)]
pub(super) struct Chord {
    statuses: Vec<Status>,
    norm: f64,
}

impl Chord {
    /// A correction from a state, with its own tangent if it has one.
    pub(super) fn corrects(&mut self, assembled: &Assembled) {
        self.norm = assembled.norms.largest();
        if assembled.derivatives == Derivatives::First {
            self.statuses = statuses(assembled).collect();
        }
    }

    /// Returns whether a few more corrections with this tangent would bring a state within the
    /// tolerance.
    pub(super) fn serves(&self, assembled: &Assembled, tolerance: f64) -> bool {
        let norm = assembled.norms.largest();
        let rate = norm / self.norm;
        // Corrections with one tangent all reduce the residual by the rate of the last one.
        norm * rate.powi(CORRECTIONS) <= tolerance && self.holds(assembled)
    }

    /// Returns whether nodes still have the statuses of the tangent; other statuses have other
    /// rows.
    pub(super) fn holds(&self, assembled: &Assembled) -> bool {
        statuses(assembled).eq(self.statuses.iter().copied())
    }
}

/// Largest part of the way of a prescribed position that a trial state is away from it;
/// collective.
pub(super) fn share_to_go(
    context: &StepContext,
    trial: &Trial,
    state: &State,
    imposed: &Imposed,
) -> f64 {
    let ways = imposed.positions.iter().map(|&(node, axis, end)| {
        [&trial.positions, &state.positions]
            .map(|x| (end - context.along(node, axis, &x[node])).abs())
    });
    let mut most = ways.fold([0.0; 2], |sum: [f64; 2], way| {
        // The largest, not the mean: one node that still has to move is enough to distrust the
        // residual.
        [0, 1].map(|at| sum[at].max(way[at]))
    });
    context.problem.share.team().largest(&mut most);
    let [left, whole] = most;
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
