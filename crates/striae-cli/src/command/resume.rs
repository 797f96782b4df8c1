//! `striae resume DIR`: goes on with a run that was stopped, to the same results.

use std::{io::Write, path::PathBuf};

use striae::Simulation;

use super::run::{Common, Reported, concluded, watched};
use crate::failure::Failure;

/// Go on with a run from its last checkpoint.
#[derive(clap::Args)]
pub struct Arguments {
    /// Folder of the run.
    folder: PathBuf,
    #[command(flatten)]
    common: Common,
    #[command(flatten)]
    report: Reported,
}

/// Goes on from the checkpoint in the folder and prints what came of it.
pub fn run(arguments: &Arguments, out: &mut dyn Write) -> Result<(), Failure> {
    arguments.common.start_threads()?;
    let simulation = Simulation::resume(&arguments.folder)?;
    let report = arguments.report.of(&arguments.folder);
    let finished = watched(simulation, arguments.common.verbosity(), report)?;
    let strictness = arguments.common.strictness();
    concluded(finished, &arguments.folder, strictness, out)
}
