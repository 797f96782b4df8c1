//! Exceptions raised by Python functions that a run calls.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use pyo3::prelude::*;

/// The first exception of a function.
#[derive(Clone, Default)]
pub struct Raised(Arc<Mutex<Option<PyErr>>>);

impl Raised {
    /// Returns whether an exception has been raised.
    pub fn is_set(&self) -> bool {
        self.lock().is_some()
    }

    /// The exception, which is forgotten.
    pub fn take(&self) -> Option<PyErr> {
        self.lock().take()
    }

    /// Keeps an exception, if it is the first.
    pub fn set(&self, error: PyErr) {
        self.lock().get_or_insert(error);
    }

    fn lock(&self) -> MutexGuard<'_, Option<PyErr>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
