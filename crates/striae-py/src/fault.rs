//! Faults of the library as the exceptions of the package.

use std::any::Any;

use pyo3::{
    exceptions::{PyMemoryError, PyRuntimeError},
    prelude::*,
};
use striae::Error;

use crate::words::in_python;

/// `striae.ModelError` with these faults, each a path and a message.
pub fn model_error(faults: Vec<(String, String)>) -> PyErr {
    Python::attach(|py| {
        let made = py
            .import("striae._errors")
            .and_then(|module| module.getattr("ModelError"))
            .and_then(|class| class.call1((faults,)));
        made.map_or_else(|error| error, PyErr::from_value)
    })
}

/// `striae.ModelError` with one fault.
pub fn refused(path: impl Into<String>, message: impl ToString) -> PyErr {
    model_error(vec![(path.into(), message.to_string())])
}

/// `striae.ModelError` with the faults of a model.
pub fn model_faults(faults: &striae::model::Faults) -> PyErr {
    let faults = faults.0.iter();
    let told = faults.map(|fault| (fault.path.to_string(), in_python(&fault.kind)));
    model_error(told.collect())
}

/// The exception for an error of the library; `place` names what has no path of its own.
pub fn raised(error: Error, place: &str) -> PyErr {
    match error {
        Error::Model(faults) => model_faults(&faults),
        Error::Deck(faults) => {
            let told = faults.iter().map(|fault| {
                let at = fault.position.map_or_else(String::new, |position| {
                    format!(":{}:{}", position.line, position.column)
                });
                (format!("{}{at}", fault.file), fault.kind.to_string())
            });
            model_error(told.collect())
        }
        Error::Memory { .. } => PyMemoryError::new_err(error.to_string()),
        Error::Output(_)
        | Error::Checkpoint(_)
        | Error::Figure(_)
        | Error::File(_)
        | Error::Division(_)
        | Error::Elsewhere { .. }
        | Error::NotCompleted
        | Error::NotFromTheStart => PyRuntimeError::new_err(error.to_string()),
        Error::Unlike(_) => refused("parameters", error),
        Error::Problem(_) => refused(place, in_python(&error)),
        Error::NotTogether
        | Error::Mesh(_)
        | Error::MeshFile(_)
        | Error::Friction(_)
        | Error::Moduli(_)
        | Error::Rubber(_) => refused(place, error),
    }
}

/// The exception for a broken invariant of the library: Python's programs catch no panics.
pub fn broken(panic: &(dyn Any + Send)) -> PyErr {
    let text = panic.downcast_ref::<String>().map(String::as_str);
    let text = text.or_else(|| panic.downcast_ref::<&str>().copied());
    let text = text.unwrap_or("it gives no reason");
    PyRuntimeError::new_err(format!(
        "the run failed by a fault of striae, which is worth a report with the model: {text}"
    ))
}
