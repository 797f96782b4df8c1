//! Runs: the library computes on a thread of its own without the interpreter, while the thread that
//! started the run responds to increments and to the keyboard.
//!
//! ```text
//! caller's thread                      thread of the run
//! recv_timeout  <- increment -------   converged, waits where it is to be told
//! callback      -- go on or stop -->
//! each tick: signals -> Interrupt ->   stops after the increment under way
//! ```

pub mod files;
mod messenger;
pub mod returned;

use std::{
    num::NonZeroUsize,
    path::PathBuf,
    sync::{Arc, mpsc::channel},
    thread,
};

use numpy::{PyArray1, PyArrayMethods};
use pyo3::{exceptions::PyRuntimeError, prelude::*};
use striae::{
    Error, Finished, Interrupt, Simulation, case_name,
    output::{FieldOutput, Output, checkpoint::Checkpoint, history::Table},
    sensitivity::between,
    solve::outcome::Ending,
};

use crate::{
    array::Array2,
    fault::{broken, raised},
    listen::{Callback, listen},
    model::Model,
    own_factor::raised_in,
    raised::Raised,
    results::{Kept, Results},
    start,
    step::Step,
    words::in_python,
};
use messenger::Messenger;

/// Stack of the thread of a run, as large as that of a program's first thread.
const STACK: usize = 8 << 20;

/// A run that has ended.
#[pyclass(frozen, module = "striae._striae")]
pub struct Run {
    /// The run itself.
    pub finished: Finished,
    /// States that are kept.
    pub kept: Vec<Arc<Kept>>,
    raised: Vec<Raised>,
    told: Told,
}

/// Ending of a run, in words.
pub struct Told {
    /// `completed`, `interrupted` or `stopped`.
    pub ending: String,
    /// A sentence.
    pub reason: String,
}

/// A run, and the exception that stopped it.
type Ended = (Run, Option<PyErr>);

#[pymethods]
impl Run {
    #[getter]
    fn ending(&self) -> &str {
        &self.told.ending
    }

    #[getter]
    fn reason(&self) -> &str {
        &self.told.reason
    }

    /// Writes to a folder what [`returned`](mod@crate::returned) reads.
    fn save(&self, folder: PathBuf) -> PyResult<()> {
        returned::save(self, &folder)
    }

    #[getter]
    fn unknowns(&self) -> usize {
        self.finished.summary.unknowns
    }

    #[getter]
    fn seconds(&self) -> f64 {
        self.finished.summary.wall_s
    }

    #[getter]
    fn cut_backs(&self) -> usize {
        self.finished.summary.cutbacks
    }

    fn warnings(&self) -> Vec<String> {
        let warnings = self.finished.summary.warnings.iter();
        warnings.map(|warning| in_python(&warning.text)).collect()
    }

    /// Names of the columns of the history, and its rows.
    fn history<'py>(&self, py: Python<'py>) -> PyResult<(Vec<String>, Array2<'py, f64>)> {
        table(py, &self.finished.history)
    }

    /// States that are kept.
    fn kept(&self) -> Vec<Results> {
        let kept = self.kept.iter().map(|kept| Results {
            problem: self.finished.problem.clone(),
            kept: kept.clone(),
        });
        kept.collect()
    }

    /// Derivatives of the history by a parameter: names of columns, and rows.
    fn derivatives<'py>(
        &self,
        py: Python<'py>,
        parameter: usize,
    ) -> PyResult<(Vec<String>, Array2<'py, f64>)> {
        table(py, &self.finished.sensitivities[parameter].history)
    }

    /// The run at its end with a parameter below and above its value.
    fn neighbours(&self, parameter: usize) -> Vec<Results> {
        let neighbours = self.finished.sensitivities[parameter].neighbours();
        let Some(last) = self.kept.last() else {
            return Vec::new();
        };
        let at_end = |at: usize| Results {
            problem: neighbours.parameter.problems[at].clone(),
            kept: Arc::new(Kept {
                progress: last.progress,
                iterations: last.iterations,
                state: neighbours.states[at].clone(),
            }),
        };
        vec![at_end(0), at_end(1)]
    }

    /// The model that was run.
    fn model(&self) -> Model {
        Model {
            raised: self.raised.clone(),
            ..Model::of(self.finished.problem.model.clone())
        }
    }

    /// Writes the files of the program, with fields of the states that are kept.
    fn write(
        &self,
        py: Python<'_>,
        folder: PathBuf,
        case: &str,
        fields_every: usize,
    ) -> PyResult<()> {
        py.detach(|| files::write(self, &folder, case, fields_every))
    }

    /// Goes on with further steps.
    fn continued(
        &self,
        py: Python<'_>,
        steps: Vec<PyRef<'_, Step>>,
        watching: Watching,
        recording: Option<Recording>,
    ) -> PyResult<Ended> {
        let added = steps.iter().map(|step| step.0.clone()).collect();
        let simulation = Simulation::after(&self.finished, added);
        let simulation = simulation.map_err(|error| raised(error, "model"))?;
        start::checked(&simulation.problem().model, &steps)?;
        watched(
            py,
            recorded(simulation, Output::default(), recording, None),
            watching,
            self.raised.clone(),
        )
    }
}

impl Run {
    /// A run that has ended.
    pub fn new(finished: Finished, kept: Vec<Arc<Kept>>, raised: Vec<Raised>, told: Told) -> Self {
        Self {
            finished,
            kept,
            raised,
            told,
        }
    }
}

/// Names of the columns of a table, and its rows.
fn table<'py>(py: Python<'py>, table: &Table) -> PyResult<(Vec<String>, Array2<'py, f64>)> {
    let (rows, columns) = (table.rows.len(), table.columns.len());
    let numbers = table.rows.iter().flatten().copied().collect();
    let array = PyArray1::from_vec(py, numbers).reshape([rows, columns])?;
    Ok((table.columns.clone(), array))
}

/// Observation of a run: the function that is called with the results of each increment and can
/// stop the run by returning `False`; increments between kept states (0: the ends of steps); the
/// number of threads, that of the machine if `None`.
type Watching = (Option<Py<PyAny>>, usize, Option<usize>);

/// Recording of a run: the folder, the name of the case, increments between fields (0: the last
/// only).
type Recording = (PathBuf, Option<String>, Option<usize>);

/// A parameter by which a run is differentiated: its name, its step, the models below and above.
type Differentiated<'py> = (String, f64, PyRef<'py, Model>, PyRef<'py, Model>);

/// Runs a model, with derivatives by parameters.
#[pyfunction]
pub fn run(
    py: Python<'_>,
    model: PyRef<'_, Model>,
    watching: Watching,
    recording: Option<Recording>,
    parameters: Vec<Differentiated<'_>>,
) -> PyResult<Ended> {
    let (of, output) = (model.model.clone(), model.output.clone());
    let parameters = parameters.into_iter().map(|(name, step, less, more)| {
        let models = [&less.model, &more.model].map(Arc::clone);
        (name, step, models)
    });
    let by: Vec<_> = parameters.collect();
    let simulation = py.detach(|| {
        let simulation = Simulation::new((*of).clone())?;
        by.into_iter()
            .try_fold(simulation, |simulation, (name, step, models)| {
                let models = models.map(|model| (*model).clone());
                Ok(simulation.differentiated(between(name, step, models)?))
            })
    });
    let simulation = simulation.map_err(|error| raised(error, "model"))?;
    let simulation = recorded(simulation, output, recording, model.deck.clone());
    watched(py, simulation, watching, model.raised.clone())
}

/// Goes on with a recorded run of a deck.
#[pyfunction]
pub fn resume(py: Python<'_>, folder: PathBuf, watching: Watching) -> PyResult<Ended> {
    let simulation = py.detach(|| Simulation::resume(&folder));
    let simulation = simulation.map_err(|error| raised(error, "model"))?;
    watched(py, simulation, watching, Vec::new())
}

fn recorded(
    simulation: Simulation,
    output: Output,
    recording: Option<Recording>,
    deck: Option<PathBuf>,
) -> Simulation {
    let Some(recording) = recording else {
        return simulation;
    };
    let (folder, case, fields_every) = recording;
    let title = simulation.problem().model.title.clone();
    let simulation = simulation.writing(output);
    let simulation = match deck {
        Some(deck) => {
            let case = case.unwrap_or_else(|| case_name(&deck));
            simulation.resumable(folder, case, &deck)
        }
        None => simulation.recorded(folder, case.unwrap_or(title)),
    };
    match fields_every {
        Some(every) => {
            let fields = NonZeroUsize::new(every).map_or(FieldOutput::Last, FieldOutput::Every);
            simulation.with_fields(fields)
        }
        None => simulation,
    }
}

/// Runs while the caller's thread listens.
fn watched(
    py: Python<'_>,
    simulation: Simulation,
    watching: Watching,
    laws: Vec<Raised>,
) -> PyResult<Ended> {
    let own = laws.clone();
    let factors = raised_in(&simulation.problem().model);
    // What other runs have left says nothing about this one.
    factors.iter().for_each(|raised| drop(raised.take()));
    let laws: Vec<Raised> = laws.into_iter().chain(factors).collect();
    let listened = laws.clone();
    let (on_increment, keep, threads) = watching;
    let problem = simulation.problem().clone();
    let interrupt = Interrupt::default();
    let simulation = simulation.until(&interrupt);
    let (told, heard) = channel();
    let (answer, answers) = channel();
    let (alive, ended) = channel::<()>();
    let is_told = on_increment.is_some();
    let work = move || {
        let mut messenger = Messenger {
            told: is_told.then_some((told, answers)),
            keep,
            kept: Vec::new(),
            latest: None,
        };
        let finished = in_pool(threads, || simulation.run_with(&mut messenger));
        // Whoever listens learns that the run has ended.
        messenger.told = None;
        drop(alive);
        (finished, messenger)
    };
    let (outcome, stopped) = py.detach(move || {
        thread::scope(|scope| {
            let builder = thread::Builder::new()
                .name("striae".into())
                .stack_size(STACK);
            let worker = builder.spawn_scoped(scope, work).map_err(PyErr::from)?;
            let callback = on_increment.map(|function| Callback {
                function,
                problem,
                heard,
                answer,
            });
            let stopped = listen(callback.as_ref(), &ended, &interrupt, &listened);
            let outcome = worker.join().map_err(|panic| broken(&*panic))?;
            Ok::<_, PyErr>((outcome, stopped))
        })
    })?;
    let (finished, messenger) = outcome;
    let finished = finished?.map_err(|error: Error| raised(error, "model"))?;
    let stopped = stopped.or_else(|| laws.iter().find_map(Raised::take));
    Ok((ended_with(finished, messenger, own), stopped))
}

/// The run with its last state among those that are kept.
fn ended_with(finished: Finished, messenger: Messenger, raised: Vec<Raised>) -> Run {
    let mut kept = messenger.kept;
    let last = kept.last().map(|kept| kept.progress);
    if let Some((progress, iterations)) = messenger.latest
        && last != Some(progress)
    {
        kept.push(Arc::new(Kept {
            progress,
            iterations,
            state: finished.state.clone(),
        }));
    }
    let ending = match finished.ending {
        Ending::Completed => "completed",
        Ending::Interrupted { .. } => "interrupted",
        Ending::Stopped { .. } => "stopped",
    };
    let told = Told {
        ending: ending.to_owned(),
        reason: in_python(&finished.ending),
    };
    Run::new(finished, kept, raised, told)
}

/// Computes in a pool of so many threads.
fn in_pool<T: Send>(threads: Option<usize>, work: impl FnOnce() -> T + Send) -> PyResult<T> {
    let Some(threads) = threads else {
        return Ok(work());
    };
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
    let pool = pool.map_err(|error| PyRuntimeError::new_err(error.to_string()))?;
    Ok(pool.install(work))
}

/// The deck of a recorded run that can be resumed.
#[pyfunction]
pub fn deck_of(folder: PathBuf) -> PyResult<PathBuf> {
    let checkpoint = Checkpoint::read(&folder).map_err(Error::Checkpoint);
    Ok(checkpoint
        .map_err(|error| raised(error, "deck"))?
        .source
        .path)
}
