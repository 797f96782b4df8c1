//! Errors of cases.

use std::{io, path::PathBuf};

use striae_figure::FigureError;
use striae_solve::outcome::Ending;

/// Reason why a case could not be computed.
#[derive(Debug, thiserror::Error)]
pub enum Failure {
    /// A run could not be made.
    #[error(transparent)]
    Simulation(#[from] striae::Error),
    /// A run did not reach its end.
    #[error("{0}")]
    Ended(Box<Ending>),
    /// A file or folder cannot be written.
    #[error("{} cannot be written: {cause}", path.display())]
    Unwritable {
        /// The file or folder.
        path: PathBuf,
        /// Error of the operating system.
        cause: io::Error,
    },
    /// A figure cannot be drawn or written.
    #[error(transparent)]
    Figure(#[from] FigureError),
}
