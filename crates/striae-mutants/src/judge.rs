//! Rules that hold for every input, however it is damaged.
//!
//! No panic; every message has a place, a line or the name of a part; a deck that has passed
//! `check` can begin to run, and what ends its first increment is told in words of the model.

mod deck;
mod file;

use std::{
    panic::{AssertUnwindSafe, catch_unwind},
    path::{Path, PathBuf},
    sync::{Arc, Mutex, PoisonError},
};

use crate::target::{Sample, Target};

/// Stage that an input reaches.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reached {
    /// The input is refused.
    Refused,
    /// The input is read.
    Accepted,
    /// The input has begun to run.
    Run,
}

/// A kind of failure.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Kind {
    /// The reader panics.
    Panic,
    /// A message has no place.
    NoPlace,
    /// A message is about the program's own numbers.
    Raw,
    /// The input takes too long.
    Slow,
    /// A run is refused after its check has found nothing.
    Disagreement,
}

/// A failure.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Finding {
    /// Its kind.
    pub kind: Kind,
    /// Account of it.
    pub text: String,
}

/// Depth to which accepted decks are tried.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Depth {
    /// Decks are checked.
    Check,
    /// Decks are run for an increment, if they are small.
    Run,
}

/// A folder of its own for the files of a judge, removed with it.
#[derive(Debug)]
struct Folder(PathBuf);

impl Folder {
    fn new() -> std::io::Result<Self> {
        let beside = std::env::temp_dir();
        let process = std::process::id();
        let mut names = (0..).map(|number: u32| format!("striae-mutants-{process}-{number}"));
        loop {
            let path = beside.join(names.next().unwrap_or_default());
            match std::fs::create_dir(&path) {
                Err(cause) if cause.kind() == std::io::ErrorKind::AlreadyExists => {}
                made => return made.map(|()| Self(path)),
            }
        }
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        // What is left in a folder for temporary files does no harm.
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

/// Judges inputs, and catches panics.
#[derive(Debug)]
pub struct Judge {
    folder: Folder,
    panics: Arc<Mutex<Vec<String>>>,
}

impl Judge {
    /// A judge, with a folder for files; panics are recorded instead of shown from here on.
    ///
    /// # Errors
    /// When no folder can be made.
    pub fn new() -> std::io::Result<Self> {
        let panics = Arc::new(Mutex::new(Vec::new()));
        let record = Arc::clone(&panics);
        std::panic::set_hook(Box::new(move |info| {
            let mut all = record.lock().unwrap_or_else(PoisonError::into_inner);
            all.push(info.to_string().replace('\n', " "));
        }));
        Ok(Self {
            folder: Folder::new()?,
            panics,
        })
    }

    /// The folder for files.
    pub fn folder(&self) -> &Path {
        &self.folder.0
    }

    /// Reads an input.
    ///
    /// # Errors
    /// The first failure.
    pub fn judge(&self, target: Target, sample: &Sample, depth: Depth) -> Result<Reached, Finding> {
        let folder = self.folder();
        let judged = catch_unwind(AssertUnwindSafe(|| match target {
            Target::Deck => deck::deck(sample, folder, depth),
            Target::Gmsh | Target::Abaqus | Target::Vtk => file::mesh(sample, folder, depth),
            Target::Stl => file::surface(sample, folder, depth),
            Target::Convert => file::convert(sample, folder, depth),
            Target::Checkpoint => file::checkpoint(sample, folder),
            Target::Measurements => file::measurements(sample),
        }));
        judged.unwrap_or_else(|_| {
            let mut panics = self.panics.lock().unwrap_or_else(PoisonError::into_inner);
            Err(Finding {
                kind: Kind::Panic,
                text: panics.drain(..).collect::<Vec<_>>().join("; "),
            })
        })
    }
}

fn failed<T>(kind: Kind, text: impl Into<String>) -> Result<T, Finding> {
    let text = text.into();
    Err(Finding { kind, text })
}

/// Words that are no answer to what is wrong with an input.
const RAW: [&str; 5] = [
    "please report",
    "panicked",
    "internal error",
    "equation",
    "matrix",
];

/// Refuses messages about unknowns by number and the like; what they quote is the user's.
fn worded(message: &str) -> Result<(), Finding> {
    let own: String = message.split('`').step_by(2).collect();
    let numbered = own
        .split("unknown ")
        .skip(1)
        .any(|rest| rest.starts_with(|c: char| c.is_ascii_digit()));
    match numbered || RAW.iter().any(|raw| own.contains(raw)) {
        true => failed(Kind::Raw, message),
        false => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn messages_may_quote_any_words_and_use_their_own() {
        assert_eq!(
            worded("line 3: expected a number, found `unknown 45`"),
            Ok(())
        );
        assert!(worded("`a` needs unknown 45").is_err());
        assert!(worded("`a` has a singular matrix").is_err());
    }
}
