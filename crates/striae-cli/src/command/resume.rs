//! `striae resume DIR`: continues a run that was stopped, to equal results, or with other steps.

use std::{
    io::Write,
    path::{Path, PathBuf},
    sync::Arc,
};

use striae::{Ranks, Simulation, case_name};
use striae_deck::Setting;
use striae_output::Existing;

use super::run::{Common, Reported, finish};
use crate::{
    failure::Failure,
    ranks::{Crew, Options},
};

/// Continue a run from its last checkpoint, unchanged or with other steps.
#[derive(clap::Args)]
pub struct Arguments {
    /// Folder of the run.
    folder: PathBuf,
    /// A deck with the same bodies and pairs, which begins with the completed steps.
    #[arg(long, value_name = "DECK")]
    with: Option<PathBuf>,
    /// Set a number of that deck, as for `run`; may be repeated.
    #[arg(long, value_name = "NAME=VALUE", requires = "with")]
    set: Vec<Setting>,
    /// Folder for the output of the other steps; by default results/NAME of that deck.
    #[arg(short, long, alias = "output", requires = "with")]
    out: Option<PathBuf>,
    /// Remove the results of an earlier run from that folder first.
    #[arg(long, requires = "with")]
    overwrite: bool,
    #[command(flatten)]
    common: Common,
    #[command(flatten)]
    report: Reported,
    #[command(flatten)]
    ranks: Options,
}

/// Continues from the checkpoint in the folder and prints the result.
pub fn run(arguments: &Arguments, out: &mut dyn Write) -> Result<(), Failure> {
    let crew = Crew::start(&arguments.ranks)?;
    let result = resume_on(arguments, &crew, out);
    crew.ended(result)
}

fn resume_on(arguments: &Arguments, crew: &Crew, out: &mut dyn Write) -> Result<(), Failure> {
    arguments.common.start_threads(crew.voices())?;
    let own = || arguments.folder.clone();
    let (simulation, folder) = match (&arguments.with, crew.ranks()) {
        (None, None) => (Simulation::resume(&arguments.folder)?, own()),
        (None, Some(ranks)) => (Simulation::resume_on(ranks, &arguments.folder)?, own()),
        (Some(deck), ranks) => branched(arguments, deck, ranks)?,
    };
    let report = arguments.report.of(&folder);
    let common = (&arguments.common, crew.voice());
    finish(simulation, &folder, common, report, out)
}

/// The run with other steps, and its folder.
fn branched(
    arguments: &Arguments,
    deck: &Path,
    ranks: Option<Arc<dyn Ranks>>,
) -> Result<(Simulation, PathBuf), Failure> {
    let own = || Path::new("results").join(case_name(deck));
    let folder = arguments.out.clone().unwrap_or_else(own);
    let existing = match arguments.overwrite {
        true => Existing::Replace,
        false => Existing::Keep,
    };
    let (old, set) = (&arguments.folder, &arguments.set);
    let simulation = match ranks {
        None => Simulation::resume_with_set(old, deck, set, &folder)?,
        Some(ranks) => Simulation::resume_with_on(ranks, old, deck, set, &folder)?,
    };
    Ok((simulation.over(existing), folder))
}
