//! Files that appear whole or not at all, shared by all writers.
//!
//! [`write_atomically`] writes to a neighbour of the target and renames it, so a
//! reader (or an interrupted run) sees the old content or the new, never half of
//! either. [`quoted`] is one field of comma-separated text that is written, [`Separator`] parts
//! fields of a text that is read, [`Stems`] are names of files.

mod separator;
mod stems;

use std::ffi::OsString;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

pub use separator::Separator;
pub use stems::Stems;

/// Reason why a file could not be written or read.
#[derive(Debug, thiserror::Error)]
pub enum FileError {
    /// The file system refused to write.
    #[error("cannot write {}: {cause}", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// Error of the operating system.
        #[source]
        cause: io::Error,
    },
    /// The file system refused to read.
    #[error("cannot read {}: {cause}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// Error of the operating system.
        #[source]
        cause: io::Error,
    },
}

/// Writes `content` to `path` by way of a temporary neighbour and a rename.
///
/// # Errors
/// When the file system refuses.
pub fn write_atomically(path: &Path, content: &[u8]) -> Result<(), FileError> {
    let mut name = OsString::from(".");
    name.push(path.file_name().unwrap_or_default());
    name.push(".partial");
    let partial = path.with_file_name(name);
    let written = fs::write(&partial, content).and_then(|()| fs::rename(&partial, path));
    written.map_err(|cause| {
        // On a full disk the neighbour takes room that others need.
        let _ = fs::remove_file(&partial);
        FileError::Write {
            path: path.to_owned(),
            cause,
        }
    })
}

/// Returns whether a file of this name is an incomplete file of [`write_atomically`], left when the
/// program was killed.
pub fn is_partial(name: &str) -> bool {
    name.starts_with('.') && name.ends_with(".partial")
}

/// Reads a whole text file.
///
/// # Errors
/// When the file system refuses or the text is not UTF-8.
pub fn read_text(path: &Path) -> Result<String, FileError> {
    fs::read_to_string(path).map_err(|cause| FileError::Read {
        path: path.to_owned(),
        cause,
    })
}

/// A field of comma-separated text, in quotes where it needs them.
pub fn quoted(text: &str) -> String {
    if text.contains([',', '"', '\n']) {
        format!("\"{}\"", text.replace('"', "\"\""))
    } else {
        text.to_owned()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_is_replaced_and_leaves_no_neighbour() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.txt");
        for content in ["old", "new"] {
            write_atomically(&path, content.as_bytes()).unwrap();
            assert_eq!(read_text(&path).unwrap(), content);
        }
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
    }

    #[test]
    fn refusals_name_the_file() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("missing").join("a.txt");
        let start = |what: &str| format!("cannot {what} {}: ", path.display());
        let error = write_atomically(&path, b"").unwrap_err().to_string();
        assert!(error.starts_with(&start("write")), "{error}");
        let error = read_text(&path).unwrap_err().to_string();
        assert!(error.starts_with(&start("read")), "{error}");
    }

    #[test]
    fn what_cannot_be_finished_is_not_left_over() {
        let folder = tempfile::tempdir().unwrap();
        let taken = folder.path().join("a.txt");
        fs::create_dir(&taken).unwrap();
        write_atomically(&taken, b"1").unwrap_err();
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
        assert!(is_partial(".a.txt.partial") && !is_partial("a.txt"));
    }

    #[test]
    fn fields_are_quoted_where_they_need_it() {
        assert_eq!(quoted("plain"), "plain");
        assert_eq!(quoted("a, \"b\""), "\"a, \"\"b\"\"\"");
    }
}
