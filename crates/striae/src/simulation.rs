//! A run from its model to its results.
//!
//! ```text
//! Simulation::new(model)       a model built in Rust
//!           ::of(deck)         a deck that has been read
//!           ::open(path)       a deck in a file, whose run can be resumed
//!           ::resume(folder)   a run that was stopped
//!           ::after(run, steps) a run that has ended, with further steps
//!           ::resume_with(folder, deck) a run with the steps of another deck
//!           ::open_on(ranks, path), ::resume_on, ::resume_with_on  the same on several ranks
//!     .writing(output).recorded(folder, case).until(interrupt)
//!     .run() or .run_with(observer) -> Finished
//! ```
//!
//! Longer than other files, as all ways to begin a run are in one place.

mod branch;
mod watch;

use std::{
    path::{Path, PathBuf},
    sync::Arc,
};

use striae_deck::Deck;
use striae_model::{Model, StepBuilder, Validate, extended};
use striae_output::{
    Existing, Output, available_bytes,
    checkpoint::{
        self, Checkpoint, CheckpointError, Index, Source, Written, fingerprint, part_fingerprints,
        step_fingerprints,
    },
    history::Table,
    summary::Summary,
};
use striae_solve::{
    drive::{self, Point},
    model::Backend,
    newton::Workspace,
    outcome::Ending,
    problem::Problem,
    share::Division,
    state::State,
};

use crate::{
    advice::Cost,
    beside,
    error::Error,
    interrupt::Interrupt,
    log::{Log, Recording},
    observer::Observer,
    ranks::{Ranks, agreed},
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
    ranks: Option<Arc<dyn Ranks>>,
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
        Self::of_valid(None, model.checked()?)
    }

    fn of_valid(ranks: Option<Arc<dyn Ranks>>, model: Model) -> Result<Self, Error> {
        let problem = match &ranks {
            None => {
                if model.solver.backend == Backend::Mumps {
                    return Err(Error::NotTogether);
                }
                if let Some(available) = available_bytes() {
                    Cost::estimated(&model).fits(available)?;
                }
                Problem::new(model)?
            }
            Some(ranks) => {
                let team = ranks.team();
                let division = Division::agreed(&model, &*team)
                    .map_err(|error| Error::Division(error.to_string()))?;
                Problem::shared(model, &division, team)?
            }
        };
        Ok(Self {
            problem: Arc::new(problem),
            output: Output::default(),
            recording: None,
            begun: Begun::Undeformed,
            interrupt: Interrupt::default(),
            ranks,
        })
    }

    /// A run of a deck that has been read.
    ///
    /// # Errors
    /// When its model cannot be solved.
    pub fn of(deck: Deck) -> Result<Self, Error> {
        Self::of_on(None, deck)
    }

    fn of_on(ranks: Option<Arc<dyn Ranks>>, deck: Deck) -> Result<Self, Error> {
        let deck = match &ranks {
            None => deck.alone()?,
            Some(_) => deck,
        };
        Ok(Self::of_valid(ranks, deck.model)?.writing(deck.output))
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

    /// The same on several ranks, each of which reads the deck; collective. Results of the
    /// run are those of what this rank holds, history and summary those of the whole.
    ///
    /// # Errors
    /// As [`Self::open`], on all ranks.
    pub fn open_on(
        ranks: Arc<dyn Ranks>,
        deck: &Path,
        folder: impl Into<PathBuf>,
    ) -> Result<Self, Error> {
        let path = deck;
        let read = striae_deck::read(path).map_err(Error::from);
        let deck = agreed(Some(&ranks), read)?;
        let source = source(case_name(path), path, &deck.model, &deck.output);
        let simulation = Self::of_on(Some(ranks), deck)?;
        let case = source.case.clone();
        Ok(simulation.recorded(folder, case).with_source(source))
    }

    /// Goes on on several ranks, however many wrote the checkpoint; collective.
    ///
    /// # Errors
    /// As [`Self::resume`], on all ranks.
    pub fn resume_on(ranks: Arc<dyn Ranks>, folder: &Path) -> Result<Self, Error> {
        let read = || -> Result<(Index, Deck), Error> {
            let index = Index::read(folder)?;
            let deck = striae_deck::read(&index.source().path)?;
            index.source().check(&deck.model, &deck.output)?;
            Ok((index, deck))
        };
        let (index, deck) = agreed(Some(&ranks), read())?;
        let simulation = Self::of_on(Some(ranks), deck)?;
        let checkpoint = index.held(&simulation.problem)?;
        Ok(simulation.stopped_at(checkpoint, folder))
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
        checkpoint.source.check(&deck.model, &deck.output)?;
        let simulation = Self::of(deck)?;
        let states = [&checkpoint.point.start, &checkpoint.point.state];
        if !(states.iter()).all(|state| state.remembers_as(&simulation.problem)) {
            let path = folder.join(checkpoint::FILE);
            return Err(CheckpointError::Damaged { path }.into());
        }
        Ok(simulation.stopped_at(checkpoint, folder))
    }

    /// A run that goes on from a checkpoint that fits it.
    fn stopped_at(mut self, checkpoint: Checkpoint, folder: &Path) -> Self {
        let Checkpoint {
            source,
            written,
            point,
        } = checkpoint;
        self.recording = Some(Recording {
            folder: folder.to_owned(),
            case: source.case.clone(),
            source: Some(source),
            existing: Existing::Keep,
        });
        self.begun = Begun::Stopped(Box::new((written, point)));
        self
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
        let mut simulation = Self::of_valid(None, extended(model.clone(), steps)?)?;
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
        let source = source(case.clone(), deck, &self.problem.model, &self.output);
        self.recorded(folder, case).with_source(source)
    }

    fn with_source(mut self, source: Source) -> Self {
        if let Some(recording) = &mut self.recording {
            recording.source = Some(source);
        }
        self
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
            ranks,
        } = self;
        let mut log = log(&problem, output, recording, &begun, ranks.as_ref())?;
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
        let backend = problem.model.solver.backend;
        let workspace = match &ranks {
            None => Workspace::new(backend),
            Some(ranks) => Workspace::shared(ranks.solver(backend)),
        };
        let (state, ending) = match begun {
            Begun::Undeformed => drive::run_in(workspace, &problem, (0, 0), start, &mut watch),
            Begun::After(after) => {
                let done = (after.0, after.1);
                drive::run_in(workspace, &problem, done, start, &mut watch)
            }
            Begun::Within(point) => drive::resume_in(workspace, &problem, *point, &mut watch),
            Begun::Stopped(stopped) => drive::resume_in(workspace, &problem, stopped.1, &mut watch),
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

/// The record of a run that begins or goes on.
fn log(
    problem: &Problem,
    output: Output,
    recording: Option<Recording>,
    begun: &Begun,
    ranks: Option<&Arc<dyn Ranks>>,
) -> Result<Log, Error> {
    let share = &problem.share;
    if let (Some(recording), Begun::Stopped(stopped)) = (&recording, begun) {
        return Ok(Log::resumed(share, recording.clone(), output, &stopped.0)?);
    }
    let log = Log::new(share, recording.clone(), output)?;
    if let Some(recording) = &recording {
        let is_first = share.team().rank() == 0;
        let written = is_first.then(|| beside::write(recording, &problem.model));
        agreed(ranks, written.unwrap_or(Ok(())))?;
    }
    Ok(log)
}

/// What a checkpoint knows of a deck.
fn source(case: String, deck: &Path, model: &Model, output: &Output) -> Source {
    Source {
        case,
        path: std::path::absolute(deck).unwrap_or_else(|_| deck.to_owned()),
        fingerprint: fingerprint(model, output),
        parts: part_fingerprints(model),
        steps: step_fingerprints(model),
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
