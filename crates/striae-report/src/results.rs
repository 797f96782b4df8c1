//! Content of a results folder except for the fields.

use std::path::{Path, PathBuf};

use striae_files::{FileError, read_text};
use striae_output::{
    history::Table,
    summary::Summary,
    vtk::{Snapshot, read_series},
};

use crate::ReportError;

/// A results folder. A run in progress has no summary, and may have no history yet.
pub struct Results {
    /// The folder.
    pub folder: PathBuf,
    /// Summary of the run.
    pub summary: Option<Summary>,
    /// A row an increment.
    pub history: Table,
    /// Text of the deck.
    pub deck: Option<String>,
    /// Figures of friction laws: a name and an SVG.
    pub laws: Vec<(String, String)>,
    /// Files over time.
    pub series: Vec<(Kind, Vec<Snapshot>)>,
}

/// Subject of a collection.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Kind {
    /// Deformable bodies.
    Body,
    /// Sides of pairs.
    Contact,
    /// Rigid surfaces.
    Rigid,
}

impl Results {
    /// Reads a folder.
    ///
    /// # Errors
    /// When there is nothing to report, or a file is damaged.
    pub fn read(folder: &Path) -> Result<Self, ReportError> {
        let there = |name: &str| Some(folder.join(name)).filter(|path| path.exists());
        let mut series = Vec::new();
        for (kind, name) in [
            (Kind::Body, "bodies.pvd"),
            (Kind::Contact, "contact.pvd"),
            (Kind::Rigid, "rigid.pvd"),
        ] {
            if let Some(path) = there(name) {
                series.push((kind, read_series(&path)?));
            }
        }
        let history = there("history.csv");
        if history.is_none() && series.is_empty() {
            return Err(ReportError::Nothing(folder.to_owned()));
        }
        Ok(Self {
            folder: folder.to_owned(),
            summary: there("summary.json")
                .map(|path| Summary::read(&path))
                .transpose()?,
            history: history
                .map(|path| Table::read(&path))
                .transpose()?
                .unwrap_or_default(),
            deck: there("deck.toml")
                .map(|path| read_text(&path))
                .transpose()?,
            laws: laws(folder)?,
            series,
        })
    }

    /// Title of the deck, or name of the case, or of the folder.
    pub fn title(&self) -> String {
        let titled = self
            .parsed()
            .and_then(|deck| Some(deck.get("title")?.as_str()?.to_owned()));
        let case = || self.summary.as_ref().map(|summary| summary.case.clone());
        let folder = || {
            let full = std::path::absolute(&self.folder).unwrap_or_else(|_| self.folder.clone());
            full.file_name()
                .unwrap_or_default()
                .to_string_lossy()
                .into_owned()
        };
        titled.or_else(case).unwrap_or_else(folder)
    }

    /// Names of the steps, as far as the deck is there.
    pub fn steps(&self) -> Vec<String> {
        let deck = self.parsed();
        let steps = deck.as_ref().and_then(|deck| deck.get("step")?.as_array());
        let name = |step: &toml::Value| Some(step.get("name")?.as_str()?.to_owned());
        let names = steps
            .into_iter()
            .flatten()
            .map(|step| name(step).unwrap_or_default());
        names.collect()
    }

    fn parsed(&self) -> Option<toml::Table> {
        self.deck.as_ref()?.parse().ok()
    }

    /// All times at which there are fields, in order.
    pub fn times(&self) -> Vec<f64> {
        let snapshots = self.series.iter().flat_map(|(_, series)| series);
        let mut times: Vec<f64> = snapshots.map(|snapshot| snapshot.time).collect();
        times.sort_by(f64::total_cmp);
        times.dedup();
        times
    }
}

/// Figures `law-NAME.svg` by name.
fn laws(folder: &Path) -> Result<Vec<(String, String)>, ReportError> {
    let unreadable = |cause| FileError::Read {
        path: folder.to_owned(),
        cause,
    };
    let mut laws = Vec::new();
    for entry in std::fs::read_dir(folder).map_err(unreadable)? {
        let path = entry.map_err(unreadable)?.path();
        let file = path
            .file_name()
            .unwrap_or_default()
            .to_string_lossy()
            .into_owned();
        let name = file
            .strip_prefix("law-")
            .and_then(|name| name.strip_suffix(".svg"));
        if let Some(name) = name {
            laws.push((name.to_owned(), read_text(&path)?));
        }
    }
    laws.sort();
    Ok(laws)
}
