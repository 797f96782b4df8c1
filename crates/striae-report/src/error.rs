//! Why there is no report.

use std::path::PathBuf;

use striae_files::FileError;
use striae_output::OutputError;

/// What can go wrong.
#[derive(Debug, thiserror::Error)]
pub enum ReportError {
    /// The folder holds no results.
    #[error("{} has neither history.csv nor bodies.pvd, so there is nothing to report", .0.display())]
    Nothing(PathBuf),
    /// Results cannot be read.
    #[error(transparent)]
    Results(#[from] OutputError),
    /// A file cannot be read or written.
    #[error(transparent)]
    File(#[from] FileError),
    /// The files of a part at different times do not belong together.
    #[error("{}: {found} points where the files before have {expected}", path.display())]
    Points {
        /// The file.
        path: PathBuf,
        /// Points of the file.
        found: usize,
        /// Points of the first file of the part.
        expected: usize,
    },
    /// A file has cells that the format does not know.
    #[error("{}: cells of VTK's shape {shape} cannot be shown", path.display())]
    Shape {
        /// The file.
        path: PathBuf,
        /// The code of the shape.
        shape: u8,
    },
}
