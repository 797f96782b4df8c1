//! Errors of writing results and reading them back.

use std::path::PathBuf;

use striae_files::FileError;

/// Error while writing results or reading them back.
#[derive(Debug, thiserror::Error)]
pub enum OutputError {
    /// A file cannot be written or read.
    #[error(transparent)]
    File(#[from] FileError),
    /// Another rank of the run has failed.
    #[error("rank {rank}: {cause}")]
    Elsewhere {
        /// The rank.
        rank: usize,
        /// Message of the rank.
        cause: String,
    },
    /// The content of a file is not what it should be.
    #[error("{}: {cause}", path.display())]
    Content {
        /// The file.
        path: PathBuf,
        /// Description of the fault, and its place.
        cause: String,
    },
    /// A file of a run is not what the run wrote.
    #[error("{} is damaged: it has changed or shrunk since the run wrote it; restore it, or run the deck again", .0.display())]
    Damaged(PathBuf),
    /// The folder of a new run holds results.
    #[error("{} holds the results of an earlier run; choose another folder, or remove this one, as the program does with `--overwrite`", .0.display())]
    Occupied(PathBuf),
    /// Another run writes to the folder.
    #[error("{} is still being written by another run; wait for its end, or stop it", .0.display())]
    InUse(PathBuf),
    /// A run has gone on since its checkpoint was read.
    #[error("{} has been written to since its checkpoint was read; resume the run again if it has not completed", .0.display())]
    GoneOn(PathBuf),
    /// An array has not one value for every point or cell.
    #[error("{}: array `{array}` has {found} values where {expected} are needed", path.display())]
    ArrayLength {
        /// The file being written.
        path: PathBuf,
        /// The array.
        array: String,
        /// Number of points or cells.
        expected: usize,
        /// Number of its values.
        found: usize,
    },
    /// Two arrays, columns or entries share one name.
    #[error("{}: `{name}` appears twice", path.display())]
    Duplicate {
        /// The file.
        path: PathBuf,
        /// The name.
        name: String,
    },
    /// A cell names a point that does not exist.
    #[error("{}: cell {cell} refers to point {point}, but there are {points} points", path.display())]
    MissingPoint {
        /// The file being written.
        path: PathBuf,
        /// The cell.
        cell: usize,
        /// The point it names.
        point: usize,
        /// Number of points.
        points: usize,
    },
    /// A row of a history has other columns than the first one.
    #[error("{}: row {row} has {found} where column `{expected}` is expected", path.display())]
    Column {
        /// The file being written.
        path: PathBuf,
        /// Number of the row, the first one being 1.
        row: usize,
        /// The column of the first row.
        expected: String,
        /// Column that the row has in its place.
        found: String,
    },
}
