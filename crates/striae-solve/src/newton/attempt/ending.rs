//! Tests of whether the iterations have ended.

use striae_contact::segment::ON_EDGE;

use super::Attempt;
use crate::{assembly::Assembled, newton::cycling::WINDOW, norms::Norms, outcome::CutBack};

/// Criterion by which an increment was accepted.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Acceptance {
    /// Its residual is below the tolerance.
    #[default]
    Converged,
    /// The iterations oscillate across a jump of the integrals of contact, and no state is closer
    /// to a solution.
    AtJump {
        /// The residual that is left.
        residual: f64,
    },
}

impl Attempt<'_> {
    /// Returns whether the friction of all nodes is that of the law, up to the tolerance. Where it
    /// falls with the slip rate, rows of an iteration may state another one.
    pub(super) fn obeys_laws(&self, assembled: &Assembled) -> bool {
        let tolerance = self.context.problem.model.solver.tolerance;
        let mut contacts = self.context.pairs.iter().zip(&assembled.contacts);
        contacts.all(|(pair, contact)| {
            let largest = tolerance * pair.stress_scale(&contact.nodes);
            let mut nodes = contact.nodes.iter().flatten();
            nodes.all(|node| node.deviation <= largest)
        })
    }

    /// Returns whether the last iterations oscillate across a jump of the integrals of contact.
    ///
    /// A corner closer to an opposing edge than [`ON_EDGE`] of the facet counts as on it. The
    /// integrals of contact jump where a corner crosses that limit, by at most that part of the
    /// facet times its length. Newton's method can oscillate across the jump: the residual does not
    /// fall, no status changes, and the vertices of a polygon are alternately that corner and two
    /// crossings. No solution is closer than the jump then.
    pub(super) fn jumps(&self) -> bool {
        // The jump is at most that part of a facet; a larger residual has another cause.
        const LARGEST: f64 = 0.1 * ON_EDGE;
        let Some(from) = self.iterations.len().checked_sub(WINDOW) else {
            return false;
        };
        let last = self.iterations[from..].iter().map(Norms::largest);
        let least = last.clone().fold(f64::INFINITY, f64::min);
        let most = last.fold(0.0, f64::max);
        most <= LARGEST
            // A residual that still falls may get below the tolerance.
            && least > 0.5 * most
            && self.history.goes_back_and_forth()
            && self
                .history
                .cycling(self.context.problem, &self.selections)
                .is_empty()
    }

    /// Decides whether to continue, and returns the reason if not.
    pub(super) fn judge(&self, number: usize, norms: &Norms) -> Result<(), CutBack> {
        // The force norm is relative to the forces of the model, so 1e8 is out of reach of any
        // converging iteration.
        if !norms.largest().is_finite() || norms.force > 1e8 {
            return Err(CutBack::Diverged {
                iteration: number,
                norms: *norms,
            });
        }
        if number >= self.context.problem.model.solver.largest_iterations {
            return Err(CutBack::NoConvergence {
                iterations: number,
                norms: *norms,
                cycling: self.history.cycling(self.context.problem, &self.selections),
            });
        }
        Ok(())
    }
}
