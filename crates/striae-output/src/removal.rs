//! Files that go.

use std::{fs, io::ErrorKind, path::Path};

use striae_files::FileError;

use crate::OutputError;

/// Removes a file, if there is one.
pub(crate) fn removed(path: &Path) -> Result<(), OutputError> {
    match fs::remove_file(path) {
        Err(cause) if cause.kind() != ErrorKind::NotFound => Err(FileError::Write {
            path: path.to_owned(),
            cause,
        }
        .into()),
        _ => Ok(()),
    }
}

/// Removes files of a folder by their names.
pub(crate) fn remove_where(folder: &Path, goes: impl Fn(&str) -> bool) -> Result<(), OutputError> {
    let refused = |cause| FileError::Write {
        path: folder.to_owned(),
        cause,
    };
    for entry in fs::read_dir(folder).map_err(refused)? {
        let entry = entry.map_err(refused)?;
        if goes(&entry.file_name().to_string_lossy()) {
            removed(&entry.path())?;
        }
    }
    Ok(())
}
