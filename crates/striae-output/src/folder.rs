//! The folder of a run.

use std::path::Path;

use striae_files::FileError;

use crate::OutputError;

/// Removes the fields of an increment, which an interrupted run writes out of turn.
pub(crate) fn remove_fields(folder: &Path, increment: usize) -> Result<(), OutputError> {
    let refused = |cause| FileError::Write {
        path: folder.to_owned(),
        cause,
    };
    let end = format!("-{increment:05}.vtu");
    for entry in std::fs::read_dir(folder).map_err(refused)? {
        let entry = entry.map_err(refused)?;
        if entry.file_name().to_string_lossy().ends_with(&end) {
            std::fs::remove_file(entry.path()).map_err(refused)?;
        }
    }
    Ok(())
}
