//! Experience from earlier matrices, for the choice of a solver.

use crate::report::FallBack;
use serde::{Deserialize, Serialize};

/// Factorisations by other solvers after a failure before one is tried again.
const PATIENCE: usize = 8;

/// Experience from earlier matrices, for the choice of a solver. The choice affects the last digits
/// of later solutions.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Experience {
    /// `true` if single precision has been found too coarse.
    pub too_coarse: bool,
    /// Iterations of GMRES that the factors took last.
    pub taken: usize,
    /// Reason why the last failure, or the analysis, led to another solver.
    #[serde(skip)]
    pub(crate) fall_back: Option<FallBack>,
    /// Factorisations by LU before the condensed solver is tried again.
    #[serde(skip)]
    pub(crate) patience: usize,
    /// Factorisations by direct solvers before the iterative one is tried again.
    #[serde(skip)]
    pub(crate) rest: usize,
}

impl Experience {
    /// Part of the experience that holds for matrices of another pattern.
    pub fn of_other_pattern(&self) -> Self {
        Self {
            too_coarse: self.too_coarse,
            ..Self::default()
        }
    }

    /// The condensed solver has failed: others have their turns.
    pub(crate) fn condensed_failed(&mut self, reason: FallBack) {
        (self.fall_back, self.patience) = (Some(reason), PATIENCE);
    }

    /// The iterative solver has failed: others have their turns.
    pub(crate) fn iterative_failed(&mut self, reason: FallBack) {
        (self.fall_back, self.rest) = (Some(reason), PATIENCE);
    }

    /// Forgets failures, so that the methods that failed are tried again.
    pub(crate) fn forgive(&mut self) {
        (self.patience, self.rest) = (0, 0);
    }
}

/// The interior of all bodies that was factored.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FactoredInterior {
    /// Values of the scaled matrix, body by body.
    pub values: Vec<Vec<f64>>,
    /// Scale of every unknown.
    pub scales: Vec<f64>,
    /// Unknowns that are prescribed.
    pub prescribed: Vec<bool>,
    /// `true` if the factors are in single precision.
    pub single: bool,
}
