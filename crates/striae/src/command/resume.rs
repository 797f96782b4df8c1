//! `striae resume DIR`: goes on with a run that was stopped, to the same results.

use std::{io::Write, path::PathBuf};

use striae_deck as deck;
use striae_output::checkpoint::Checkpoint;

use super::run::{Common, concluded};
use crate::{
    failure::Failure,
    simulation::{Interrupt, go_on},
};

/// Go on with a run from its last checkpoint.
#[derive(clap::Args)]
pub struct Arguments {
    /// Folder of the run.
    folder: PathBuf,
    #[command(flatten)]
    common: Common,
}

/// Goes on from the checkpoint in the folder and prints what came of it.
pub fn run(arguments: &Arguments, out: &mut dyn Write) -> Result<(), Failure> {
    arguments.common.start_threads()?;
    let checkpoint = Checkpoint::read(&arguments.folder)?;
    let deck = deck::read(&checkpoint.source.path)?;
    checkpoint.source.check(&deck.model, deck.output)?;
    let verbosity = arguments.common.verbosity();
    let interrupt = Interrupt::listen();
    let simulation = go_on(deck, checkpoint, &arguments.folder, verbosity, &interrupt)?;
    let strictness = arguments.common.strictness();
    concluded(simulation, &arguments.folder, strictness, out)
}
