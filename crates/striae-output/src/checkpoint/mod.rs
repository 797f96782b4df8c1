//! A run under way in a file, exactly, so that it can go on as if it had not stopped.
//!
//! ```text
//! DIR/checkpoint.bin = "striae checkpoint\n", format, CRC-32 of the rest,
//!                      version of the program, source, what is on disk, point of the run
//! DIR/end.bin          the same at the end of a completed run, without what is on disk
//! ```
//!
//! Numbers are little-endian and have eight bytes. The file is written whole or not
//! at all. The deck is known by a fingerprint of what it means, generated and read
//! meshes included, so that a run never goes on with another one than it began with.

mod code;
mod error;

use std::{
    fmt::{self, Write},
    io::ErrorKind,
    path::{Path, PathBuf},
};

use striae_files::{FileError, write_atomically};
use striae_solve::{
    drive::Point,
    model::{Model, Step},
};

use crate::{Checksums, Output, OutputError, vtk::Snapshot, worn::Worn};
use code::{Coded, coded};
pub use error::CheckpointError;

/// Name of the file in the folder of a run.
pub const FILE: &str = "checkpoint.bin";

/// Name of that which a completed run leaves.
pub const END: &str = "end.bin";

/// First bytes of the file.
const MAGIC: &[u8] = b"striae checkpoint\n";

/// Number of the format, to be raised when the content changes.
pub const FORMAT: u64 = 11;

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
    pub path: PathBuf,
    /// What the deck means, see [`fingerprint`].
    pub fingerprint: u64,
    /// What each body, rigid surface and pair means, by its name.
    pub parts: Vec<(String, u64)>,
    /// What each step means.
    pub steps: Vec<(String, u64)>,
}

/// What a recorder has written.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Written {
    /// Newton iterations of every increment.
    pub iterations: Vec<usize>,
    /// Increments that were cut.
    pub cut_backs: usize,
    /// Unknowns of the last system.
    pub unknowns: usize,
    /// What the linear systems took.
    pub solver: crate::summary::SolverSummary,
    /// Increment of the last fields.
    pub fields: Option<usize>,
    /// Seconds spent.
    pub seconds: f64,
    /// Files of the bodies, of the contact surfaces and of the rigid ones.
    pub series: [Vec<Snapshot>; 3],
    /// What has been judged so far.
    pub judgement: striae_solve::warning::Judgement,
    /// What slip has done so far.
    pub worn: Worn,
    /// Time of the last increment.
    pub elapsed: f64,
    /// Checksums of the files.
    pub sums: Checksums,
}

/// A number that differs, but for rare coincidences, where models or what is
/// written of them differ: in the deck itself or in a file that it reads.
pub fn fingerprint(model: &Model, output: &Output) -> u64 {
    let mut hash = Hash(crc32fast::Hasher::new());
    write!(hash, "{model:?} {output:?}").expect("a hash takes any text");
    u64::from(hash.0.finalize())
}

/// Fingerprints of the bodies, rigid surfaces and pairs of a model, by what they are called.
pub fn part_fingerprints(model: &Model) -> Vec<(String, u64)> {
    let bodies = model.bodies.iter();
    let bodies = bodies.map(|body| (format!("body `{}`", body.name), of(body)));
    let rigid = model.rigid_surfaces.iter();
    let rigid = rigid.map(|rigid| (format!("rigid surface `{}`", rigid.name), of(rigid)));
    let pairs = model.pairs.iter();
    let pairs = pairs.map(|pair| (format!("pair `{}`", pair.name), of(pair)));
    bodies.chain(rigid).chain(pairs).collect()
}

/// Fingerprints of the steps of a model, by what they are called.
pub fn step_fingerprints(model: &Model) -> Vec<(String, u64)> {
    let steps = model.steps.iter();
    let steps = steps.map(|step| (format!("step `{}`", step.name), step_fingerprint(step)));
    steps.collect()
}

/// Fingerprint of a step.
pub fn step_fingerprint(step: &Step) -> u64 {
    of(step)
}

fn of(part: &impl fmt::Debug) -> u64 {
    let mut hash = Hash(crc32fast::Hasher::new());
    write!(hash, "{part:?}").expect("a hash takes any text");
    u64::from(hash.0.finalize())
}

struct Hash(crc32fast::Hasher);

impl Write for Hash {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        self.0.update(text.as_bytes());
        Ok(())
    }
}

impl Checkpoint {
    /// Writes the checkpoint to a folder.
    ///
    /// # Errors
    /// When the file cannot be written.
    pub fn write(&self, folder: &Path) -> Result<(), OutputError> {
        self.write_as(&folder.join(FILE))
    }

    /// Writes it as that of the end of a completed run.
    ///
    /// # Errors
    /// When the file cannot be written.
    pub fn write_end(&self, folder: &Path) -> Result<(), OutputError> {
        self.write_as(&folder.join(END))
    }

    fn write_as(&self, path: &Path) -> Result<(), OutputError> {
        let mut content = Vec::new();
        env!("CARGO_PKG_VERSION").to_owned().put(&mut content);
        self.put(&mut content);
        let mut bytes = MAGIC.to_vec();
        FORMAT.put(&mut bytes);
        u64::from(crc32fast::hash(&content)).put(&mut bytes);
        bytes.append(&mut content);
        write_atomically(path, &bytes)?;
        Ok(())
    }

    /// Reads the checkpoint of a folder.
    ///
    /// # Errors
    /// When there is none, or none that can be used.
    pub fn read(folder: &Path) -> Result<Self, CheckpointError> {
        let path = folder.join(FILE);
        match std::fs::read(&path) {
            Ok(bytes) => taken(&path, &bytes),
            Err(cause) if cause.kind() == ErrorKind::NotFound => {
                let folder = folder.to_owned();
                Err(match folder.join(END).exists() {
                    true => CheckpointError::Completed { folder },
                    false => CheckpointError::Missing { folder },
                })
            }
            Err(cause) => Err(CheckpointError::Unreadable { path, cause }),
        }
    }

    /// Reads the checkpoint of a folder, or that of the end of a completed run.
    ///
    /// # Errors
    /// When there is none, or none that can be used.
    pub fn read_last(folder: &Path) -> Result<Self, CheckpointError> {
        let end = folder.join(END);
        match (Self::read(folder), std::fs::read(&end)) {
            (Err(CheckpointError::Completed { .. }), Ok(bytes)) => taken(&end, &bytes),
            (read, _) => read,
        }
    }

    /// Takes the checkpoint out of a folder, if there is one.
    ///
    /// # Errors
    /// When the file is there and cannot be removed.
    pub fn remove(folder: &Path) -> Result<(), OutputError> {
        let path = folder.join(FILE);
        match std::fs::remove_file(&path) {
            Err(cause) if cause.kind() != ErrorKind::NotFound => {
                Err(FileError::Write { path, cause }.into())
            }
            _ => Ok(()),
        }
    }
}

impl Source {
    /// Whether the run is of this model.
    ///
    /// # Errors
    /// When it began with another one.
    pub fn check(&self, model: &Model, output: &Output) -> Result<(), CheckpointError> {
        if fingerprint(model, output) == self.fingerprint {
            Ok(())
        } else {
            Err(CheckpointError::Changed {
                deck: self.path.clone(),
            })
        }
    }
}

impl Source {
    /// Whether a model has the bodies, rigid surfaces and pairs of the run.
    ///
    /// # Errors
    /// The first of them that it has not, or has besides.
    pub fn check_parts(&self, model: &Model) -> Result<(), CheckpointError> {
        let found = part_fingerprints(model);
        let differs = |one: &[(String, u64)], other: &[(String, u64)]| {
            let mut parts = one.iter().filter(|part| !other.contains(part));
            parts.next().map(|(name, _)| name.clone())
        };
        let mut differs = differs(&self.parts, &found).or_else(|| differs(&found, &self.parts));
        if found != self.parts {
            differs = differs.or_else(|| Some("the order of bodies, surfaces or pairs".into()));
        }
        differs.map_or(Ok(()), |part| Err(CheckpointError::Differs { part }))
    }

    /// Whether a model begins with the steps that the run has done, so many.
    ///
    /// # Errors
    /// The first of them that differs.
    pub fn check_steps(&self, model: &Model, done: usize) -> Result<(), CheckpointError> {
        let found = step_fingerprints(model);
        let mut steps = self.steps.iter().enumerate().take(done);
        let differs = steps.find(|(at, step)| found.get(*at) != Some(step));
        differs.map_or(Ok(()), |(_, (name, _))| {
            Err(CheckpointError::StepDiffers { step: name.clone() })
        })
    }
}

fn taken(path: &Path, bytes: &[u8]) -> Result<Checkpoint, CheckpointError> {
    let path = || path.to_owned();
    let mut rest = bytes
        .strip_prefix(MAGIC)
        .ok_or_else(|| CheckpointError::Foreign { path: path() })?;
    let damaged = || CheckpointError::Damaged { path: path() };
    let found = u64::take(&mut rest).ok_or_else(damaged)?;
    if found != FORMAT {
        return Err(CheckpointError::Format {
            path: path(),
            found,
        });
    }
    let sum = u64::take(&mut rest).ok_or_else(damaged)?;
    if sum != u64::from(crc32fast::hash(rest)) {
        return Err(damaged());
    }
    let found = String::take(&mut rest).ok_or_else(damaged)?;
    if found != env!("CARGO_PKG_VERSION") {
        return Err(CheckpointError::Version {
            path: path(),
            found,
        });
    }
    let checkpoint = Checkpoint::take(&mut rest).filter(|_| rest.is_empty());
    checkpoint.ok_or_else(damaged)
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
    Source { case, path, fingerprint, parts, steps };
    Written { iterations, cut_backs, unknowns, solver, fields, seconds, series, judgement, worn, elapsed, sums };
    Worn { pairs };
    Snapshot { time, parts };
}
