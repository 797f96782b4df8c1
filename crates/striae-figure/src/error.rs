//! Why a figure could not be made.

use std::path::PathBuf;

use striae_files::FileError;

/// Why a figure could not be made.
#[derive(Debug, thiserror::Error)]
pub enum FigureError {
    /// It cannot be drawn as described.
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
