//! The observer of a run that Python listens to.

use std::sync::{
    Arc,
    mpsc::{Receiver, Sender},
};

use striae::{Converged, Next, Observer, solve::drive::Progress};

use crate::results::Kept;

/// Keeps states and reports them.
pub(super) struct Messenger {
    pub(super) told: Option<(Sender<Arc<Kept>>, Receiver<Next>)>,
    pub(super) keep: usize,
    pub(super) kept: Vec<Arc<Kept>>,
    /// The last increment and its iterations.
    pub(super) latest: Option<(Progress, usize)>,
}

impl Observer for Messenger {
    fn increment(&mut self, converged: &Converged<'_>) -> Next {
        let progress = converged.progress;
        let iterations = converged.increment.iterations.len();
        self.latest = Some((progress, iterations));
        let is_kept = match self.keep {
            0 => progress.fraction == 1.0,
            every => progress.increment.is_multiple_of(every),
        };
        if !is_kept && self.told.is_none() {
            return Next::Continue;
        }
        let kept = Arc::new(Kept {
            progress,
            iterations,
            state: converged.increment.state.clone(),
        });
        if is_kept {
            self.kept.push(kept.clone());
        }
        let Some((told, answers)) = &self.told else {
            return Next::Continue;
        };
        // Whoever asked for the run has gone if there is no answer.
        match told.send(kept) {
            Ok(()) => answers.recv().unwrap_or(Next::Stop),
            Err(_) => Next::Stop,
        }
    }
}
