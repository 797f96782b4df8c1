//! Environment of a case: runs decks and collects their results.

use std::{
    fs,
    path::{Path, PathBuf},
};

use striae_deck::{self as deck, Deck};
use striae_figure::Figure;
use striae_model::Enforcement;
use striae_output::{Existing, history::Table, summary::Summary};
use striae_solve::outcome::Ending;

use striae::{Finished, Simulation};

use crate::failure::Failure;

/// Part of a case that is run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Extent {
    /// Everything.
    Full,
    /// Without what takes long.
    Quick,
}

/// Runs the simulations of a case, with whatever progress it likes.
pub trait Runner {
    /// Runs a simulation of this title to its end.
    ///
    /// # Errors
    /// When output cannot be written.
    fn run(&self, title: &str, simulation: Simulation) -> Result<Finished, striae::Error>;
}

/// Runs without a word.
pub struct Silent;

impl Runner for Silent {
    fn run(&self, _: &str, simulation: Simulation) -> Result<Finished, striae::Error> {
        simulation.run()
    }
}

/// A case in progress.
pub struct Study<'a> {
    /// Name of the case.
    pub case: &'a str,
    /// Part that is run.
    pub extent: Extent,
    /// Enforcement of contact in every pair, where it is not that of the decks.
    pub enforcement: Option<Enforcement>,
    /// Folder of all output.
    pub folder: PathBuf,
    /// Runs the simulations.
    pub runner: &'a dyn Runner,
    /// Measured quantities.
    pub quantities: Vec<(String, f64)>,
    /// Quantities that are not measured in this extent.
    pub left_out: Vec<&'static str>,
    /// Summaries of the runs that are judged, by name of the deck.
    pub summaries: Vec<(String, Summary)>,
    /// Decks with collocated contact, whose forces on both sides are not in balance.
    pub collocated: Vec<String>,
    interrupted: bool,
}

/// A finished run with its history.
pub struct Run {
    /// Problem, last state and ending.
    pub finished: Finished,
    /// `history.csv`.
    pub history: Table,
}

impl<'a> Study<'a> {
    /// A case of which nothing is known yet.
    pub fn new(case: &'a str, extent: Extent, folder: PathBuf, runner: &'a dyn Runner) -> Self {
        Self {
            case,
            extent,
            enforcement: None,
            folder,
            runner,
            quantities: Vec::new(),
            left_out: Vec::new(),
            summaries: Vec::new(),
            collocated: Vec::new(),
            interrupted: false,
        }
    }

    /// Reads an embedded deck, and sets the enforcement of its pairs if one is requested.
    pub fn deck(&self, name: &str, text: &str) -> Result<Deck, Failure> {
        let file = format!("cases/{}/{name}.toml", self.case);
        let mut deck = deck::parse(text, &file, Path::new("")).map_err(striae::Error::from)?;
        if let Some(enforcement) = self.enforcement {
            let pairs = deck.model.pairs.iter_mut();
            pairs.for_each(|pair| pair.enforcement = enforcement);
        }
        Ok(deck)
    }

    /// Reads an embedded deck with passages replaced, each of which it holds once.
    pub fn variant(&self, name: &str, text: &str, passages: &[[&str; 2]]) -> Result<Deck, Failure> {
        let text = passages.iter().fold(text.to_owned(), |text, [old, new]| {
            assert_eq!(text.matches(old).count(), 1, "`{old}` in {name}");
            text.replace(old, new)
        });
        self.deck(name, &text)
    }

    /// Runs a deck to its end; how Newton's method did is judged.
    pub fn run(&mut self, name: &str, deck: Deck) -> Result<Run, Failure> {
        let mut pairs = deck.model.pairs.iter();
        if pairs.any(|pair| pair.enforcement == Enforcement::Collocated) {
            self.collocated.push(name.to_owned());
        }
        let run = self.run_unjudged(name, deck)?;
        let summary = run.finished.summary.clone();
        self.summaries.push((name.to_owned(), summary));
        Ok(run)
    }

    /// Runs a deck to its end with a method that is not the one to judge.
    pub fn run_unjudged(&mut self, name: &str, deck: Deck) -> Result<Run, Failure> {
        let run = self.run_to_limit(name, deck)?;
        match &run.finished.ending {
            Ending::Completed => Ok(run),
            ending => Err(Failure::Ended(Box::new(ending.clone()))),
        }
    }

    /// Runs a deck that may stop where equilibrium ends; the increments cut
    /// there are the measurement and not judged.
    pub fn run_to_limit(&mut self, name: &str, deck: Deck) -> Result<Run, Failure> {
        let folder = self.folder.join(name);
        let simulation = Simulation::of(deck)?
            .recorded(folder, name)
            .over(Existing::Replace);
        let title = format!("{}: {name}", self.case);
        let finished = self.runner.run(&title, simulation)?;
        if let Ending::Interrupted { .. } = finished.ending {
            self.interrupted = true;
            return Err(Failure::Ended(Box::new(finished.ending)));
        }
        Ok(Run {
            history: finished.history.clone(),
            finished,
        })
    }

    /// Returns whether a run was stopped from outside.
    pub fn was_interrupted(&self) -> bool {
        self.interrupted
    }

    /// Notes a measured quantity.
    pub fn measured(&mut self, name: impl Into<String>, value: f64) {
        self.quantities.push((name.into(), value));
    }

    /// Makes the folder of the case.
    pub fn make_folder(&self) -> Result<(), Failure> {
        let path = self.folder.clone();
        fs::create_dir_all(&path).map_err(|cause| Failure::Unwritable { path, cause })
    }

    /// Writes a text into the folder of the case.
    pub fn write(&self, name: &str, text: &str) -> Result<(), Failure> {
        let path = self.folder.join(name);
        fs::write(&path, text).map_err(|cause| Failure::Unwritable { path, cause })
    }

    /// Writes a figure.
    pub fn draw(&self, figure: &Figure, name: &str) -> Result<(), Failure> {
        Ok(figure.write(&self.folder, name)?)
    }
}

impl Run {
    /// A column of the history, empty if there is none of this name.
    pub fn column(&self, name: &str) -> Vec<f64> {
        self.history.column(name).unwrap_or_default()
    }

    /// A quantity at the end of a step, counted from 1; NaN if it is not known.
    pub fn at_end_of(&self, step: usize, name: &str) -> f64 {
        let steps = self.column("step");
        let row = steps.iter().rposition(|&known| known == step as f64);
        row.and_then(|row| self.column(name).get(row).copied())
            .unwrap_or(f64::NAN)
    }

    /// Largest absolute value in a column, NaN if it is empty.
    pub fn largest(&self, name: &str) -> f64 {
        let sizes = self.column(name).into_iter().map(f64::abs);
        sizes.reduce(f64::max).unwrap_or(f64::NAN)
    }
}
