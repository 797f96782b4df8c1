//! Interface of all solvers: analyse once, factor per matrix, solve per right-hand side.

use crate::{
    error::SolveError, matrix::SparseMatrix, products::LinearOperator, structure::Structure,
};

/// A solver of square sparse systems.
///
/// Every solution is refined with the given matrix and its residual is checked: an
/// answer that comes back with `Ok` is accurate to [`SolveReport::backward_error`].
pub trait LinearSolver: Send + Sync {
    /// Orders the unknowns and predicts the cost; forgets earlier factorisations.
    fn analyse(&mut self, structure: &Structure) -> Result<Cost, SolveError>;

    /// Factors a matrix of the analysed structure.
    fn factor(&mut self, matrix: &SparseMatrix) -> Result<FactorReport, SolveError>;

    /// Solves `matrix x = rhs` with the last factorisation.
    ///
    /// `matrix` is the factored one or one close to it: the residual is that of
    /// `matrix`. The old content of `x` is not used.
    fn solve(
        &mut self,
        matrix: &dyn LinearOperator,
        rhs: &[f64],
        x: &mut [f64],
    ) -> Result<SolveReport, SolveError>;
}

/// Predicted cost of a factorisation; zeros where the backend does not know.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Cost {
    /// Entries of the factors.
    pub factor_entries: usize,
    /// Floating-point operations of one factorisation.
    pub flops: f64,
    /// Memory of factors and working space at its highest, in bytes.
    pub peak_bytes: usize,
}

/// Findings of a factorisation.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FactorReport {
    /// Entries of the factors.
    pub factor_entries: usize,
    /// Pivots that were put off to a later front.
    pub delayed_pivots: usize,
    /// Pivots too small to divide by that were replaced.
    pub perturbed_pivots: usize,
}

/// Accuracy and cost of a solution.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SolveReport {
    /// Componentwise backward error; with older factors the size of the residual of the
    /// equilibrated system over that of its right-hand side.
    pub backward_error: f64,
    /// Steps of iterative refinement.
    pub refinements: usize,
    /// Steps of GMRES, when refinement did not do or factors are older than the matrix.
    pub krylov_iterations: usize,
    /// Age of the factors.
    pub age: Age,
}

/// Age of factors.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Age {
    /// The factors are of the matrix that is solved with.
    #[default]
    Fresh,
    /// The factors are of an earlier matrix and serve as a preconditioner.
    Stale,
}
