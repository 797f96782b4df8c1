//! Everything that can go wrong, by name.

use crate::supervariable::Supervariable;
use thiserror::Error;

/// A structure that makes no sense.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
pub enum StructureError {
    /// The offsets do not start at zero or decrease.
    #[error(
        "offsets must start at 0 and not decrease, but offset {index} is {offset} (previous {previous})"
    )]
    Offsets {
        /// Position in the list of offsets.
        index: usize,
        /// Offset found there.
        offset: usize,
        /// Offset before it.
        previous: usize,
    },
    /// A clique names a supervariable that does not exist.
    #[error("clique {clique} names supervariable {}, but there are {count}", supervariable.0)]
    UnknownSupervariable {
        /// Position in the list of cliques.
        clique: usize,
        /// The supervariable.
        supervariable: Supervariable,
        /// Number of supervariables.
        count: usize,
    },
    /// The list of tiers has the wrong length.
    #[error("{found} tiers for {expected} supervariables")]
    Tiers {
        /// Length of the list.
        found: usize,
        /// Number of supervariables.
        expected: usize,
    },
}

/// An entry has no place in the pattern: grow the pattern and analyse again.
#[derive(Clone, Copy, Debug, Error, PartialEq, Eq)]
#[error("entry ({row}, {column}) is outside the pattern")]
pub struct OutsidePattern {
    /// Row of the entry.
    pub row: usize,
    /// Column of the entry.
    pub column: usize,
}

/// A linear system that was not solved.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
pub enum SolveError {
    /// No analysis of the structure of this matrix was made.
    #[error("the matrix does not have the structure that was analysed")]
    NotAnalysed,
    /// No factorisation was made, or the last one failed.
    #[error("there is no factorisation to solve with")]
    NotFactored,
    /// A vector has the wrong length.
    #[error("a vector of length {found} where {expected} is needed")]
    Length {
        /// Length found.
        found: usize,
        /// Number of unknowns.
        expected: usize,
    },
    /// An entry of the matrix or of the right-hand side is not a number.
    #[error("row {row} has an entry that is infinite or not a number")]
    NotFinite {
        /// Row of the entry.
        row: usize,
    },
    /// The matrix is singular to working precision.
    #[error(
        "singular matrix: unknown {unknown} is not determined, equation {equation} depends on others"
    )]
    Singular {
        /// Unknown with the largest component in the (right) null vector.
        unknown: usize,
        /// Equation with the largest component in the left null vector.
        equation: usize,
    },
    /// The matrix is not positive definite.
    #[error("not positive definite: pivot of unknown {unknown} is {pivot:e}")]
    NotPositiveDefinite {
        /// Unknown whose pivot fails.
        unknown: usize,
        /// The pivot, after equilibration to a unit diagonal.
        pivot: f64,
    },
    /// The iterative solver failed, and there is no memory for a direct one.
    #[error("the iterative solver failed, and a direct one would take {:.1} GB", *bytes as f64 / 1e9)]
    TooLarge {
        /// Predicted memory in bytes.
        bytes: usize,
    },
    /// Neither refinement nor GMRES reached a small residual.
    #[error("inaccurate solution: backward error {backward_error:e}")]
    Inaccurate {
        /// Componentwise backward error that remained.
        backward_error: f64,
    },
    /// The factorisation library failed.
    #[error("the {library} library failed (code {code})")]
    Library {
        /// Name of the library.
        library: &'static str,
        /// Its error code, or 0.
        code: i32,
    },
}
