//! Checksums of the files of a run, so that a resumed run notices what has been damaged.

use std::{fs, path::Path};

use striae_files::FileError;

use crate::OutputError;

/// Length and CRC-32 of files, by their paths in the folder of the run.
pub type Checksums = Vec<(String, [u64; 2])>;

/// Present length and checksum of a file.
pub(crate) fn sum(folder: &Path, name: &Path) -> Result<(String, [u64; 2]), OutputError> {
    let bytes = content(&folder.join(name))?;
    Ok((name.to_string_lossy().into_owned(), sum_of(&bytes)))
}

/// Length and checksum of the content of a file.
pub(crate) fn sum_of(bytes: &[u8]) -> [u64; 2] {
    [bytes.len() as u64, u64::from(crc32fast::hash(bytes))]
}

/// Checks that files begin with their recorded content; tables may have grown since.
pub(crate) fn check<'a>(
    folder: &Path,
    sums: impl IntoIterator<Item = &'a (String, [u64; 2])>,
) -> Result<(), OutputError> {
    for (name, [length, sum]) in sums {
        let path = folder.join(name);
        let bytes = content(&path)?;
        let start = bytes.get(..*length as usize);
        if start.is_none_or(|start| u64::from(crc32fast::hash(start)) != *sum) {
            return Err(OutputError::Damaged(path));
        }
    }
    Ok(())
}

fn content(path: &Path) -> Result<Vec<u8>, OutputError> {
    fs::read(path).map_err(|cause| {
        let path = path.to_owned();
        FileError::Read { path, cause }.into()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_may_grow_but_not_change_or_shrink() {
        let folder = tempfile::tempdir().unwrap();
        let (folder, name) = (folder.path(), Path::new("history.csv"));
        let path = folder.join(name);
        fs::write(&path, "a,b\n1,2\n").unwrap();
        let sums = vec![sum(folder, name).unwrap()];
        fs::write(&path, "a,b\n1,2\n3,4\n").unwrap();
        assert!(check(folder, &sums).is_ok());
        for damaged in ["a,b\n1,3\n3,4\n", "a,b\n", ""] {
            fs::write(&path, damaged).unwrap();
            let found = check(folder, &sums).unwrap_err().to_string();
            assert!(
                found.contains("history.csv") && found.contains("changed"),
                "{found}"
            );
        }
        fs::remove_file(&path).unwrap();
        assert!(check(folder, &sums).is_err());
    }
}
