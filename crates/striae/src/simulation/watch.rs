//! Layer between a run and its observer.

use striae_contact::evaluation::Evaluation;
use striae_output::OutputError;
use striae_solve::{
    drive::{self, Continue, Point, Progress},
    newton::{Increment, IterationObserver, Workspace},
    norms::Norms,
    outcome::CutBack,
    problem::Problem,
    state::State,
};

use crate::{
    interrupt::Interrupt,
    log::Log,
    observer::{Converged, Next, Observer},
    results::Results,
    sensitivity::Followed,
};

/// Takes down a run, passes it on to the observer and stops it.
pub(super) struct Watch<'a> {
    pub(super) problem: &'a Problem,
    pub(super) log: Log,
    /// Neighbours for derivatives.
    pub(super) followed: Option<Followed>,
    pub(super) observer: &'a mut dyn Observer,
    pub(super) interrupt: Interrupt,
    /// States at the end of the steps.
    pub(super) steps: Vec<State>,
    /// State before the current increment.
    pub(super) before: State,
    /// Increments that have converged since the undeformed state.
    pub(super) increments: usize,
    /// Reason why nothing could be written any more.
    pub(super) failure: Option<OutputError>,
}

impl IterationObserver for Watch<'_> {
    fn iteration(&mut self, number: usize, norms: &Norms, contacts: &[Evaluation]) {
        self.observer.iteration(number, norms, contacts);
    }
}

impl drive::Observer for Watch<'_> {
    fn step(&mut self, index: usize, _name: &str) {
        if let Some(followed) = &mut self.followed {
            followed.step(index, self.before.time);
        }
    }

    fn converged(&mut self, progress: Progress, increment: &Increment, workspace: &Workspace) {
        if let Some(followed) = &mut self.followed {
            let taken_down = followed.increment(progress, increment, workspace);
            self.failure = self.failure.take().or(taken_down.err());
        }
    }

    fn increment(&mut self, progress: Progress, increment: &Increment) -> Continue {
        let next = self.observer.increment(&Converged {
            progress,
            increment,
            results: Results::new(self.problem, &increment.state),
        });
        if progress.fraction == 1.0 {
            self.steps.push(increment.state.clone());
        }
        self.log.judge(self.problem, &self.before, increment);
        self.before = increment.state.clone();
        self.increments = progress.increment;
        let taken_down = self.log.increment(self.problem, progress, increment);
        self.failure = self.failure.take().or(taken_down.err());
        if self.log.keeps(progress.increment) {
            self.proceed(next, Continue::Keep)
        } else {
            self.proceed(next, Continue::Yes)
        }
    }

    fn point(&mut self, point: Point) {
        if self.failure.is_none() {
            self.failure = self.log.point(self.problem, point).err();
        }
    }

    fn cut_back(&mut self, progress: Progress, reason: &CutBack) -> Continue {
        self.log.cut_back();
        if let Some(followed) = &mut self.followed {
            followed.cut_back(reason);
        }
        let next = self.observer.cut_back(progress, reason);
        self.proceed(next, Continue::Yes)
    }
}

impl Watch<'_> {
    /// Decision of a run that nothing stops.
    fn proceed(&self, next: Next, otherwise: Continue) -> Continue {
        if self.failure.is_some() || self.interrupt.is_set() || next == Next::Stop {
            Continue::Stop
        } else {
            otherwise
        }
    }
}
