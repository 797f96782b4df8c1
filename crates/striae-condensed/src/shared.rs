//! Systems that several ranks put together and solve together.
//!
//! Every rank has a part of the system on unknowns of its own numbering, and the system is
//! the sum of all parts. Unknowns at the borders belong to the parts of several ranks, and to
//! one of them they are its own.

use std::ops::Range;

use striae_sparse::{SolveError, SolveReport};

use crate::{Analysis, Factored, Partition, Tangent};

/// Numbers in the whole system of the unknowns of a part.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Numbering {
    /// Unknowns of the whole system.
    pub count: usize,
    /// Unknowns owned by this rank; the ranges of all ranks follow one another.
    pub own: Range<usize>,
    /// Number in the whole system of every unknown of the part.
    pub whole: Vec<usize>,
}

/// A solver of systems in parts. All functions are collective, and errors are the same on
/// all ranks: they name unknowns and rows by their numbers in the whole system.
pub trait SharedSolver: Send {
    /// Takes up a pattern. Unknowns may have other numbers than before.
    ///
    /// # Errors
    /// When the system cannot be solved at all, such as for lack of memory.
    fn analyse(
        &mut self,
        partition: &Partition,
        numbering: &Numbering,
    ) -> Result<Analysis, SolveError>;

    /// Factors the sum of the parts.
    ///
    /// # Errors
    /// When it is singular; the same on all ranks.
    fn factor(&mut self, part: &Tangent) -> Result<Factored, SolveError>;

    /// Solves for the last matrix that was factored, of which `part` is this rank's. `rhs` has
    /// the values of the whole right-hand side, not parts of sums, at all unknowns of the part;
    /// so has `x`, whose old content is not used.
    ///
    /// The residual becomes at most `reduction` times the right-hand side.
    ///
    /// # Errors
    /// When it does not; the same on all ranks.
    fn solve(
        &mut self,
        part: &Tangent,
        rhs: &[f64],
        x: &mut [f64],
        reduction: f64,
    ) -> Result<SolveReport, SolveError>;

    /// Forgets factors, for the sake of memory.
    fn forget(&mut self);
}
