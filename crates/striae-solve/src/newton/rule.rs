//! What an iteration goes by, and how far its linear system is solved.

use striae_condensed::REDUCTION;
use striae_contact::{
    complementarity::Iteration,
    table_1::{Corrector, Inflation},
};

use crate::model::Strategy;

/// What an iteration after the first one goes by.
pub(super) fn later(strategy: Strategy, inflation: Inflation, number: usize) -> Iteration {
    match strategy {
        Strategy::Semismooth => Iteration::Later {
            slip_weight: slip_weight(number),
        },
        Strategy::Table1 { stick_tolerance } => Iteration::Corrected(Corrector {
            stick_tolerance,
            inflation,
        }),
    }
}

/// `r_t` over its default. Cycles of first contact do not end with smaller increments, but
/// with another `r_t`, first a smaller and then a larger one.
fn slip_weight(number: usize) -> f64 {
    match number {
        0..=13 => 1.0,
        14..=26 => 0.03,
        _ => 10.0,
    }
}

/// Whether the friction of an iteration is the true one.
pub(super) fn is_final(iteration: Iteration) -> bool {
    match iteration {
        Iteration::First | Iteration::Later { .. } => true,
        Iteration::Corrected(corrector) => corrector.inflation.is_over(),
    }
}

/// Largest part of the residual that a correction leaves.
const LARGEST_PART: f64 = 1e-3;

/// Part of the residual that a correction may leave, after which the norm is about as
/// small as bodies that are not linear let it be.
pub(super) fn part(norm: Option<f64>, tolerance: f64) -> f64 {
    norm.map_or(REDUCTION, |norm| {
        (0.01 * norm).max(0.1 * tolerance / norm).min(LARGEST_PART)
    })
}
