//! Rules of an iteration, and accuracy to which its linear system is solved.

use striae_condensed::REDUCTION;
use striae_contact::{
    complementarity::Iteration,
    table_1::{Corrector, Inflation},
};

use striae_model::Strategy;

/// Iterations of the present problem: the rows of contact that are solved for are others once nodes
/// are chosen again, and earlier failures to converge do not concern them.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Ladder {
    /// Iterations made when it was posed.
    since: usize,
}

impl Ladder {
    /// Another problem is posed after so many iterations.
    pub(super) fn restart(&mut self, made: usize) {
        self.since = made;
    }

    /// Number of the iteration that follows so many in all.
    pub(super) fn next(self, made: usize) -> usize {
        made + 1 - self.since
    }
}

/// Rules of an iteration after the first one of the increment.
pub(super) fn later(strategy: Strategy, inflation: Inflation, number: usize) -> Iteration {
    match strategy {
        Strategy::Semismooth => Iteration::later(number),
        Strategy::Table1 { stick_tolerance } => Iteration::Corrected(Corrector {
            stick_tolerance,
            inflation,
        }),
    }
}

/// Returns whether the friction of an iteration is the true one.
pub(super) fn is_final(iteration: Iteration) -> bool {
    match iteration {
        Iteration::First | Iteration::Later(_) | Iteration::Given => true,
        Iteration::Corrected(corrector) => corrector.inflation.is_over(),
    }
}

/// Largest part of the residual that a correction leaves.
const LARGEST_PART: f64 = 1e-3;

/// Part of the residual that a correction may leave, after which the norm is about as
/// small as bodies that are not linear let it be.
pub(super) fn part(norm: Option<f64>, tolerance: f64) -> f64 {
    norm.map_or(REDUCTION, |norm| {
        // Quadratic convergence squares the norm, so a hundredth of it is enough; beyond the
        // tolerance accuracy is wasted.
        (0.01 * norm).max(0.1 * tolerance / norm).min(LARGEST_PART)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_problem_that_is_posed_late_starts_with_newtons_method() {
        let mut ladder = Ladder::default();
        let next = |ladder: Ladder, made: usize| Iteration::later(ladder.next(made));
        let [first, second, third] = [0, 20, 40].map(|made| next(ladder, made));
        assert_eq!(first, Iteration::LATER);
        assert!(first != second && second != third);
        ladder.restart(30);
        assert_eq!(
            [30, 42, 43, 60].map(|made| next(ladder, made)),
            [first, first, second, third]
        );
    }
}
