//! Reasons why a run cannot be resumed.

use std::{io, path::PathBuf};

use super::{FILE, FORMAT};
use crate::OutputError;

/// Reason why a run cannot be resumed.
#[derive(Debug, thiserror::Error)]
pub enum CheckpointError {
    /// There is no checkpoint.
    #[error(
        "{} has no {FILE}: the run of a deck writes one every few increments and when it is interrupted, and removes it when it completes; runs with derivatives, and of models that are no decks, write none",
        folder.display()
    )]
    Missing {
        /// Folder that was searched.
        folder: PathBuf,
    },
    /// There is no such folder.
    #[error("there is no folder {}; the results of a run are in results/NAME, or where `--out` says", folder.display())]
    NoFolder {
        /// The folder.
        folder: PathBuf,
    },
    /// The run was ended before it wrote a checkpoint.
    #[error(
        "{} has no {FILE}: the run has not come to its first checkpoint, or writes none (`checkpoint_every = 0`, derivatives); if it has ended, run its deck again, with `--overwrite`",
        folder.display()
    )]
    TooEarly {
        /// Its folder.
        folder: PathBuf,
    },
    /// The run was completed.
    #[error(
        "{0} holds a completed run; to continue it with other steps, use `striae resume {0} --with NEW.toml`",
        folder.display()
    )]
    Completed {
        /// Its folder.
        folder: PathBuf,
    },
    /// The file system refused to read it.
    #[error("cannot read {}: {cause}", path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// Error of the operating system.
        #[source]
        cause: io::Error,
    },
    /// The file is of another kind.
    #[error("{} is not a checkpoint", path.display())]
    Foreign {
        /// The file.
        path: PathBuf,
    },
    /// The format is that of another version.
    #[error("{} is a checkpoint of format {found}, not {FORMAT}; run the deck again", path.display())]
    Format {
        /// The file.
        path: PathBuf,
        /// Its format.
        found: u64,
    },
    /// Another version of the program might give other digits.
    #[error(
        "{} was written by striae {found}, and this is {}; run the deck again",
        path.display(),
        env!("CARGO_PKG_VERSION")
    )]
    Version {
        /// The file.
        path: PathBuf,
        /// The version that wrote it.
        found: String,
    },
    /// Its bytes are not those that were written.
    #[error("{} is damaged; run the deck again", path.display())]
    Damaged {
        /// The file.
        path: PathBuf,
    },
    /// The deck means something else than when the run began.
    #[error(
        "{} or a file it reads has changed since the run began; restore it, or run the deck again",
        deck.display()
    )]
    Changed {
        /// The deck.
        deck: PathBuf,
    },
    /// The new deck has other parts than the run.
    #[error(
        "{part} is not the same in the run and in the new deck; only steps, solver and output may differ"
    )]
    Differs {
        /// Name of the part.
        part: String,
    },
    /// The new deck does not begin with the steps that are done.
    #[error(
        "{step} is completed, but the new deck does not begin with it unchanged; keep it, and add further steps after it"
    )]
    StepDiffers {
        /// Name of the step.
        step: String,
    },
    /// The new deck has no step that is not done.
    #[error("the new deck has no step after the completed ones")]
    NothingLeft,
    /// The files beside it are not those it was written with.
    #[error(transparent)]
    Output(#[from] OutputError),
}
