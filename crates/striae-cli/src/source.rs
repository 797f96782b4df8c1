//! The deck of a command, with the numbers that are set for it.

use std::path::PathBuf;

use striae_deck::{Deck, Faults, Setting, read_with};

/// A deck and settings of its numbers.
#[derive(clap::Args)]
pub struct Source {
    /// The deck.
    pub deck: PathBuf,
    #[command(flatten)]
    pub settings: Settings,
}

/// Settings of parameters and other numbers.
#[derive(clap::Args)]
pub struct Settings {
    /// Set a parameter of the deck, such as `E=2e6`, or another number by its path, such as
    /// `material.rubber.youngs_modulus=2e6`; may be repeated, of one
    /// name the last counts.
    #[arg(long = "set", value_name = "NAME=VALUE")]
    pub set: Vec<Setting>,
}

impl Source {
    /// Reads the deck.
    pub fn read(&self) -> Result<Deck, Faults> {
        read_with(&self.deck, &self.settings.set)
    }
}

#[cfg(test)]
impl From<PathBuf> for Source {
    fn from(deck: PathBuf) -> Self {
        let settings = Settings { set: Vec::new() };
        Self { deck, settings }
    }
}
