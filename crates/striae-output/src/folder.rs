//! The folder of a run: one run at a time, and nothing of an earlier one beside it.
//!
//! A run holds a lock on its folder for as long as it lasts, where the system can lock
//! folders (Unix); it ends with the process, however that ends.

use std::{
    fs::{self, File, TryLockError},
    path::Path,
    thread,
    time::{Duration, Instant},
};

use striae_files::FileError;

use crate::{
    OutputError, checkpoint,
    parts::is_of,
    removal::{remove_where, removed},
};

/// Treatment of the results of an earlier run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Existing {
    /// The results are kept, and the new run does not begin.
    #[default]
    Keep,
    /// The results are removed before the new run begins.
    Replace,
}

/// Time that a resumed run waits for the previous one to end.
const PATIENCE: Duration = Duration::from_secs(3);

/// Files by which results are known.
const RESULTS: [&str; 10] = [
    "history.csv",
    "probes.csv",
    "sections.csv",
    "bodies.pvd",
    "contact.pvd",
    "rigid.pvd",
    "ties.pvd",
    "summary.json",
    checkpoint::FILE,
    checkpoint::END,
];

/// A folder that is written by nobody else.
#[derive(Debug)]
pub(crate) struct Claim {
    /// Locked until it is dropped.
    _folder: Option<File>,
}

impl Claim {
    /// A folder with results, to continue. Unfinished files of a run that was killed are removed.
    pub(crate) fn of(folder: &Path) -> Result<Self, OutputError> {
        let file = File::open(folder).ok();
        let lock = file.as_ref().map(File::try_lock);
        if matches!(lock, Some(Err(TryLockError::WouldBlock))) {
            return Err(OutputError::InUse(folder.to_owned()));
        }
        for folder in [folder, &folder.join("fields")] {
            if folder.exists() {
                remove_where(folder, striae_files::is_partial)?;
            }
        }
        Ok(Self { _folder: file })
    }

    /// Claims a folder with results, and waits a while for a run that has just been killed.
    pub(crate) fn awaited(folder: &Path) -> Result<Self, OutputError> {
        let started = Instant::now();
        loop {
            match Self::of(folder) {
                Err(OutputError::InUse(_)) if started.elapsed() < PATIENCE => {
                    thread::sleep(Duration::from_millis(50));
                }
                claim => return claim,
            }
        }
    }

    /// A folder for a new run, made if there is none.
    pub(crate) fn new(folder: &Path, existing: Existing) -> Result<Self, OutputError> {
        let fields = folder.join("fields");
        fs::create_dir_all(&fields).map_err(|cause| FileError::Write {
            path: fields.clone(),
            cause,
        })?;
        let claim = Self::of(folder)?;
        if !is_occupied(folder) {
            return Ok(claim);
        }
        match existing {
            Existing::Keep => Err(OutputError::Occupied(folder.to_owned())),
            Existing::Replace => {
                remove_results(folder)?;
                Ok(claim)
            }
        }
    }
}

/// Returns whether a folder holds results of a run.
pub fn is_occupied(folder: &Path) -> bool {
    RESULTS.iter().any(|name| folder.join(name).exists())
}

/// Removes what runs write; anything else in the folder stays, and so does the deck.
fn remove_results(folder: &Path) -> Result<(), OutputError> {
    for name in RESULTS.into_iter().chain(["report.html"]) {
        removed(&folder.join(name))?;
    }
    remove_where(folder, |name| {
        name.starts_with("law-") && name.ends_with(".svg")
            || name.starts_with("sensitivity-") && name.ends_with(".csv")
    })?;
    remove_where(folder, checkpoint::is_piece)?;
    remove_where(&folder.join("fields"), |name| {
        name.ends_with(".vtu") || name.ends_with(".pvtu")
    })
}

/// Removes the fields of an increment, which an interrupted run writes out of turn.
pub(crate) fn remove_fields(folder: &Path, increment: usize) -> Result<(), OutputError> {
    remove_where(folder, |name| is_of(name, increment))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(folder: &Path) -> Vec<String> {
        let entries = fs::read_dir(folder).unwrap();
        let mut names: Vec<String> = entries
            .map(|entry| entry.unwrap().file_name().into_string().unwrap())
            .collect();
        names.sort();
        names
    }

    #[test]
    fn results_are_kept_unless_they_are_to_be_replaced() {
        let folder = tempfile::tempdir().unwrap();
        let folder = folder.path();
        Claim::new(folder, Existing::Keep).unwrap();
        let written = [
            "history.csv",
            "law-a.svg",
            "sensitivity-mu.csv",
            "fields/a-00001.vtu",
            "report.html",
        ];
        let others = ["deck.toml", "notes.txt", "fields/notes.txt"];
        assert!(!is_occupied(folder));
        for name in written.iter().chain(&others) {
            fs::write(folder.join(name), "1").unwrap();
        }
        let refused = Claim::new(folder, Existing::Keep);
        assert!(matches!(refused, Err(OutputError::Occupied(_))));
        assert!(is_occupied(folder));
        assert_eq!(names(folder).len(), 7);
        Claim::new(folder, Existing::Replace).unwrap();
        assert_eq!(names(folder), ["deck.toml", "fields", "notes.txt"]);
        assert_eq!(names(&folder.join("fields")), ["notes.txt"]);
    }

    #[test]
    fn what_was_not_finished_is_removed() {
        let folder = tempfile::tempdir().unwrap();
        let folder = folder.path();
        Claim::new(folder, Existing::Keep).unwrap();
        for name in [
            ".checkpoint.bin.partial",
            "fields/.a-00001.vtu.partial",
            "notes",
        ] {
            fs::write(folder.join(name), "1").unwrap();
        }
        Claim::of(folder).unwrap();
        assert_eq!(names(folder), ["fields", "notes"]);
        assert!(names(&folder.join("fields")).is_empty());
    }

    #[cfg(unix)]
    #[test]
    fn a_folder_belongs_to_one_run_at_a_time() {
        let folder = tempfile::tempdir().unwrap();
        let first = Claim::new(folder.path(), Existing::Replace).unwrap();
        for second in [
            Claim::new(folder.path(), Existing::Replace),
            Claim::of(folder.path()),
        ] {
            assert!(matches!(second, Err(OutputError::InUse(_))));
        }
        let ends = thread::spawn(move || {
            thread::sleep(Duration::from_millis(200));
            drop(first);
        });
        Claim::awaited(folder.path()).unwrap();
        ends.join().unwrap();
    }
}
