//! A run from its model to its results.
//!
//! ```text
//! Simulation::new(model)       a model built in Rust
//!           ::of(deck)         a deck that has been read
//!           ::open(path)       a deck in a file, whose run can be resumed
//!           ::resume(folder)   a run that was stopped
//!           ::after(run, steps) a run that has ended, with further steps
//!           ::resume_with(folder, deck) a run with the steps of another deck
//!     .writing(output).recorded(folder, case).until(interrupt)
//!     .run() or .run_with(observer) -> Finished
//! ```

mod branch;
mod watch;

use std::{
    path::{Path, PathBuf},
    sync::Arc,
};

use striae_deck::Deck;
use striae_model::{Model, StepBuilder, Validate, extended};
use striae_output::{
    Existing, Output, agreed, available_bytes,
    checkpoint::{
        self, Checkpoint, CheckpointError, Source, Written, fingerprint, part_fingerprints,
        step_fingerprints,
    },
    history::Table,
    summary::Summary,
};
use striae_solve::{
    drive::{self, Point},
    outcome::Ending,
    problem::Problem,
    state::State,
};

use crate::{
    advice::Cost,
    beside,
    error::Error,
    interrupt::Interrupt,
    log::{Log, Recording},
    observer::Observer,
    results::Results,
};
use watch::Watch;

/// A run that can begin.
#[derive(Clone, Debug)]
pub struct Simulation {
    problem: Arc<Problem>,
    output: Output,
    recording: Option<Recording>,
    begun: Begun,
    interrupt: Interrupt,
}

/// Where a run begins.
#[derive(Clone, Debug)]
enum Begun {
    /// At rest.
    Undeformed,
    /// After so many steps and increments of an earlier run, in the state it came to.
    After(Box<(usize, usize, State)>),
    /// Where a run was stopped, in files of its own.
    Within(Box<Point>),
    /// Where a recorded run was stopped.
    Stopped(Box<(Written, Point)>),
}

/// A run that has ended.
#[derive(Clone, Debug)]
pub struct Finished {
    /// The problem.
    pub problem: Arc<Problem>,
    /// The last converged state.
    pub state: State,
    /// States at the ends of all completed steps.
    pub steps: Vec<State>,
    /// Increments since the undeformed state.
    pub increments: usize,
    /// How the run ended.
    pub ending: Ending,
    /// What `summary.json` says: counts, resultants, warnings.
    pub summary: Summary,
    /// A row an increment: resultants, reactions, motions, energies.
    pub history: Table,
}

impl Finished {
    /// Results at the end of the run.
    pub fn results(&self) -> Results<'_> {
        Results::new(&self.problem, &self.state)
    }

    /// Results at the end of a completed step, counted from 0.
    pub fn at_end_of(&self, step: usize) -> Option<Results<'_>> {
        let state = self.steps.get(step)?;
        Some(Results::new(&self.problem, state))
    }
}

impl Simulation {
    /// A run of a model.
    ///
    /// # Errors
    /// All faults of the model, or why it cannot be solved.
    pub fn new(model: Model) -> Result<Self, Error> {
        Self::of_valid(model.checked()?)
    }

    fn of_valid(model: Model) -> Result<Self, Error> {
        if let Some(available) = available_bytes() {
            Cost::estimated(&model).fits(available)?;
        }
        Ok(Self {
            problem: Arc::new(Problem::new(model)?),
            output: Output::default(),
            recording: None,
            begun: Begun::Undeformed,
            interrupt: Interrupt::default(),
        })
    }

    /// A run of a deck that has been read.
    ///
    /// # Errors
    /// When its model cannot be solved.
    pub fn of(deck: Deck) -> Result<Self, Error> {
        Ok(Self::of_valid(deck.model)?.writing(deck.output))
    }

    /// A run of a deck in a file, written to `folder` with checkpoints, so that it
    /// can be [resumed](Self::resume).
    ///
    /// # Errors
    /// All faults of the deck, or why its model cannot be solved.
    pub fn open(deck: &Path, folder: impl Into<PathBuf>) -> Result<Self, Error> {
        let simulation = Self::of(striae_deck::read(deck)?)?;
        Ok(simulation.resumable(folder, case_name(deck), deck))
    }

    /// Goes on with a run from the checkpoint in its folder, to the same results to
    /// the last bit. Its deck is read again and must not have changed.
    ///
    /// # Errors
    /// When there is no checkpoint, or when it does not fit the deck or the output.
    pub fn resume(folder: &Path) -> Result<Self, Error> {
        let checkpoint = Checkpoint::read(folder)?;
        let deck = striae_deck::read(&checkpoint.source.path)?;
        Self::resume_from(deck, checkpoint, folder)
    }

    /// Goes on from a checkpoint with a deck that is at hand.
    ///
    /// # Errors
    /// When the deck is not that of the checkpoint.
    pub fn resume_from(deck: Deck, checkpoint: Checkpoint, folder: &Path) -> Result<Self, Error> {
        let Checkpoint {
            source,
            written,
            point,
        } = checkpoint;
        source.check(&deck.model, &deck.output)?;
        let mut simulation = Self::of(deck)?;
        let states = [&point.start, &point.state];
        if !(states.iter()).all(|state| state.remembers_as(&simulation.problem)) {
            let path = folder.join(checkpoint::FILE);
            return Err(CheckpointError::Damaged { path }.into());
        }
        simulation.recording = Some(Recording {
            folder: folder.to_owned(),
            case: source.case.clone(),
            source: Some(source),
            existing: Existing::Keep,
        });
        simulation.begun = Begun::Stopped(Box::new((written, point)));
        Ok(simulation)
    }

    /// Goes on from the end of a completed run with further steps. Times and numbers of
    /// steps and increments go on; history and summary are those of the further steps.
    ///
    /// # Errors
    /// When the earlier run was stopped before its end, all faults of the further steps,
    /// or why they cannot be solved.
    pub fn after(run: &Finished, steps: Vec<StepBuilder>) -> Result<Self, Error> {
        if run.ending != Ending::Completed {
            return Err(Error::NotCompleted);
        }
        let model = &run.problem.model;
        let mut simulation = Self::of_valid(extended(model.clone(), steps)?)?;
        let begun = (model.steps.len(), run.increments, run.state.clone());
        simulation.begun = Begun::After(Box::new(begun));
        Ok(simulation)
    }

    /// What is written and how often, if the run is recorded.
    pub fn writing(mut self, output: Output) -> Self {
        self.output = output;
        self
    }

    /// Writes fields, history and summary to a folder.
    pub fn recorded(mut self, folder: impl Into<PathBuf>, case: impl Into<String>) -> Self {
        self.recording = Some(Recording {
            folder: folder.into(),
            case: case.into(),
            source: None,
            existing: Existing::Keep,
        });
        self
    }

    /// Writes checkpoints besides, for which the deck is known by its path.
    pub fn resumable(
        self,
        folder: impl Into<PathBuf>,
        case: impl Into<String>,
        deck: &Path,
    ) -> Self {
        let case = case.into();
        let source = Source {
            case: case.clone(),
            path: std::path::absolute(deck).unwrap_or_else(|_| deck.to_owned()),
            fingerprint: fingerprint(&self.problem.model, &self.output),
            parts: part_fingerprints(&self.problem.model),
            steps: step_fingerprints(&self.problem.model),
        };
        let mut simulation = self.recorded(folder, case);
        if let Some(recording) = &mut simulation.recording {
            recording.source = Some(source);
        }
        simulation
    }

    /// What becomes of results that are in the folder already; without a word they stay,
    /// and the run does not begin.
    pub fn over(mut self, existing: Existing) -> Self {
        if let Some(recording) = &mut self.recording {
            recording.existing = existing;
        }
        self
    }

    /// Stops after the increment in which the flag is set.
    pub fn until(mut self, interrupt: &Interrupt) -> Self {
        self.interrupt = interrupt.clone();
        self
    }

    /// The problem: the model and what follows from it for the whole run.
    pub fn problem(&self) -> &Arc<Problem> {
        &self.problem
    }

    /// Runs to the end.
    ///
    /// # Errors
    /// When output cannot be written.
    pub fn run(self) -> Result<Finished, Error> {
        self.run_with(&mut ())
    }

    /// Runs to the end, or until the observer stops it.
    ///
    /// # Errors
    /// When output cannot be written.
    pub fn run_with(self, observer: &mut dyn Observer) -> Result<Finished, Error> {
        let Self {
            problem,
            output,
            recording,
            begun,
            interrupt,
        } = self;
        let mut log = match (recording, &begun) {
            (Some(recording), Begun::Stopped(stopped)) => {
                Log::resumed(&problem.share, recording, output, &stopped.0)?
            }
            (recording, _) => {
                let log = Log::new(&problem.share, recording.clone(), output)?;
                if let Some(recording) = &recording {
                    let beside = match problem.share.team().rank() {
                        0 => beside::write(recording, &problem.model),
                        _ => Ok(()),
                    };
                    agreed(&problem.share, beside)?;
                }
                log
            }
        };
        let (start, before) = match &begun {
            Begun::Undeformed => (State::undeformed(&problem), 0),
            Begun::After(after) => (after.2.clone(), after.1),
            Begun::Within(point) => (point.state.clone(), point.increments),
            Begun::Stopped(stopped) => (stopped.1.state.clone(), stopped.1.increments),
        };
        if !matches!(begun, Begun::Stopped(_)) {
            log.start(&problem, &start)?;
        }
        let mut watch = Watch {
            problem: &problem,
            log,
            observer,
            interrupt,
            steps: Vec::new(),
            before: start.clone(),
            increments: before,
            failure: None,
        };
        let (state, ending) = match begun {
            Begun::Undeformed => drive::run(&problem, start, &mut watch),
            Begun::After(after) => {
                let (steps, increments, _) = *after;
                drive::run_after(&problem, steps, start, increments, &mut watch)
            }
            Begun::Within(point) => drive::resume(&problem, *point, &mut watch),
            Begun::Stopped(stopped) => drive::resume(&problem, stopped.1, &mut watch),
        };
        let Watch {
            log,
            steps,
            increments,
            failure,
            ..
        } = watch;
        if let Some(failure) = failure {
            return Err(failure.into());
        }
        if ending == Ending::Completed {
            log.end(&problem, increments, &state)?;
        }
        let (summary, history) = log.finish(&problem, &state, &ending)?;
        Ok(Finished {
            problem,
            state,
            steps,
            increments,
            ending,
            summary,
            history,
        })
    }
}

/// Name of the case of a deck: the folder of a `deck.toml`, otherwise the name of the file.
pub fn case_name(deck: &Path) -> String {
    let stem = deck
        .file_stem()
        .map(|name| name.to_string_lossy().into_owned());
    let full = std::path::absolute(deck).unwrap_or_else(|_| deck.to_owned());
    let parent = full
        .parent()
        .and_then(Path::file_name)
        .map(|name| name.to_string_lossy().into_owned());
    match (stem.as_deref(), parent) {
        (Some("deck"), Some(parent)) => parent,
        _ => stem.unwrap_or_else(|| "run".to_owned()),
    }
}

#[cfg(test)]
mod tests;
