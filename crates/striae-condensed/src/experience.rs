//! What earlier matrices have left in a solver.

use serde::{Deserialize, Serialize};
/// What bears on the last digits of answers to come.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Experience {
    /// Whether single precision has been found too coarse.
    pub too_coarse: bool,
    /// Iterations of GMRES that the factors took last.
    pub taken: usize,
    /// What the factors there are were made of.
    pub interior: Option<FactoredInterior>,
}

/// The interior of all bodies that was factored.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
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
