//! Errors of figures.

use std::path::PathBuf;

use striae_files::FileError;

/// Reason why a figure could not be made.
#[derive(Debug, thiserror::Error)]
pub enum FigureError {
    /// The figure cannot be drawn as described.
    #[error("figure {}: {cause}", path.display())]
    Description {
        /// The figure.
        path: PathBuf,
        /// Fault of the description.
        cause: String,
    },
    /// A file cannot be written.
    #[error(transparent)]
    File(#[from] FileError),
}
