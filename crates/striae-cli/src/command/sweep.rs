//! `striae sweep DECK --vary mu=0.1,0.2`: runs of a deck with several values of its numbers.
//!
//! Every combination is run in a folder named by its values, in a separate process of this program.
//! Results are tabulated in the terminal and in `sweep.csv`, which is rewritten whenever a run has
//! ended.

mod members;
mod runs;
mod table;

use std::{
    fmt::Write as _,
    io::Write,
    path::{Path, PathBuf},
    process::Command,
};

use striae::case_name;
use striae_deck::read_with;
use striae_files::write_atomically;
use striae_output::{OutputError, is_occupied};

use self::{
    members::{Member, Variation, members},
    runs::Outcome,
    table::Table,
};
use super::law::make_folder;
use crate::{failure::Failure, interrupt::listen, source::Source};

/// The table, in the folder of a sweep.
const TABLE: &str = "sweep.csv";

/// Run a deck with several values of its numbers, and tabulate the results.
#[derive(clap::Args)]
pub struct Arguments {
    #[command(flatten)]
    source: Source,
    /// A parameter, or another number by its path, and its values; if repeated, all
    /// combinations are run.
    #[arg(long, value_name = "NAME=V1,V2,..", required = true)]
    vary: Vec<Variation>,
    /// Number of simultaneous runs, each on one thread.
    #[arg(long, default_value_t = std::num::NonZeroUsize::MIN)]
    workers: std::num::NonZeroUsize,
    /// Folder for the table and the runs; by default results/NAME-sweep.
    #[arg(short, long, alias = "output")]
    out: Option<PathBuf>,
    /// Remove the results of earlier runs from their folders first.
    #[arg(long)]
    overwrite: bool,
}

/// Runs all combinations and prints the table.
pub fn run(arguments: &Arguments, out: &mut dyn Write) -> Result<(), Failure> {
    let deck = &arguments.source.deck;
    let own = || Path::new("results").join(format!("{}-sweep", case_name(deck)));
    let folder = arguments.out.clone().unwrap_or_else(own);
    let fixed = &arguments.source.settings.set;
    let members = members(&arguments.vary, fixed, &folder).map_err(Failure::Variation)?;
    if !arguments.overwrite {
        refuse_results(&folder, &members)?;
    }
    writeln!(std::io::stderr(), "runs: {}", members.len())?;
    // A faulty deck is told once, before anything is run.
    for member in &members {
        read_with(deck, &member.settings())?;
    }
    make_folder(&folder)?;
    let file = folder.join(TABLE);
    let written = |outcomes: &[Outcome]| {
        let table = Table::of(&members, outcomes);
        let text = table.csv();
        write_atomically(&file, text.as_bytes()).map(|()| table)
    };
    let start = |member: &Member| started(member, arguments);
    let outcomes = runs::all(
        &members,
        arguments.workers.get(),
        &listen(),
        &start,
        &|at, outcomes| {
            tell(&members[at], &outcomes[at], outcomes);
            // It is written again at the end, where a failure counts.
            let _ = written(outcomes);
        },
    );
    let table = written(&outcomes).map_err(|error| Failure::Results(error.into()))?;
    write!(out, "{}", table.text())?;
    writeln!(out, "wrote {}", file.display())?;
    concluded(&members, &outcomes)
}

/// Refuses a folder with the table or with runs of an earlier sweep.
fn refuse_results(folder: &Path, members: &[Member]) -> Result<(), OutputError> {
    let mut runs = members.iter().map(|member| &member.folder);
    match runs.find(|run| is_occupied(run)) {
        Some(run) => Err(OutputError::Occupied(run.clone())),
        None if folder.join(TABLE).exists() => Err(OutputError::Occupied(folder.to_owned())),
        None => Ok(()),
    }
}

/// The run of a member, by this program.
fn started(member: &Member, arguments: &Arguments) -> Result<Command, String> {
    let program = std::env::current_exe().map_err(|cause| cause.to_string())?;
    let mut command = Command::new(program);
    command.arg("run").arg(&arguments.source.deck);
    command.arg("--out").arg(&member.folder);
    command.args(["--quiet", "--threads", "1"]);
    for setting in member.settings() {
        command.arg("--set").arg(setting.to_string());
    }
    if arguments.overwrite {
        command.arg("--overwrite");
    }
    Ok(command)
}

/// Says that a run has ended.
fn tell(member: &Member, outcome: &Outcome, outcomes: &[Outcome]) {
    let ended = outcomes.iter();
    let ended = ended.filter(|one| !matches!(one, Outcome::Waiting)).count();
    let all = outcomes.len();
    let how = match outcome {
        Outcome::Waiting => return,
        Outcome::Done => "completed",
        Outcome::Failed { .. } if outcome.is_interrupted() => "interrupted",
        Outcome::Failed { .. } => "failed",
    };
    let line = format!("{ended} of {all}: {} {how}", member.name());
    let _ = writeln!(std::io::stderr(), "{line}");
}

/// Success where all runs have completed.
fn concluded(members: &[Member], outcomes: &[Outcome]) -> Result<(), Failure> {
    let all = outcomes.len();
    let waiting = outcomes.iter();
    let waiting = waiting.filter(|one| matches!(one, Outcome::Waiting));
    let waiting = waiting.count();
    let mut failed = 0;
    let mut lines = String::new();
    for (member, outcome) in members.iter().zip(outcomes) {
        if let Outcome::Failed { reason, .. } = outcome {
            failed += 1;
            let _ = write!(lines, "\n  {}: {reason}", member.name());
        }
    }
    match (waiting, failed) {
        (0, 0) => Ok(()),
        (0, _) if !outcomes.iter().any(Outcome::is_interrupted) => Err(Failure::Sweep(format!(
            "{failed} of {all} runs failed:{lines}"
        ))),
        _ => {
            let done = all - waiting - failed;
            Err(Failure::Halted(format!(
                "interrupted with {done} of {all} runs completed; their results are kept{lines}"
            )))
        }
    }
}
