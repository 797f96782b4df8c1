//! Report that is updated during a run.

use std::{
    path::PathBuf,
    time::{Duration, Instant},
};

use striae::{Converged, Next, Observer};
use striae_contact::evaluation::Evaluation;
use striae_solve::{drive::Progress as Position, norms::Norms, outcome::CutBack};

use crate::progress::Progress;

/// Least time between two reports.
const PAUSE: Duration = Duration::from_secs(10);

/// Time between two reports over the time that one takes.
const SHARE: u32 = 20;

/// Shows progress and reports what is on disk, not more often than every [`PAUSE`] and
/// for at most one [`SHARE`]th of the time.
pub struct Reporting<'a> {
    /// Progress in the terminal.
    pub progress: &'a mut Progress,
    /// Folder of the results, if they are reported.
    pub folder: Option<PathBuf>,
    last: Instant,
    pause: Duration,
}

impl<'a> Reporting<'a> {
    /// Nothing has been reported yet.
    pub fn new(progress: &'a mut Progress, folder: Option<PathBuf>) -> Self {
        Self {
            progress,
            folder,
            last: Instant::now(),
            pause: PAUSE,
        }
    }

    fn report(&mut self) {
        let Some(folder) = self
            .folder
            .as_ref()
            .filter(|_| self.last.elapsed() > self.pause)
        else {
            return;
        };
        let started = Instant::now();
        // A report that cannot be made now does not end the run; the last one tells.
        let _ = striae_report::write(folder, &folder.join(striae_report::FILE));
        self.pause = PAUSE.max(started.elapsed() * SHARE);
        self.last = Instant::now();
    }
}

impl Observer for Reporting<'_> {
    fn iteration(&mut self, number: usize, norms: &Norms, contacts: &[Evaluation]) {
        self.progress.iteration(number, norms, contacts);
    }

    fn increment(&mut self, converged: &Converged<'_>) -> Next {
        let next = self.progress.increment(converged);
        self.report();
        next
    }

    fn cut_back(&mut self, position: Position, reason: &CutBack) -> Next {
        self.progress.cut_back(position, reason)
    }
}
