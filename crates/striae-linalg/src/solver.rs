//! What every solver offers: analyse once, factor per matrix, solve per right-hand side.

use crate::{error::SolveError, matrix::SparseMatrix, structure::Structure};
use thiserror::Error;

/// Reduction of the residual by a solution, unless another one is asked for.
pub const REDUCTION: f64 = 1e-6;

/// A solver of square sparse systems.
///
/// Every solution is refined with the given matrix and its residual is checked:
/// an answer that comes back with `Ok` is accurate to
/// [`SolveReport::backward_error`]. That is round-off but where the factors of
/// the interior are [stale](Interior::Stale) or the solver is iterative: there the
/// residual is reduced as far as is asked for.
pub trait LinearSolver: Send {
    /// Orders the unknowns and predicts the cost; forgets earlier factorisations.
    fn analyse(&mut self, structure: &Structure) -> Result<Analysis, SolveError>;

    /// Predicted costs of all methods it chooses between, in the order they are tried.
    fn estimates(&self, _structure: &Structure) -> Result<Vec<Analysis>, SolveError> {
        Ok(Vec::new())
    }

    /// Gives what has failed another try: matrices of another state come.
    fn start_afresh(&mut self) {}

    /// Forgets all factors, but not the analysis: matrices of another kind come.
    fn forget(&mut self) {}

    /// What earlier matrices have left that bears on the last digits of answers to come.
    fn experience(&self) -> Experience {
        Experience::default()
    }

    /// Takes up the experience of another solver with the same analysis.
    fn recall(&mut self, _experience: &Experience) {}

    /// Factors a matrix of the analysed structure.
    fn factor(&mut self, matrix: &SparseMatrix) -> Result<FactorReport, SolveError>;

    /// Solves `matrix x = rhs` with the last factorisation, to [`REDUCTION`] at least.
    ///
    /// `matrix` is the factored one or one close to it: the residual is that of
    /// `matrix`. The old content of `x` is not used.
    fn solve(
        &mut self,
        matrix: &SparseMatrix,
        rhs: &[f64],
        x: &mut [f64],
    ) -> Result<SolveReport, SolveError> {
        self.solve_to(matrix, rhs, x, REDUCTION)
    }

    /// Solves as [`solve`](Self::solve) does, with a residual reduced by `reduction`
    /// where it is not reduced to round-off.
    fn solve_to(
        &mut self,
        matrix: &SparseMatrix,
        rhs: &[f64],
        x: &mut [f64],
        reduction: f64,
    ) -> Result<SolveReport, SolveError>;

    /// Whether [`solve_other_contact`](Self::solve_other_contact) is worth a call now.
    fn has_interior(&self) -> bool {
        false
    }

    /// Solves `matrix x = rhs` where `matrix` differs from the last factored one in
    /// entries between kept supervariables only, on the factors of the interior there
    /// are and without refinement: for corrections that are checked by other means.
    ///
    /// `None` where there are no such factors after all.
    fn solve_other_contact(
        &mut self,
        _matrix: &SparseMatrix,
        _rhs: &[f64],
    ) -> Result<Option<Vec<f64>>, SolveError> {
        Ok(None)
    }
}

/// What earlier matrices have left in a solver.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Experience {
    /// Whether single precision has been found too coarse.
    pub too_coarse: bool,
    /// Iterations of GMRES that the factors took last.
    pub taken: usize,
    /// What the factors there are were made of.
    pub interior: Option<FactoredInterior>,
}

/// The interior of all bodies that was factored.
#[derive(Clone, Debug, PartialEq)]
pub struct FactoredInterior {
    /// Values of the scaled matrix, body by body.
    pub values: Vec<Vec<f64>>,
    /// Scale of every unknown.
    pub scales: Vec<f64>,
    /// Which unknowns are prescribed.
    pub prescribed: Vec<bool>,
    /// Whether the factors are in single precision.
    pub single: bool,
}

/// Predicted cost of a factorisation; zeros where the backend does not know.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Analysis {
    /// Entries of the factors.
    pub factor_entries: usize,
    /// Floating-point operations of one factorisation.
    pub flops: f64,
    /// Memory of factors and working space at its highest, in bytes.
    pub peak_bytes: usize,
    /// How matrices will be factored, if nothing forbids it.
    pub method: Method,
}

/// What a factorisation met.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FactorReport {
    /// Entries of the factors.
    pub factor_entries: usize,
    /// Pivots that were put off to a later front.
    pub delayed_pivots: usize,
    /// Pivots too small to divide by that were replaced.
    pub perturbed_pivots: usize,
    /// Order of the dense contact system of the condensed solver.
    pub dense_order: usize,
    /// How the matrix was factored.
    pub method: Method,
    /// Why the solver that was asked for was not used.
    pub fall_back: Option<FallBack>,
}

/// Ways to factor a matrix.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Method {
    /// Cholesky factorisation of the bodies, dense algebra for contact.
    Condensed,
    /// Multifrontal LU.
    #[default]
    Multifrontal,
    /// faer's sparse LU.
    Faer,
    /// GMRES with smoothed aggregation for the bodies.
    Iterative,
}

impl std::fmt::Display for Method {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Condensed => "condensed",
            Self::Multifrontal => "multifrontal",
            Self::Faer => "faer",
            Self::Iterative => "iterative",
        })
    }
}

/// Why another solver was used in the place of the one that was asked for.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
pub enum FallBack {
    /// Dense algebra on the interface would cost more.
    #[error("the interface has {unknowns} unknowns, too many for dense algebra")]
    LargeInterface {
        /// Bulk unknowns of the interface.
        unknowns: usize,
    },
    /// The interior of a body is not positive definite.
    #[error("the interior of a body is not positive definite (unknown {unknown})")]
    IndefiniteInterior {
        /// Unknown whose pivot failed.
        unknown: usize,
    },
    /// Factors of the bodies would take too much memory or time.
    #[error("factors would take {:.1} GB and {flops:.1e} operations, too many for a direct solver", *bytes as f64 / 1e9)]
    LargeBodies {
        /// Predicted memory in bytes.
        bytes: usize,
        /// Predicted operations of a factorisation.
        flops: f64,
    },
    /// There are so many unknowns that factors are not even planned.
    #[error("{unknowns} unknowns are too many for a direct solver")]
    ManyUnknowns {
        /// Unknowns of the system.
        unknowns: usize,
    },
    /// The preconditioner of the iterative solver could not be made.
    #[error("there is no preconditioner for the iterative solver")]
    NoPreconditioner,
    /// The iterative solver did not converge.
    #[error("the iterative solver did not converge")]
    NotConverged,
    /// The condensed contact system has no accurate factors.
    #[error("the condensed contact system is singular")]
    SingularContact,
    /// The bulk is too far from symmetric, or its factors are too inaccurate.
    #[error("the condensed solver left a backward error of {backward_error:.1e}")]
    Inaccurate {
        /// Componentwise backward error that remained.
        backward_error: f64,
    },
}

/// How accurate a solution is and what it took.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SolveReport {
    /// Componentwise backward error.
    pub backward_error: f64,
    /// Steps of iterative refinement.
    pub refinements: usize,
    /// Steps of GMRES, when refinement did not do or factors are older than the matrix.
    pub krylov_iterations: usize,
    /// Age of the factors of the interior.
    pub interior: Interior,
}

/// Age of the factors of the interior of the bodies.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Interior {
    /// They are of the matrix that is solved with.
    #[default]
    Fresh,
    /// They are of an earlier one and serve as a preconditioner.
    Stale,
}
