//! A deck run to its end, with progress and output.

use std::{
    path::Path,
    sync::{
        Arc,
        atomic::{AtomicBool, Ordering},
    },
};

use striae_contact::evaluation::Evaluation;
use striae_deck::Deck;
use striae_output::{
    OutputError,
    checkpoint::{Checkpoint, CheckpointError, Source},
    recorder::Recorder,
    summary::Summary,
};
use striae_solve::{
    drive::{Continue, Observer, Point, Progress as Position, resume, run},
    newton::{Increment, IterationObserver},
    norms::Norms,
    outcome::{CutBack, Ending},
    problem::Problem,
    state::State,
};

use crate::{
    failure::{Failure, INTERRUPTED},
    progress::{Progress, Verbosity},
};

/// A finished run.
pub struct Simulation {
    /// The problem.
    pub problem: Problem,
    /// The last converged state.
    pub state: State,
    /// States at the ends of all completed steps.
    pub steps: Vec<State>,
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
                std::process::exit(i32::from(INTERRUPTED));
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
    let recorder = Recorder::create(folder, case, deck.output)?;
    let place = Place {
        folder,
        source: None,
        point: None,
    };
    proceed(deck, recorder, place, verbosity, interrupt)
}

/// Runs a deck from a file, with checkpoints.
///
/// # Errors
/// When the model cannot be solved or the output not be written.
pub fn simulate_file(
    deck: Deck,
    source: Source,
    folder: &Path,
    verbosity: Verbosity,
    interrupt: &Interrupt,
) -> Result<Simulation, Failure> {
    let recorder = Recorder::create(folder, &source.case, deck.output)?;
    let place = Place {
        folder,
        source: Some(source),
        point: None,
    };
    proceed(deck, recorder, place, verbosity, interrupt)
}

/// Goes on from a checkpoint.
///
/// # Errors
/// When the model cannot be solved or the output not be written.
pub fn go_on(
    deck: Deck,
    checkpoint: Checkpoint,
    folder: &Path,
    verbosity: Verbosity,
    interrupt: &Interrupt,
) -> Result<Simulation, Failure> {
    let Checkpoint {
        source,
        written,
        point,
    } = checkpoint;
    let recorder = Recorder::resume(folder, &source.case, deck.output, &written);
    let recorder = recorder.map_err(CheckpointError::Output)?;
    let place = Place {
        folder,
        source: Some(source),
        point: Some(point),
    };
    proceed(deck, recorder, place, verbosity, interrupt)
}

/// Where a run is written, which deck it is of, and where it goes on.
struct Place<'a> {
    folder: &'a Path,
    source: Option<Source>,
    point: Option<Point>,
}

fn proceed(
    deck: Deck,
    recorder: Recorder,
    place: Place,
    verbosity: Verbosity,
    interrupt: &Interrupt,
) -> Result<Simulation, Failure> {
    let problem = Problem::new(deck.model)?;
    let Place {
        folder,
        source,
        point,
    } = place;
    let mut watch = Watch {
        problem: &problem,
        recorder,
        folder,
        source,
        progress: Progress::new(&problem.model, verbosity),
        interrupt,
        steps: Vec::new(),
        before: point.as_ref().map(|point| point.state.clone()),
        failure: None,
    };
    let (state, ending) = match point {
        None => {
            let start = State::undeformed(&problem);
            watch.before = Some(start.clone());
            run(&problem, start, &mut watch)
        }
        Some(point) => resume(&problem, point, &mut watch),
    };
    watch.progress.finish();
    let Watch {
        mut recorder,
        steps,
        failure,
        ..
    } = watch;
    if let Some(failure) = failure {
        return Err(failure.into());
    }
    let summary = recorder.finish(&problem, &state, &ending)?;
    if ending == Ending::Completed {
        Checkpoint::remove(folder)?;
    }
    Ok(Simulation {
        problem,
        state,
        steps,
        ending,
        summary,
    })
}

struct Watch<'a> {
    problem: &'a Problem,
    recorder: Recorder,
    folder: &'a Path,
    source: Option<Source>,
    progress: Progress,
    interrupt: &'a Interrupt,
    steps: Vec<State>,
    /// State before the increment under way.
    before: Option<State>,
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
        if position.fraction == 1.0 {
            self.steps.push(increment.state.clone());
        }
        if let Some(before) = self.before.replace(increment.state.clone()) {
            self.recorder.judge(self.problem, &before, increment);
        }
        let recorded = self.recorder.increment(self.problem, position, increment);
        self.failure = self.failure.take().or(recorded.err());
        if self.source.is_some() && self.recorder.keeps(position.increment) {
            self.next(Continue::Keep)
        } else {
            self.next(Continue::Yes)
        }
    }

    fn point(&mut self, point: Point) {
        let Some(source) = self.source.clone().filter(|_| self.failure.is_none()) else {
            return;
        };
        let checkpoint = Checkpoint {
            source,
            written: self.recorder.written(),
            point,
        };
        self.failure = checkpoint.write(self.folder).err();
    }

    fn cut_back(&mut self, position: Position, reason: &CutBack) -> Continue {
        self.recorder.cut_back();
        self.progress.cut_back(position, reason);
        self.next(Continue::Yes)
    }
}

impl Watch<'_> {
    /// What comes next if nothing stops the run.
    fn next(&self, otherwise: Continue) -> Continue {
        if self.failure.is_some() || self.interrupt.is_set() {
            Continue::Stop
        } else {
            otherwise
        }
    }
}

#[cfg(test)]
mod tests;
