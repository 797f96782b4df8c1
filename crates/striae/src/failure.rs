//! Ways in which the program fails, and their exit codes.

use std::{io, path::PathBuf, process::ExitCode};
use striae_io::{OutputError, deck::Faults};
use striae_solve::{outcome::Ending, problem::ProblemError};

/// Why the program did not do what it was asked for.
#[derive(Debug, thiserror::Error)]
pub enum Failure {
    /// The deck is faulty.
    #[error("{0}")]
    Deck(#[from] Faults),
    /// A folder that would be written exists.
    #[error("{} exists already; choose another name", .0.display())]
    Exists(PathBuf),
    /// A file or folder cannot be written.
    #[error("{} cannot be written: {cause}", path.display())]
    Unwritable {
        /// The file or folder.
        path: PathBuf,
        /// What the operating system says.
        cause: io::Error,
    },
    /// The deck of a checkpoint is not what it was.
    #[error("{} has changed since the checkpoint; run it anew", .0.display())]
    Changed(PathBuf),
    /// The model cannot be solved.
    #[error("{0}")]
    Problem(#[from] ProblemError),
    /// The run did not reach its end.
    #[error("{0}")]
    Ended(Ending),
    /// There is no case of this name.
    #[error("there is no case `{name}`; known are {known}")]
    UnknownCase {
        /// What was asked for.
        name: String,
        /// All names.
        known: String,
    },
    /// Cases did not give what is known of them.
    #[error("outside the tolerances: {0}")]
    Deviates(String),
    /// Results cannot be written.
    #[error("{0}")]
    Results(#[from] OutputError),
    /// The threads cannot be started.
    #[error("the threads cannot be started: {0}")]
    Threads(String),
    /// The standard output cannot be written.
    #[error("the output cannot be written: {0}")]
    Output(#[from] io::Error),
}

impl Failure {
    /// The exit code: 2 for bad input, 1 for everything else.
    pub fn exit_code(&self) -> ExitCode {
        match self {
            Self::Deck(_)
            | Self::Exists(_)
            | Self::Changed(_)
            | Self::Problem(_)
            | Self::UnknownCase { .. } => ExitCode::from(2),
            Self::Unwritable { .. }
            | Self::Ended(_)
            | Self::Deviates(_)
            | Self::Results(_)
            | Self::Threads(_)
            | Self::Output(_) => ExitCode::from(1),
        }
    }
}
