//! Files of a run that has ended: what the program writes during one, its report and pictures.

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
    write_frictions,
};

use striae_report::{
    ReportError,
    picture::{Picture, VIEWS, animate},
};

use super::Run;
use crate::fault::{raised, refused};

/// Writes the files of a run with its whole history, and fields of the states that are kept, or of
/// those after so many increments each (0: the last only).
pub fn write(run: &Run, folder: &Path, case: &str, fields_every: usize) -> PyResult<()> {
    let written = replayed(run, folder, case, fields_every);
    let model = &run.finished.problem.model;
    let written = written.map_err(Error::Output);
    let written = written.and_then(|()| write_frictions(folder, model));
    written.map_err(|error| raised(error, "run"))
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
    // A run that continues another one has no start of its own.
    let history = &finished.history;
    let number = history.columns.iter().position(|name| name == "increment");
    let first = history.rows.first().zip(number);
    if first.is_none_or(|(row, number)| row[number] == 1.0) {
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

/// A picture: field, component, time, direction of sight or the name of a view, colour range,
/// magnification, hidden parts, width.
type Pictured = (
    Option<String>,
    Option<String>,
    Option<f64>,
    View,
    Option<[f64; 2]>,
    f64,
    Vec<String>,
    usize,
);

/// A view by its name, or the direction of sight.
#[derive(FromPyObject)]
pub enum View {
    /// A name.
    Named(String),
    /// A direction.
    Along([f64; 3]),
}

/// Draws a folder of results to a file: a picture, or with the time of a frame (seconds) an
/// animation.
#[pyfunction]
pub fn picture(
    py: Python<'_>,
    folder: PathBuf,
    file: PathBuf,
    pictured: Pictured,
    frame_time: Option<f64>,
) -> PyResult<()> {
    let (field, component, time, view, range, magnification, hidden, width) = pictured;
    let direction = match view {
        View::Along(direction) => direction,
        View::Named(name) => {
            let mut views = VIEWS.iter().filter(|(known, _)| *known == name);
            let names = VIEWS.map(|(name, _)| format!("`{name}`")).join(", ");
            let found = views
                .next()
                .ok_or_else(|| refused("view", format!("one of {names} is needed, not {name:?}")));
            found?.1
        }
    };
    let picture = Picture {
        field,
        component,
        time,
        direction,
        range,
        magnification,
        hidden,
        width,
    };
    let drawn = py.detach(|| match frame_time {
        Some(seconds) => animate(&folder, &picture, seconds, &file),
        None => striae_report::picture::write(&folder, &picture, &file),
    });
    drawn.map_err(|error| match error {
        ReportError::Field { .. } => refused("field", error),
        ReportError::Component { .. } => refused("component", error),
        ReportError::View => refused("view", error),
        ReportError::Animation(_) | ReportError::Still(_) => refused("path", error),
        ReportError::Time(..) => refused("time", error),
        ReportError::Magnification(..) => refused("magnify", error),
        ReportError::Name { .. } => refused("hide", error),
        _ => PyRuntimeError::new_err(error.to_string()),
    })
}

/// Writes the report of a folder of results to a file.
#[pyfunction]
pub fn report(py: Python<'_>, folder: PathBuf, file: PathBuf) -> PyResult<()> {
    let written = py.detach(|| striae_report::write(&folder, &file));
    written.map_err(|error| PyRuntimeError::new_err(error.to_string()))
}
