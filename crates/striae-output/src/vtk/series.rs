//! A run as a series in time: a `.pvd` collection of `.vtu` files.
//!
//! The collection is rewritten whole after every increment, by way of a
//! temporary file and a rename, so an interrupted run leaves a valid series of
//! everything it accepted.

use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};

use super::xml::escaped;
use crate::OutputError;
use striae_files::write_atomically;

/// A growing `.pvd` collection.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    path: PathBuf,
    snapshots: Vec<Snapshot>,
}

/// The files of one time.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Snapshot {
    /// Time of the state.
    pub time: f64,
    /// Name of each part (a body, a surface) and its file, relative to the
    /// collection. The same parts in the same order at every time.
    pub parts: Vec<(String, PathBuf)>,
}

impl Series {
    /// A series without snapshots; nothing is written yet.
    pub fn new(path: impl Into<PathBuf>) -> Self {
        Self::resumed(path, Vec::new())
    }

    /// A series that continues earlier snapshots, as after a restart.
    pub fn resumed(path: impl Into<PathBuf>, snapshots: Vec<Snapshot>) -> Self {
        Self {
            path: path.into(),
            snapshots,
        }
    }

    /// The snapshots so far.
    pub fn snapshots(&self) -> &[Snapshot] {
        &self.snapshots
    }

    /// Adds the files of one time and rewrites the collection.
    pub fn append(&mut self, snapshot: Snapshot) -> Result<(), OutputError> {
        self.snapshots.push(snapshot);
        write_atomically(&self.path, self.collection().as_bytes())?;
        Ok(())
    }

    fn collection(&self) -> String {
        let files: String = self.snapshots.iter().map(entries).collect();
        format!(
            r#"<?xml version="1.0"?>
<VTKFile type="Collection" version="1.0" byte_order="LittleEndian">
  <Collection>
{files}  </Collection>
</VTKFile>
"#
        )
    }
}

fn entries(snapshot: &Snapshot) -> String {
    let parts = snapshot.parts.iter().enumerate();
    parts
        .map(|(part, (name, file))| {
            format!(
                "    <DataSet timestep=\"{time:?}\" part=\"{part}\" name=\"{name}\" file=\"{file}\"/>\n",
                time = snapshot.time,
                name = escaped(name),
                file = escaped(&with_slashes(file)),
            )
        })
        .collect()
}

fn with_slashes(file: &Path) -> String {
    file.to_string_lossy().replace('\\', "/")
}
