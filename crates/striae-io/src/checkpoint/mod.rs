//! A run under way in a file, exactly, so that it can go on as if it had not stopped.
//!
//! `DIR/checkpoint.bin` holds the deck, the point the run has come to and what the
//! recorder knows. It is written whole or not at all.

mod code;

use std::path::{Path, PathBuf};

use striae_solve::drive::Point;

use crate::{OutputError, output::write_atomically, vtk::Snapshot};
use code::{Coded, coded};

/// Name of the file in the folder of a run.
pub const FILE: &str = "checkpoint.bin";

/// First bytes of the file.
const MAGIC: &str = "striae checkpoint 1";

/// A run under way.
#[derive(Clone, Debug)]
pub struct Checkpoint {
    /// Which deck is run.
    pub source: Source,
    /// What is on disk.
    pub written: Written,
    /// Where the run is.
    pub point: Point,
}

/// The deck of a run.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Source {
    /// Name of the case.
    pub case: String,
    /// Path of the deck.
    pub path: String,
    /// Its text.
    pub text: String,
}

/// What a recorder has written.
#[derive(Clone, Debug, PartialEq)]
pub struct Written {
    /// Newton iterations of every increment.
    pub iterations: Vec<usize>,
    /// Increments that were cut.
    pub cut_backs: usize,
    /// Seconds spent.
    pub seconds: f64,
    /// Files of the bodies and of the contact surfaces.
    pub series: [Vec<Snapshot>; 2],
}

impl Checkpoint {
    /// Writes the checkpoint to a folder.
    ///
    /// # Errors
    /// When the file cannot be written.
    pub fn write(&self, folder: &Path) -> Result<(), OutputError> {
        let mut bytes = Vec::new();
        MAGIC.to_owned().put(&mut bytes);
        self.put(&mut bytes);
        write_atomically(&folder.join(FILE), &bytes)
    }

    /// Reads the checkpoint of a folder.
    ///
    /// # Errors
    /// When the file cannot be read or is no checkpoint of this version.
    pub fn read(folder: &Path) -> Result<Self, OutputError> {
        let path = folder.join(FILE);
        let bytes = match std::fs::read(&path) {
            Ok(bytes) => bytes,
            Err(cause) => return Err(OutputError::Read { path, cause }),
        };
        let mut rest = &bytes[..];
        let magic = String::take(&mut rest);
        let found = Self::take(&mut rest).filter(|_| rest.is_empty());
        match (magic.as_deref(), found) {
            (Some(MAGIC), Some(checkpoint)) => Ok(checkpoint),
            _ => Err(OutputError::Content {
                path,
                cause: "not a checkpoint of this version, or not whole".to_owned(),
            }),
        }
    }
}

impl Coded for PathBuf {
    fn put(&self, bytes: &mut Vec<u8>) {
        self.to_string_lossy().into_owned().put(bytes);
    }

    fn take(bytes: &mut &[u8]) -> Option<Self> {
        String::take(bytes).map(Self::from)
    }
}

coded! {
    Checkpoint { source, written, point };
    Source { case, path, text };
    Written { iterations, cut_backs, seconds, series };
    Snapshot { time, parts };
}
