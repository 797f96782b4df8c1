//! Files of checkpoints: an index, and the pieces that it names.

use std::{
    fs,
    io::ErrorKind,
    path::{Path, PathBuf},
};

use serde::{Serialize, de::DeserializeOwned};
use striae_files::{FileError, write_atomically};
use striae_solve::problem::Problem;

use super::{
    Checkpoint, CheckpointError, END, FILE, FORMAT, Source, Written,
    pieces::{Entries, Piece, is_piece_of, piece_file, set_of},
};
use crate::{
    Checksums, OutputError,
    ranks::{agreed, from_first, on_first, told},
    removal::remove_where,
};

/// First bytes of a file.
const MAGIC: &[u8] = b"striae checkpoint\n";

/// A checkpoint whose pieces have not been read.
#[derive(Clone, Debug)]
pub struct Index {
    path: PathBuf,
    /// Files of the pieces; none where the run was on one rank.
    pieces: Checksums,
    /// But for what is in pieces.
    checkpoint: Checkpoint,
}

impl Index {
    /// Reads the index of the checkpoint of a folder.
    ///
    /// # Errors
    /// When there is none, or none that can be used.
    pub fn read(folder: &Path) -> Result<Self, CheckpointError> {
        let path = folder.join(FILE);
        match fs::read(&path) {
            Ok(bytes) => Self::taken(path, &bytes),
            Err(cause) if cause.kind() == ErrorKind::NotFound => {
                let has = |name: &str| folder.join(name).exists();
                let folder = folder.to_owned();
                Err(match has(END) {
                    true => CheckpointError::Completed { folder },
                    false if !folder.exists() => CheckpointError::NoFolder { folder },
                    // A run begins with a folder of fields, and has a summary at its end.
                    false if has("fields") && !has("summary.json") => {
                        CheckpointError::TooEarly { folder }
                    }
                    false => CheckpointError::Missing { folder },
                })
            }
            Err(cause) => Err(CheckpointError::Unreadable { path, cause }),
        }
    }

    /// Index of the checkpoint of a folder, or of the end of a completed run.
    ///
    /// # Errors
    /// If there is none, or none that can be used.
    pub fn read_last(folder: &Path) -> Result<Self, CheckpointError> {
        let end = folder.join(END);
        match (Self::read(folder), fs::read(&end)) {
            (Err(CheckpointError::Completed { .. }), Ok(bytes)) => Self::taken(end, &bytes),
            (read, _) => read,
        }
    }

    fn taken(path: PathBuf, bytes: &[u8]) -> Result<Self, CheckpointError> {
        let (pieces, checkpoint) = taken(&path, bytes)?;
        Ok(Self {
            path,
            pieces,
            checkpoint,
        })
    }

    /// The deck of the run.
    pub fn source(&self) -> &Source {
        &self.checkpoint.source
    }

    /// Files that were on disk.
    pub fn written(&self) -> &Written {
        &self.checkpoint.written
    }

    /// The step in progress, and the completed fraction of it.
    pub fn reached(&self) -> (usize, f64) {
        let point = &self.checkpoint.point;
        (point.step, point.fraction)
    }

    /// On how many ranks it was written.
    pub fn ranks(&self) -> usize {
        self.pieces.len().max(1)
    }

    /// The checkpoint of the whole problem.
    ///
    /// # Errors
    /// When a piece is missing or damaged.
    pub fn whole(self) -> Result<Checkpoint, CheckpointError> {
        if self.pieces.is_empty() {
            return Ok(self.checkpoint);
        }
        self.joined(|_| true, |_, _| true)
    }

    /// Part of the checkpoint that a rank holds, in local numbers, for any number of ranks that
    /// wrote it; collective.
    ///
    /// # Errors
    /// If a piece is missing or damaged, or belongs to another problem.
    pub fn held(self, problem: &Problem) -> Result<Checkpoint, CheckpointError> {
        let share = &problem.share;
        let Some(holding) = share.holding() else {
            return agreed(share, self.whole());
        };
        let path = self.path.clone();
        let node = |node: u32| holding.nodes.binary_search(&(node as usize)).is_ok();
        let element = |body: usize, element: u32| {
            let known = holding.elements.get(body);
            known.is_some_and(|known| {
                let id = striae_mesh::ElementId(element);
                known.binary_search(&id).is_ok()
            })
        };
        let held = match self.pieces.is_empty() {
            false => self.joined(node, element),
            true => {
                let entries = Entries::of_whole(&self.checkpoint.point, problem);
                entries.map(|mut entries| {
                    let mut checkpoint = self.checkpoint;
                    entries.keep(node, element);
                    entries.put(&mut checkpoint.point);
                    checkpoint
                })
            }
            .ok_or_else(|| CheckpointError::Damaged { path: path.clone() }),
        };
        let fits = |checkpoint: &Checkpoint| {
            let states = [&checkpoint.point.start, &checkpoint.point.state];
            states.iter().all(|state| {
                state.positions.len() == holding.nodes.len() && state.remembers_as(problem)
            })
        };
        agreed(
            share,
            held.and_then(|held| match fits(&held) {
                true => Ok(held),
                false => Err(CheckpointError::Damaged { path }),
            }),
        )
    }

    /// Values that the pieces hold of some nodes and elements, one piece after the other.
    fn joined(
        self,
        node: impl Fn(u32) -> bool,
        element: impl Fn(usize, u32) -> bool,
    ) -> Result<Checkpoint, CheckpointError> {
        let mut checkpoint = self.checkpoint;
        let mut all = Entries::default();
        for (name, sum) in &self.pieces {
            let path = self.path.with_file_name(name);
            let bytes = fs::read(&path).map_err(|cause| CheckpointError::Unreadable {
                path: path.clone(),
                cause,
            })?;
            if [bytes.len() as u64, checksum(&bytes)] != *sum {
                return Err(CheckpointError::Damaged { path });
            }
            let Piece { mut entries } = taken(&path, &bytes)?;
            entries.keep(&node, &element);
            all.append(entries);
        }
        all.put(&mut checkpoint.point);
        Ok(checkpoint)
    }
}

/// Writes a checkpoint of a run on one rank.
pub(super) fn write_whole(
    folder: &Path,
    name: &str,
    checkpoint: &Checkpoint,
) -> Result<(), OutputError> {
    let none = Checksums::new();
    write_atomically(&folder.join(name), &bytes(&(&none, checkpoint)))?;
    clear(folder, name, &none);
    Ok(())
}

/// Writes a checkpoint; collective.
pub(super) fn write(
    folder: &Path,
    name: &str,
    mut checkpoint: Checkpoint,
    problem: &Problem,
) -> Result<(), OutputError> {
    let share = &problem.share;
    if share.is_alone() {
        return write_whole(folder, name, &checkpoint);
    }
    let set = from_first(share, || next_set(folder, name))?;
    let piece = Piece {
        entries: Entries::taken(&mut checkpoint.point, problem),
    };
    let file = piece_file(name, set, share.team().rank());
    let written = write_piece(folder, &file, &piece);
    let all = agreed(share, written).map(|own| told(share, &own));
    let written = all.and_then(|pieces| {
        let content = bytes(&(&pieces, &checkpoint));
        let written = on_first(share, || {
            write_atomically(&folder.join(name), &content).map_err(OutputError::from)
        });
        written.map(|_| pieces)
    });
    match written {
        Ok(pieces) => {
            on_first(share, || {
                clear(folder, name, &pieces);
                Ok::<_, OutputError>(())
            })?;
            Ok(())
        }
        Err(error) => {
            // Nothing names it.
            let _ = fs::remove_file(folder.join(file));
            Err(error)
        }
    }
}

/// Removes the checkpoint of a folder with its pieces.
pub(super) fn remove(folder: &Path) -> Result<(), OutputError> {
    let path = folder.join(FILE);
    match fs::remove_file(&path) {
        Err(cause) if cause.kind() != ErrorKind::NotFound => {
            Err(FileError::Write { path, cause }.into())
        }
        _ => {
            clear(folder, FILE, &Checksums::new());
            Ok(())
        }
    }
}

fn write_piece(
    folder: &Path,
    file: &str,
    piece: &Piece,
) -> Result<(String, [u64; 2]), OutputError> {
    let bytes = bytes(piece);
    write_atomically(&folder.join(file), &bytes)?;
    let sum = [bytes.len() as u64, checksum(&bytes)];
    Ok((file.to_owned(), sum))
}

/// A number that no set of pieces in the folder has.
fn next_set(folder: &Path, name: &str) -> Result<u64, OutputError> {
    let refused = |cause| FileError::Read {
        path: folder.to_owned(),
        cause,
    };
    let mut next = 1;
    for entry in fs::read_dir(folder).map_err(refused)? {
        let file = entry.map_err(refused)?.file_name();
        let set = set_of(name, &file.to_string_lossy());
        next = next.max(set.map_or(0, |set| set + 1));
    }
    Ok(next)
}

/// Removes pieces that no index names. What stays does no harm and goes the next time.
fn clear(folder: &Path, name: &str, kept: &Checksums) {
    let goes = |file: &str| {
        let is_kept = kept.iter().any(|(kept, _)| kept == file);
        is_piece_of(name, file) && !is_kept
    };
    let _ = remove_where(folder, goes);
}

fn checksum(bytes: &[u8]) -> u64 {
    u64::from(crc32fast::hash(bytes))
}

/// Content of a file.
fn bytes(content: &impl Serialize) -> Vec<u8> {
    let content = postcard::to_allocvec(&(env!("CARGO_PKG_VERSION"), content));
    let content = content.expect("checkpoints are plain values");
    let sum = checksum(&content);
    let head = [MAGIC, &FORMAT.to_le_bytes(), &sum.to_le_bytes()];
    [&head.concat(), content.as_slice()].concat()
}

fn taken<T: DeserializeOwned>(path: &Path, bytes: &[u8]) -> Result<T, CheckpointError> {
    let path = || path.to_owned();
    let rest = bytes
        .strip_prefix(MAGIC)
        .ok_or_else(|| CheckpointError::Foreign { path: path() })?;
    let damaged = || CheckpointError::Damaged { path: path() };
    let (found, rest) = number(rest).ok_or_else(damaged)?;
    if found != FORMAT {
        return Err(CheckpointError::Format {
            path: path(),
            found,
        });
    }
    let (sum, content) = number(rest).ok_or_else(damaged)?;
    if sum != checksum(content) {
        return Err(damaged());
    }
    let found = postcard::take_from_bytes::<String>(content);
    let (found, content) = found.map_err(|_| damaged())?;
    if found != env!("CARGO_PKG_VERSION") {
        return Err(CheckpointError::Version {
            path: path(),
            found,
        });
    }
    match postcard::take_from_bytes(content) {
        Ok((taken, [])) => Ok(taken),
        _ => Err(damaged()),
    }
}

/// The number at the front, and what follows it.
fn number(bytes: &[u8]) -> Option<(u64, &[u8])> {
    let (number, rest) = bytes.split_first_chunk()?;
    Some((u64::from_le_bytes(*number), rest))
}
