//! Watching a run, and stopping it.

use striae_contact::evaluation::Evaluation;
use striae_solve::{drive::Progress, newton::Increment, norms::Norms, outcome::CutBack};

use crate::results::Results;

/// Told of everything that happens in a run. Every method may be left out.
pub trait Observer {
    /// An iteration of Newton's method has been evaluated.
    fn iteration(&mut self, number: usize, norms: &Norms, contacts: &[Evaluation]) {
        let _ = (number, norms, contacts);
    }

    /// An increment has converged.
    fn increment(&mut self, converged: &Converged<'_>) -> Next {
        let _ = converged;
        Next::Continue
    }

    /// An increment has failed and is tried again with a smaller one.
    fn cut_back(&mut self, progress: Progress, reason: &CutBack) -> Next {
        let _ = (progress, reason);
        Next::Continue
    }
}

/// An observer that ignores everything.
impl Observer for () {}

/// Decision whether a run continues.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Next {
    /// The run continues.
    Continue,
    /// The run ends after this increment, as if it had been interrupted.
    Stop,
}

/// A converged increment.
#[derive(Clone, Copy, Debug)]
pub struct Converged<'a> {
    /// Position of the run.
    pub progress: Progress,
    /// Iterations, and what the linear systems took.
    pub increment: &'a Increment,
    /// Results at its end.
    pub results: Results<'a>,
}
