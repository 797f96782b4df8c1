//! Runs of other processes: what a run came to as files, and back.
//!
//! ```text
//! FOLDER/summary.json, history.csv      as the program writes them
//!        0/checkpoint.bin, 1/...        states that are kept, exactly
//! ```

use std::{
    path::{Path, PathBuf},
    sync::Arc,
};

use pyo3::{exceptions::PyRuntimeError, prelude::*};
use striae::{
    Error, Finished, Simulation,
    output::{
        checkpoint::{Checkpoint, Source, Written},
        history::Table,
        summary::Summary,
    },
    solve::{
        drive::{Point, Progress},
        outcome::Ending,
        state::State,
    },
};

use super::{Run, Told};
use crate::{fault::raised, model::Model, results::Kept};

/// Names of the files beside the states.
const SUMMARY: &str = "summary.json";
const HISTORY: &str = "history.csv";

/// Writes a run to a folder that is there, as are those of its states in it.
pub fn save(run: &Run, folder: &Path) -> PyResult<()> {
    let written = run.finished.summary.write(&folder.join(SUMMARY));
    let written = written.and_then(|()| run.finished.history.write(&folder.join(HISTORY)));
    written.map_err(|error| raised(Error::Output(error), "run"))?;
    for (number, kept) in run.kept.iter().enumerate() {
        let place = folder.join(number.to_string());
        let written = checkpoint(kept).write(&place);
        written.map_err(|error| raised(Error::Output(error), "run"))?;
    }
    Ok(())
}

/// A state as a checkpoint that belongs to no deck.
fn checkpoint(kept: &Kept) -> Checkpoint {
    let Progress {
        step,
        increment,
        fraction,
        ..
    } = kept.progress;
    Checkpoint {
        source: Source {
            case: String::new(),
            path: PathBuf::new(),
            settings: Vec::new(),
            fields: None,
            fingerprint: 0,
            parts: Vec::new(),
            steps: Vec::new(),
        },
        written: Written {
            iterations: vec![kept.iterations],
            ..Written::default()
        },
        point: Point {
            step,
            increments: increment,
            fraction,
            size: 0.0,
            doubted: 0,
            search: Vec::new(),
            start: kept.state.clone(),
            state: kept.state.clone(),
            memory: Default::default(),
        },
    }
}

/// The run of a model that another process has saved, with so many states, its ending and
/// the reason of it.
#[pyfunction]
pub fn returned(
    model: PyRef<'_, Model>,
    folder: PathBuf,
    states: usize,
    ending: String,
    reason: String,
) -> PyResult<Run> {
    let simulation = Simulation::new((*model.model).clone());
    let simulation = simulation.map_err(|error| raised(error, "model"))?;
    let problem = simulation.problem().clone();
    let undeformed = State::undeformed(&problem);
    let mut kept = Vec::with_capacity(states);
    for number in 0..states {
        let read = Checkpoint::read(&folder.join(number.to_string()));
        let read = read.map_err(|error| raised(Error::Checkpoint(error), "run"))?;
        let state = read.point.state;
        let fits = state.positions.len() == undeformed.positions.len();
        if !(fits && state.remembers_as(&problem)) {
            let text = "the run of the other process is of another model";
            return Err(PyRuntimeError::new_err(text));
        }
        let progress = Progress {
            step: read.point.step,
            increment: read.point.increments,
            fraction: read.point.fraction,
            time: state.time,
        };
        kept.push(Arc::new(Kept {
            progress,
            iterations: read.written.iterations.first().copied().unwrap_or(0),
            state,
        }));
    }
    let summary = Summary::read(&folder.join(SUMMARY));
    let history = Table::read(&folder.join(HISTORY));
    let last = kept.last();
    let state = last.map_or(undeformed, |kept| kept.state.clone());
    let finished = Finished {
        problem,
        steps: Vec::new(),
        increments: last.map_or(0, |kept| kept.progress.increment),
        ending: match ending.as_str() {
            "completed" => Ending::Completed,
            _ => Ending::Interrupted { time: state.time },
        },
        state,
        summary: summary.map_err(|error| raised(Error::Output(error), "run"))?,
        history: history.map_err(|error| raised(Error::Output(error), "run"))?,
        sensitivities: Vec::new(),
    };
    let told = Told { ending, reason };
    let raised = model.raised.clone();
    Ok(Run::new(finished, kept, raised, told))
}
