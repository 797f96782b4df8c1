//! A flag that stops runs from elsewhere: another thread, or a signal.

use std::sync::{
    Arc,
    atomic::{AtomicBool, Ordering},
};

/// A flag that stops the runs that watch it after their current increment. Clones share it.
#[derive(Clone, Debug, Default)]
pub struct Interrupt(Arc<AtomicBool>);

impl Interrupt {
    /// Asks the runs to stop; returns whether that had been asked before.
    pub fn set(&self) -> Before {
        if self.0.swap(true, Ordering::Relaxed) {
            Before::Set
        } else {
            Before::Clear
        }
    }

    /// Returns whether the runs are to stop.
    pub fn is_set(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

/// State of a flag before it was set.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Before {
    /// Not set.
    Clear,
    /// Set already.
    Set,
}
