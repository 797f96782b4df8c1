//! A deck run to its end, with progress and output.

use std::{
    path::Path,
    sync::{
        Arc,
        atomic::{AtomicBool, Ordering},
    },
};

use striae_contact::evaluation::Evaluation;
use striae_io::{OutputError, deck::Deck, recorder::Recorder, summary::Summary};
use striae_solve::{
    drive::{Continue, Observer, Progress as Position, run},
    newton::{Increment, IterationObserver},
    norms::Norms,
    outcome::{CutBack, Ending},
    problem::Problem,
    state::State,
};

use crate::{
    failure::Failure,
    progress::{Progress, Verbosity},
};

/// A finished run.
pub struct Simulation {
    /// The problem.
    pub problem: Problem,
    /// The last converged state.
    pub state: State,
    /// How the run ended.
    pub ending: Ending,
    /// What `summary.json` says.
    pub summary: Summary,
}

/// Set by the first interrupt; the second one ends the program.
#[derive(Clone, Default)]
pub struct Interrupt(Arc<AtomicBool>);

impl Interrupt {
    /// Listens to interrupts from the keyboard.
    pub fn listen() -> Self {
        let flag = Self::default();
        let set = flag.0.clone();
        // Without a handler an interrupt ends the program at once; results on disk stay valid.
        let _ = ctrlc::set_handler(move || {
            if set.swap(true, Ordering::Relaxed) {
                std::process::exit(130);
            }
            eprintln!("stopping after this increment; interrupt again to stop at once");
        });
        flag
    }

    fn is_set(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

/// Runs a deck and writes its output to `folder`.
///
/// # Errors
/// When the model cannot be solved or the output not be written.
pub fn simulate(
    deck: Deck,
    case: &str,
    folder: &Path,
    verbosity: Verbosity,
    interrupt: &Interrupt,
) -> Result<Simulation, Failure> {
    let output = deck.output;
    let problem = Problem::new(deck.model)?;
    let mut watch = Watch {
        problem: &problem,
        recorder: Recorder::create(folder, case, output)?,
        progress: Progress::new(&problem.model, verbosity),
        interrupt,
        failure: None,
    };
    let (state, ending) = run(&problem, State::undeformed(&problem), &mut watch);
    watch.progress.finish();
    let Watch {
        mut recorder,
        failure,
        ..
    } = watch;
    if let Some(failure) = failure {
        return Err(failure.into());
    }
    let summary = recorder.finish(&problem, &state, &ending)?;
    Ok(Simulation {
        problem,
        state,
        ending,
        summary,
    })
}

struct Watch<'a> {
    problem: &'a Problem,
    recorder: Recorder,
    progress: Progress,
    interrupt: &'a Interrupt,
    failure: Option<OutputError>,
}

impl IterationObserver for Watch<'_> {
    fn iteration(&mut self, number: usize, norms: &Norms, contacts: &[Evaluation]) {
        self.progress.iteration(number, norms, contacts);
    }
}

impl Observer for Watch<'_> {
    fn step(&mut self, _index: usize, _name: &str) {}

    fn increment(&mut self, position: Position, increment: &Increment) -> Continue {
        self.progress.increment(position, increment);
        self.failure = self
            .recorder
            .increment(self.problem, position, increment)
            .err();
        if self.failure.is_some() || self.interrupt.is_set() {
            Continue::Stop
        } else {
            Continue::Yes
        }
    }

    fn cut_back(&mut self, position: Position, reason: &CutBack) {
        self.recorder.cut_back();
        self.progress.cut_back(position, reason);
    }
}
