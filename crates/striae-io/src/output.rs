//! What every writer shares: its errors, and files that appear whole or not at all.
//!
//! [`write_atomically`] writes to a neighbour of the target and renames it, so a
//! reader (or an interrupted run) meets the old content or the new, never half
//! of either.

use std::ffi::OsString;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// What can go wrong while writing results or reading them back.
#[derive(Debug, thiserror::Error)]
pub enum OutputError {
    /// The file system refused to write.
    #[error("cannot write {}: {cause}", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// What the system said.
        #[source]
        cause: io::Error,
    },
    /// The file system refused to read.
    #[error("cannot read {}: {cause}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// What the system said.
        #[source]
        cause: io::Error,
    },
    /// The content of a file is not what it should be.
    #[error("{}: {cause}", path.display())]
    Content {
        /// The file.
        path: PathBuf,
        /// What is wrong, and where.
        cause: String,
    },
    /// An array has not one value for every point or cell.
    #[error("{}: array `{array}` has {found} values where {expected} are needed", path.display())]
    ArrayLength {
        /// The file being written.
        path: PathBuf,
        /// The array.
        array: String,
        /// How many points or cells there are.
        expected: usize,
        /// How many values it has.
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
        /// How many points there are.
        points: usize,
    },
    /// A row of a history has other columns than the first one.
    #[error("{}: row {row} has {found} where column `{expected}` is due", path.display())]
    Column {
        /// The file being written.
        path: PathBuf,
        /// Number of the row, the first one being 1.
        row: usize,
        /// The column of the first row.
        expected: String,
        /// What the row has in its place.
        found: String,
    },
    /// A figure cannot be drawn as described.
    #[error("figure {}: {cause}", path.display())]
    Figure {
        /// The figure.
        path: PathBuf,
        /// What is wrong with the description.
        cause: String,
    },
}

/// Writes `content` to `path` by way of a temporary neighbour and a rename.
pub fn write_atomically(path: &Path, content: &[u8]) -> Result<(), OutputError> {
    let mut name = OsString::from(".");
    name.push(path.file_name().unwrap_or_default());
    name.push(".partial");
    let partial = path.with_file_name(name);
    fs::write(&partial, content)
        .and_then(|()| fs::rename(&partial, path))
        .map_err(|cause| OutputError::Write {
            path: path.to_owned(),
            cause,
        })
}

/// Reads a whole text file.
pub(crate) fn read_text(path: &Path) -> Result<String, OutputError> {
    fs::read_to_string(path).map_err(|cause| OutputError::Read {
        path: path.to_owned(),
        cause,
    })
}
