//! Solvers of the linear systems of bodies in contact, on one rank or on several together.
//!
//! Several ranks have a part of the system each, on unknowns of its own numbering, and the system is
//! the sum of all parts. Unknowns at the borders belong to the parts of several ranks, and to
//! one of them they are its own.

use striae_sparse::{SolveError, SolveReport};

use crate::{Analysis, Experience, Factored, FactoredInterior, Partition, Tangent};

/// A solver of linear systems with a [partition](Partition).
///
/// All functions are collective if several ranks solve a system together, and errors are then the
/// same on all ranks: they name unknowns and rows by their numbers in the whole system.
pub trait TangentSolver: Send {
    /// Takes up a pattern. Unknowns may have other numbers than before.
    ///
    /// # Errors
    /// When the system cannot be solved at all, such as for lack of memory.
    fn analyse(&mut self, partition: &Partition) -> Result<Analysis, SolveError>;

    /// Factors a tangent of that pattern, the sum of the parts of all ranks.
    ///
    /// # Errors
    /// When it is singular.
    fn factor(&mut self, tangent: &Tangent) -> Result<Factored, SolveError>;

    /// Solves for `tangent`, the last one that was factored or one close to it. `rhs` has the values
    /// of the whole right-hand side, not parts of sums, at all unknowns of the part; so has `x`,
    /// whose old content is not used.
    ///
    /// The residual becomes at most `reduction` times the right-hand side.
    ///
    /// # Errors
    /// When it does not.
    fn solve_to(
        &mut self,
        tangent: &Tangent,
        rhs: &[f64],
        x: &mut [f64],
        reduction: f64,
    ) -> Result<SolveReport, SolveError>;

    /// Forgets factors, for the sake of memory.
    fn forget(&mut self);

    /// Gives what has failed another try: tangents of another state come.
    fn start_afresh(&mut self) {}

    /// Solves for a tangent close to the one that was factored, without a change for later ones;
    /// `None` where the factors do not serve.
    ///
    /// # Errors
    /// When `rhs` or `x` do not fit.
    fn solve_beside(
        &self,
        _tangent: &Tangent,
        _rhs: &[f64],
        _x: &mut [f64],
        _reduction: f64,
    ) -> Result<Option<SolveReport>, SolveError> {
        Ok(None)
    }

    /// Returns whether there are factors of the bodies with which contact alone can be corrected.
    fn has_interior(&self) -> bool {
        false
    }

    /// Solves with another contact on older factors of the bodies; `None` where there are none.
    ///
    /// # Errors
    /// When the contact system cannot be solved.
    fn solve_other_contact(
        &mut self,
        _tangent: &Tangent,
        _rhs: &[f64],
    ) -> Result<Option<Vec<f64>>, SolveError> {
        Ok(None)
    }

    /// Returns experience from earlier tangents, and the interior that the older factors were made
    /// of.
    fn experience(&self) -> (Experience, Option<FactoredInterior>) {
        (Experience::default(), None)
    }

    /// Takes up what a solver has learnt from systems of the same pattern.
    fn recall(&mut self, _experience: &Experience, _interior: Option<&FactoredInterior>) {}
}
