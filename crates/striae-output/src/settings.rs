//! What a run writes, and how often.

use std::num::NonZeroUsize;

/// What a run writes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Output {
    /// When fields are written.
    pub fields: FieldOutput,
    /// Increments between checkpoints; `None`: only when interrupted.
    pub checkpoint_every: Option<NonZeroUsize>,
}

/// Fields after every increment, checkpoints after every ten.
impl Default for Output {
    fn default() -> Self {
        Self {
            fields: FieldOutput::Every(NonZeroUsize::MIN),
            checkpoint_every: NonZeroUsize::new(10),
        }
    }
}

/// When fields are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FieldOutput {
    /// After every so many increments, and after the last.
    Every(NonZeroUsize),
    /// After the last increment only.
    Last,
}
