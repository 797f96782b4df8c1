//! Predictions of a solver of the program's systems, and reports of its work.

use striae_sparse::{Cost, FactorReport};
use thiserror::Error;

/// Predicted cost of a factorisation by one of the methods.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Analysis {
    /// The cost.
    pub cost: Cost,
    /// Method by which matrices will be factored, unless something forbids it.
    pub method: Method,
}

/// Result of a factorisation.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Factored {
    /// Entries of the factors.
    pub factor_entries: usize,
    /// Order of the dense contact system of the condensed solver.
    pub dense_order: usize,
    /// Method by which the matrix was factored.
    pub method: Method,
    /// Reason why the requested solver was not used.
    pub fall_back: Option<FallBack>,
}

impl Factored {
    /// Report by a solver without contact.
    pub(crate) fn by(method: Method, report: FactorReport) -> Self {
        Self {
            factor_entries: report.factor_entries,
            method,
            ..Self::default()
        }
    }
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
    /// Multifrontal LU of MUMPS, on several ranks.
    Mumps,
}

impl std::fmt::Display for Method {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Condensed => "condensed",
            Self::Multifrontal => "multifrontal",
            Self::Faer => "faer",
            Self::Iterative => "iterative",
            Self::Mumps => "MUMPS",
        })
    }
}

/// Reason why another solver was used instead of the requested one.
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
