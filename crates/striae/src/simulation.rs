//! A run from its model to its results.
//!
//! ```text
//! Simulation::new(model)       a model built in Rust
//!           ::of(deck)         a deck that has been read
//!           ::open(path)       a deck in a file, whose run can be resumed;
//!           ::open_with(path, settings) with parameters set
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

use striae_deck::{Deck, Faults, Setting};
use striae_model::{Backend, Model, StepBuilder, Validate, extended};
use striae_output::{
    Existing, FieldOutput, Output, available_bytes,
    checkpoint::{
        self, Checkpoint, CheckpointError, Index, Source, Written, fingerprint, part_fingerprints,
        step_fingerprints,
    },
    history::Table,
    summary::Summary,
};
use striae_solve::{
    drive::{self, Point},
    newton::{Memory, Workspace},
    outcome::Ending,
    problem::Problem,
    sensitivity::{Parameter, Sensitivities},
    share::Division,
    stabilisation::first_increment,
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
    sensitivity::{Followed, Sensitivity, of_deck},
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
    parameters: Vec<Parameter>,
}

/// Start of a run.
#[derive(Clone, Debug)]
enum Begun {
    /// At rest.
    Undeformed,
    /// After so many steps and increments of an earlier run, in the state it came to.
    After(Box<(usize, usize, State)>),
    /// Point at which a run was stopped, in files of its own.
    Within(Box<Point>),
    /// Point at which a recorded run was stopped.
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
    /// Ending of the run.
    pub ending: Ending,
    /// Content of `summary.json`: counts, resultants, warnings.
    pub summary: Summary,
    /// A row an increment: resultants, reactions, motions, energies.
    pub history: Table,
    /// Derivatives by the parameters that were asked for, in their order.
    pub sensitivities: Vec<Sensitivity>,
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
            parameters: Vec::new(),
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
        if !deck.wrt.is_empty() {
            return Err(Error::NotFromTheStart);
        }
        Ok(Self::of_valid(ranks, deck.model)?.writing(deck.output))
    }

    /// A run of a deck in a file, written to `folder` with checkpoints, so that it
    /// can be [resumed](Self::resume).
    ///
    /// # Errors
    /// All faults of the deck, or why its model cannot be solved.
    pub fn open(deck: &Path, folder: impl Into<PathBuf>) -> Result<Self, Error> {
        Self::open_with(deck, &[], folder)
    }

    /// A run of a deck in a file, as [`Self::open`], with parameters set from outside.
    ///
    /// # Errors
    /// As [`Self::open`], and where the deck has no such parameter.
    pub fn open_with(
        deck: &Path,
        settings: &[Setting],
        folder: impl Into<PathBuf>,
    ) -> Result<Self, Error> {
        let read = striae_deck::read_with(deck, settings)?;
        Self::opened(None, (deck, settings), read, folder.into())
    }

    /// A run of a deck that has been read from a file, and is written to `folder`.
    fn opened(
        ranks: Option<Arc<dyn Ranks>>,
        (path, settings): (&Path, &[Setting]),
        mut deck: Deck,
        folder: PathBuf,
    ) -> Result<Self, Error> {
        let source = source(case_name(path), (path, settings), &deck.model, &deck.output);
        let case = source.case.clone();
        let wrt = std::mem::take(&mut deck.wrt);
        let mut simulation = Self::of_on(ranks, deck)?;
        for name in wrt {
            simulation = simulation.differentiated(of_deck(path, settings, &name)?);
        }
        Ok(simulation.recorded(folder, case).with_source(source))
    }

    /// Opens the deck on several ranks, each of which reads it; collective. Results of the run are
    /// those of the part this rank holds, history and summary those of the whole.
    ///
    /// # Errors
    /// Returns the errors of [`Self::open`], on all ranks.
    pub fn open_on(
        ranks: Arc<dyn Ranks>,
        deck: &Path,
        settings: &[Setting],
        folder: impl Into<PathBuf>,
    ) -> Result<Self, Error> {
        let read = striae_deck::read_with(deck, settings).map_err(Error::from);
        let read = agreed(Some(&ranks), read)?;
        Self::opened(Some(ranks), (deck, settings), read, folder.into())
    }

    /// Goes on on several ranks, however many wrote the checkpoint; collective.
    ///
    /// # Errors
    /// As [`Self::resume`], on all ranks.
    pub fn resume_on(ranks: Arc<dyn Ranks>, folder: &Path) -> Result<Self, Error> {
        let read = || -> Result<(Index, Deck), Error> {
            let index = Index::read(folder)?;
            let deck = read_again(index.source())?;
            index.source().check(&deck.model, &deck.output)?;
            Ok((index, deck))
        };
        let (index, deck) = agreed(Some(&ranks), read())?;
        let simulation = Self::of_on(Some(ranks), deck)?;
        let checkpoint = index.held(&simulation.problem)?;
        Ok(simulation.stopped_at(checkpoint, folder))
    }

    /// Resumes a run from the checkpoint in its folder, with results identical to the last bit. Its
    /// deck is read again and must not have changed.
    ///
    /// # Errors
    /// When there is no checkpoint, or when it does not fit the deck or the output.
    pub fn resume(folder: &Path) -> Result<Self, Error> {
        let checkpoint = Checkpoint::read(folder)?;
        let deck = read_again(&checkpoint.source)?;
        Self::resume_from(deck, checkpoint, folder)
    }

    /// Resumes from a checkpoint with a given deck.
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

    /// A run that resumes from a checkpoint that fits it.
    fn stopped_at(mut self, checkpoint: Checkpoint, folder: &Path) -> Self {
        let Checkpoint {
            source,
            written,
            point,
        } = checkpoint;
        self.output.fields = source.fields.unwrap_or(self.output.fields);
        self.recording = Some(Recording {
            folder: folder.to_owned(),
            case: source.case.clone(),
            source: Some(source),
            existing: Existing::Keep,
        });
        self.begun = Begun::Stopped(Box::new((written, point)));
        self
    }

    /// Continues from the end of a completed run with further steps. Times and numbers of steps and
    /// increments continue; history and summary are those of the further steps.
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

    /// Sets what is written and how often, if the run is recorded.
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
        let source = source(case.clone(), (deck, &[]), &self.problem.model, &self.output);
        self.recorded(folder, case).with_source(source)
    }

    fn with_source(mut self, source: Source) -> Self {
        if let Some(recording) = &mut self.recording {
            recording.source = Some(source);
        }
        self
    }

    /// Sets increments or times of fields in place of those of the deck, for a run that is resumed,
    /// too.
    pub fn with_fields(mut self, fields: FieldOutput) -> Self {
        self.output.fields = fields;
        let recording = self.recording.as_mut();
        if let Some(source) = recording.and_then(|recording| recording.source.as_mut()) {
            source.fields = Some(fields);
        }
        self
    }

    /// Sets the treatment of results that are in the folder already; by default they are kept and
    /// the run does not begin.
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

    /// Computes derivatives by a parameter, too, see [`crate::sensitivity`]; such a run begins
    /// undeformed, on one rank, and writes no checkpoints. Another parameter of the same name is
    /// the same one.
    pub fn differentiated(mut self, by: Parameter) -> Self {
        if self.parameters.iter().all(|known| known.name != by.name) {
            self.parameters.push(by);
        }
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
            mut recording,
            begun,
            interrupt,
            ranks,
            parameters,
        } = self;
        let is_plain = ranks.is_none() && matches!(begun, Begun::Undeformed);
        let sensitivities = match parameters.is_empty() {
            true => None,
            false if is_plain => Some(Sensitivities::new(&problem, parameters)?),
            false => return Err(Error::NotFromTheStart),
        };
        if let (Some(recording), true) = (&mut recording, sensitivities.is_some()) {
            recording.source = None;
        }
        let folder = recording.as_ref().map(|recording| recording.folder.clone());
        let mut log = log(&problem, output, recording, &begun, ranks.as_ref())?;
        let followed = sensitivities.map(|all| Followed::new(all, folder.as_deref()));
        let (start, before) = match &begun {
            Begun::Undeformed => (State::undeformed(&problem), 0),
            Begun::After(after) => (after.2.clone(), after.1),
            Begun::Within(point) => (point.state.clone(), point.increments),
            Begun::Stopped(stopped) => (stopped.1.state.clone(), stopped.1.increments),
        };
        if !matches!(begun, Begun::Stopped(_)) {
            log.start(&problem, &start)?;
        }
        if matches!(begun, Begun::Undeformed) {
            log.begin(&problem, first_point(&problem, &start))?;
        }
        let mut watch = Watch {
            problem: &problem,
            log,
            followed: followed.transpose()?,
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
            Some(ranks) => Workspace::with(ranks.solver(backend)),
        };
        let (state, ending) = match begun {
            Begun::Undeformed => drive::run_in(workspace, &problem, (0, 0), start, &mut watch),
            Begun::After(after) => {
                let done = (after.0, after.1);
                drive::run_in(workspace, &problem, done, start, &mut watch)
            }
            Begun::Within(point) => drive::resume_in(workspace, &problem, *point, &mut watch),
            Begun::Stopped(stopped) if is_first(&problem, &stopped.1) => {
                drive::run_in(workspace, &problem, (0, 0), start, &mut watch)
            }
            Begun::Stopped(stopped) => drive::resume_in(workspace, &problem, stopped.1, &mut watch),
        };
        let Watch {
            log,
            followed,
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
        let warnings = followed.as_ref().map(Followed::warnings);
        let warnings = warnings.unwrap_or_default();
        let (summary, history) = log.finish(&problem, &state, &ending, warnings)?;
        Ok(Finished {
            problem,
            state,
            steps,
            increments,
            ending,
            summary,
            history,
            sensitivities: followed.map(Followed::finish).unwrap_or_default(),
        })
    }
}

/// The point of a run before its first increment.
fn first_point(problem: &Problem, start: &State) -> Point {
    Point {
        step: 0,
        increments: 0,
        fraction: 0.0,
        size: first_increment(&problem.model, 0),
        search: Vec::new(),
        doubted: 0,
        start: start.clone(),
        state: start.clone(),
        memory: Memory::default(),
    }
}

/// True for the point of a run that has made no increment, nor tried one in vain.
fn is_first(problem: &Problem, point: &Point) -> bool {
    point.increments == 0
        && point.fraction == 0.0
        && point.search.is_empty()
        && point.size == first_increment(&problem.model, 0)
}

/// The record of a run that starts or resumes.
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

/// Record of the deck in a checkpoint.
fn source(
    case: String,
    (deck, settings): (&Path, &[Setting]),
    model: &Model,
    output: &Output,
) -> Source {
    let settings = settings.iter();
    Source {
        case,
        settings: settings
            .map(|setting| (setting.name().to_owned(), setting.value()))
            .collect(),
        fields: None,
        path: std::path::absolute(deck).unwrap_or_else(|_| deck.to_owned()),
        fingerprint: fingerprint(model, output),
        parts: part_fingerprints(model),
        steps: step_fingerprints(model),
    }
}

/// The deck of a checkpoint as it was when the run began, with the parameters set then.
///
/// # Errors
/// All faults of the deck.
pub fn read_again(source: &Source) -> Result<Deck, Faults> {
    let settings = source.settings.iter();
    let settings: Vec<Setting> = settings
        .map(|(name, value)| Setting::new(name, *value))
        .collect();
    striae_deck::read_with(&source.path, &settings)
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
