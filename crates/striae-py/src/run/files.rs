//! Files of a run that has ended: what the program writes during one, and its report.

use std::{
    num::NonZeroUsize,
    path::{Path, PathBuf},
};

use pyo3::{exceptions::PyRuntimeError, prelude::*};
use striae::{
    Error,
    output::{Existing, FieldOutput, Output, OutputError, recorder::Recorder},
    solve::{
        newton::{Acceptance, InStep, Increment, LinearWork},
        norms::Norms,
        state::State,
    },
};

use super::Run;
use crate::fault::raised;

/// Writes the files of a run whose increments are all kept, with fields after so many
/// increments each (0: the last only).
pub fn write(run: &Run, folder: &Path, case: &str, fields_every: usize) -> PyResult<()> {
    let written = replayed(run, folder, case, fields_every);
    written.map_err(|error| raised(Error::Output(error), "run"))
}

fn replayed(run: &Run, folder: &Path, case: &str, every: usize) -> Result<(), OutputError> {
    let finished = &run.finished;
    let (problem, summary) = (&finished.problem, &finished.summary);
    let fields = NonZeroUsize::new(every).map_or(FieldOutput::Last, FieldOutput::Every);
    let output = Output {
        fields,
        ..Output::default()
    };
    let mut recorder = Recorder::create(folder, case, output, Existing::Keep)?;
    let begins = run.kept.first().map_or(1, |kept| kept.progress.increment);
    if begins == 1 {
        recorder.start(problem, &State::undeformed(problem))?;
    }
    for kept in &run.kept {
        let increment = Increment {
            state: kept.state.clone(),
            in_step: InStep::up_to(kept.progress.step, kept.progress.fraction),
            iterations: vec![Norms::default(); kept.iterations],
            unknowns: summary.unknowns,
            peak_bytes: 0,
            work: LinearWork::default(),
            interferences: Vec::new(),
            overlaps: Vec::new(),
            doubts: Vec::new(),
            selections: Vec::new(),
            has_reselected: false,
            acceptance: Acceptance::Converged,
        };
        recorder.increment(problem, kept.progress, &increment)?;
    }
    recorder.finish(problem, &finished.state, &finished.ending, Vec::new())?;
    // What the run itself has counted and judged.
    finished.history.write(&folder.join("history.csv"))?;
    let mut summary = summary.clone();
    summary.case = case.to_owned();
    summary.write(&folder.join("summary.json"))
}

/// Writes the report of a folder of results to a file.
#[pyfunction]
pub fn report(py: Python<'_>, folder: PathBuf, file: PathBuf) -> PyResult<()> {
    let written = py.detach(|| striae_report::write(&folder, &file));
    written.map_err(|error| PyRuntimeError::new_err(error.to_string()))
}
