//! Work spent on linear systems, for reports and profiles.

use std::time::Duration;

use striae_condensed::{FallBack, Method};

/// Work spent on the linear systems of an increment.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LinearWork {
    /// Factorisations of the bodies; others of contact were made on older ones.
    pub factorisations: usize,
    /// Corrections of contact alone, on linearised bodies.
    pub contact_corrections: usize,
    /// Iterations of GMRES.
    pub krylov_iterations: usize,
    /// Method of the last factorisation.
    pub method: Method,
    /// Reason why the requested solver was not used in the last one.
    pub fall_back: Option<FallBack>,
    /// Time spent on each part.
    pub times: Times,
}

/// Time on the wall clock, for profiles only.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Times {
    /// Residuals and matrices.
    pub assembly: Duration,
    /// The part of contact in them: its evaluation, and its terms into the system.
    pub pairs: Duration,
    /// Orderings and plans.
    pub analysis: Duration,
    /// Factorisations.
    pub factorisation: Duration,
    /// Solutions with refinement.
    pub solution: Duration,
    /// Contact on linearised bodies: residuals, matrices and corrections.
    pub contact: Duration,
}
