//! A run in progress, stored exactly in a file, so that it can continue as if it had not stopped.
//!
//! ```text
//! DIR/checkpoint.bin = "striae checkpoint\n", format, CRC-32 of the rest,
//!                      version of the program, source, what is on disk, point of the run
//! DIR/end.bin          the same at the end of a completed run, without what is on disk
//! DIR/checkpoint-SET.RANK.bin, DIR/end-SET.RANK.bin
//!                      pieces: values at the nodes and in the elements of a rank
//! ```
//!
//! On several ranks a checkpoint is an index with what all ranks hold, and a piece of each. A
//! new set of pieces is there before the index that names it, the old one goes after, so that
//! at any moment the folder has one set that is whole. Pieces number nodes and elements as the
//! whole does: a run goes on on as many ranks as there are then, see [`Index`].
//!
//! Format and checksum are little-endian numbers of eight bytes, the rest is in the format of
//! [postcard](https://postcard.jamesmunns.com/wire-format). The file is written whole or not
//! at all. The deck is known by a fingerprint of what it means in bytes, generated and read
//! meshes included, so that a run never goes on with another one than it began with.

mod error;
mod index;
mod pieces;

use postcard::ser_flavors::Flavor;
use serde::{Deserialize, Serialize, Serializer};
use std::path::{Path, PathBuf};

use striae_model::{Model, Step};
use striae_solve::{drive::Point, problem::Problem, share::Share};

use crate::{
    Checksums, FieldOutput, Output, OutputError, ranks::on_first, vtk::Snapshot, worn::Worn,
};
pub use error::CheckpointError;
pub use index::Index;
pub(crate) use pieces::is_piece;

/// Name of the file in the folder of a run.
pub const FILE: &str = "checkpoint.bin";

/// Name of that which a completed run leaves.
pub const END: &str = "end.bin";

/// Number of the format, to be raised when the content changes.
pub const FORMAT: u64 = 25;

/// A run in progress.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Checkpoint {
    /// Deck that is run.
    pub source: Source,
    /// Record of the files on disk.
    pub written: Written,
    /// Point that the run has reached.
    pub point: Point,
}

/// The deck of a run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Source {
    /// Name of the case.
    pub case: String,
    /// Path of the deck.
    #[serde(serialize_with = "as_text")]
    pub path: PathBuf,
    /// Parameters of the deck that were set from outside, with their values.
    pub settings: Vec<(String, f64)>,
    /// Increments or times of fields, if others than those of the deck were asked for.
    pub fields: Option<FieldOutput>,
    /// Fingerprint of the meaning of the deck, see [`fingerprint`].
    pub fingerprint: u64,
    /// Fingerprint of each body, rigid surface and pair, by its name.
    pub parts: Vec<(String, u64)>,
    /// Fingerprint of each step.
    pub steps: Vec<(String, u64)>,
}

/// Output that a recorder has written.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Written {
    /// Newton iterations of every increment.
    pub iterations: Vec<usize>,
    /// Columns of the history.
    pub columns: Vec<String>,
    /// Increments that were cut.
    pub cut_backs: usize,
    /// Unknowns of the last system.
    pub unknowns: usize,
    /// Work spent on the linear systems.
    pub solver: crate::summary::SolverSummary,
    /// Increment of the last fields.
    pub fields: Option<usize>,
    /// Seconds spent.
    pub seconds: f64,
    /// Files of the bodies, of the contact surfaces, of the rigid ones and of the ties.
    pub series: [Vec<Snapshot>; 4],
    /// Warnings gathered so far.
    pub judgement: striae_solve::warning::Judgement,
    /// Sums over slip so far.
    pub worn: Worn,
    /// Time of the last increment.
    pub elapsed: f64,
    /// Checksums of the files.
    pub sums: Checksums,
}

/// A number that differs, but for rare coincidences, where models or what is
/// written of them differ: in the deck itself or in a file that it reads.
pub fn fingerprint(model: &Model, output: &Output) -> u64 {
    of(&(model, output))
}

/// Fingerprint of a model alone.
pub fn model_fingerprint(model: &Model) -> u64 {
    of(model)
}

/// Fingerprints of the bodies, rigid surfaces, pairs, ties, springs and cavities of a model, by what they are called.
pub fn part_fingerprints(model: &Model) -> Vec<(String, u64)> {
    let bodies = model.bodies.iter();
    let bodies = bodies.map(|body| (format!("body `{}`", body.name), of(body)));
    let rigid = model.rigid_surfaces.iter();
    let rigid = rigid.map(|rigid| (format!("rigid surface `{}`", rigid.name), of(rigid)));
    let pairs = model.pairs.iter();
    let pairs = pairs.map(|pair| (format!("pair `{}`", pair.name), of(pair)));
    let ties = model.ties.iter();
    let ties = ties.map(|tie| (format!("tie `{}`", tie.name), of(tie)));
    let springs = model.springs.iter();
    let springs = springs.map(|spring| (format!("spring `{}`", spring.name), of(spring)));
    let cavities = model.cavities.iter();
    let cavities = cavities.map(|cavity| (format!("cavity `{}`", cavity.name), of(cavity)));
    let parts = bodies.chain(rigid).chain(pairs).chain(ties);
    parts.chain(springs).chain(cavities).collect()
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

fn of(part: &impl Serialize) -> u64 {
    let hash = Hash(crc32fast::Hasher::new());
    let hash = postcard::serialize_with_flavor(part, hash);
    u64::from(hash.expect("parts of a model are plain values"))
}

/// Takes bytes that are written for their checksum.
struct Hash(crc32fast::Hasher);

impl Flavor for Hash {
    type Output = u32;

    fn try_push(&mut self, byte: u8) -> postcard::Result<()> {
        self.try_extend(&[byte])
    }

    fn try_extend(&mut self, bytes: &[u8]) -> postcard::Result<()> {
        self.0.update(bytes);
        Ok(())
    }

    fn finalize(self) -> postcard::Result<u32> {
        Ok(self.0.finalize())
    }
}

impl Checkpoint {
    /// Writes the checkpoint to a folder.
    ///
    /// # Errors
    /// When the file cannot be written.
    pub fn write(&self, folder: &Path) -> Result<(), OutputError> {
        index::write_whole(folder, FILE, self)
    }

    /// Writes the checkpoint of a rank's share of a problem, in pieces; collective.
    ///
    /// # Errors
    /// When a file cannot be written on any rank; the checkpoint that was there stays.
    pub fn write_shared(self, folder: &Path, problem: &Problem) -> Result<(), OutputError> {
        index::write(folder, FILE, self, problem)
    }

    /// Writes it as that of the end of a completed run; collective.
    ///
    /// # Errors
    /// When a file cannot be written on any rank.
    pub fn write_end(self, folder: &Path, problem: &Problem) -> Result<(), OutputError> {
        index::write(folder, END, self, problem)
    }

    /// Reads the checkpoint of a folder, whole.
    ///
    /// # Errors
    /// When there is none, or none that can be used.
    pub fn read(folder: &Path) -> Result<Self, CheckpointError> {
        Index::read(folder)?.whole()
    }

    /// Reads the checkpoint of a folder, or that of the end of a completed run.
    ///
    /// # Errors
    /// When there is none, or none that can be used.
    pub fn read_last(folder: &Path) -> Result<Self, CheckpointError> {
        Index::read_last(folder)?.whole()
    }

    /// Takes the checkpoint out of a folder, if there is one.
    ///
    /// # Errors
    /// When the file is there and cannot be removed.
    pub fn remove(folder: &Path) -> Result<(), OutputError> {
        index::remove(folder)
    }

    /// Removes the checkpoint of ranks that share a problem; collective.
    ///
    /// # Errors
    /// If the file exists and cannot be removed.
    pub fn remove_shared(folder: &Path, share: &Share) -> Result<(), OutputError> {
        on_first(share, || index::remove(folder)).map(|_| ())
    }
}

impl Source {
    /// Checks that the run is of this model.
    ///
    /// # Errors
    /// If it began with another one.
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
    /// Checks that a model has the bodies, rigid surfaces, pairs, ties, springs and cavities of the run.
    ///
    /// # Errors
    /// Returns the first part that is missing or additional.
    pub fn check_parts(&self, model: &Model) -> Result<(), CheckpointError> {
        let found = part_fingerprints(model);
        let differs = |one: &[(String, u64)], other: &[(String, u64)]| {
            let mut parts = one.iter().filter(|part| !other.contains(part));
            parts.next().map(|(name, _)| name.clone())
        };
        let mut differs = differs(&self.parts, &found).or_else(|| differs(&found, &self.parts));
        if found != self.parts {
            differs = differs.or_else(|| {
                Some("the order of bodies, surfaces, pairs, ties, springs or cavities".into())
            });
        }
        differs.map_or(Ok(()), |part| Err(CheckpointError::Differs { part }))
    }

    /// Checks that a model begins with the steps that the run has completed, `done` of them.
    ///
    /// # Errors
    /// Returns the first step that differs.
    pub fn check_steps(&self, model: &Model, done: usize) -> Result<(), CheckpointError> {
        let found = step_fingerprints(model);
        let mut steps = self.steps.iter().enumerate().take(done);
        let differs = steps.find(|(at, step)| found.get(*at) != Some(step));
        differs.map_or(Ok(()), |(_, (name, _))| {
            Err(CheckpointError::StepDiffers { step: name.clone() })
        })
    }
}

/// A path as text, also where it is no UTF-8.
fn as_text<S: Serializer>(path: &Path, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(&path.to_string_lossy())
}
