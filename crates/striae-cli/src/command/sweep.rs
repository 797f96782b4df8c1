//! `striae sweep DECK --vary mu=0.1,0.2`: runs of a deck with several values of its parameters.
//!
//! Every combination is a run of its own in a folder named by its values, by this program in a
//! process of its own. What came of them is a table, in the terminal and as `sweep.csv`.

mod table;

use std::{
    io::Write,
    path::{Path, PathBuf},
    process::{Command, Stdio},
    str::FromStr,
    sync::Mutex,
    thread,
};

use striae::case_name;
use striae_deck::{Setting, read_with};

use super::law::make_folder;
use crate::{failure::Failure, source::Source};

/// Run a deck with several values of its parameters, and make a table of the results.
#[derive(clap::Args)]
pub struct Arguments {
    #[command(flatten)]
    source: Source,
    /// A parameter and its values; given again, all combinations are run.
    #[arg(long, value_name = "NAME=V1,V2,..", required = true)]
    vary: Vec<Variation>,
    /// Runs at a time, each on one thread.
    #[arg(long, default_value_t = std::num::NonZeroUsize::MIN)]
    workers: std::num::NonZeroUsize,
    /// Folder for the table and the runs; by default results/NAME-sweep.
    #[arg(long)]
    out: Option<PathBuf>,
    /// Remove the results of earlier runs from their folders first.
    #[arg(long)]
    overwrite: bool,
}

/// A parameter and its values.
#[derive(Clone, Debug)]
struct Variation {
    settings: Vec<Setting>,
}

impl FromStr for Variation {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let Some((name, values)) = text.split_once('=') else {
            return Err(format!(
                "expected NAME=V1,V2,.., such as `mu=0.1,0.2`, found `{text}`"
            ));
        };
        let values = values
            .split(',')
            .map(|value| format!("{name}={value}").parse());
        let settings: Vec<Setting> = values.collect::<Result<_, String>>()?;
        Ok(Self { settings })
    }
}

/// One run of the sweep.
struct Member {
    settings: Vec<Setting>,
    folder: PathBuf,
}

/// Runs all combinations and prints the table.
pub fn run(arguments: &Arguments, out: &mut dyn Write) -> Result<(), Failure> {
    let deck = &arguments.source.deck;
    let own = || Path::new("results").join(format!("{}-sweep", case_name(deck)));
    let folder = arguments.out.clone().unwrap_or_else(own);
    let members = members(arguments, &folder);
    // A faulty deck is told once, before anything is run.
    for member in &members {
        read_with(deck, &member.settings)?;
    }
    make_folder(&folder)?;
    let waiting = Mutex::new(members.iter().collect::<Vec<_>>());
    let next = || {
        let mut waiting = waiting.lock().expect("no worker panics");
        (!waiting.is_empty()).then(|| waiting.remove(0))
    };
    let failed = Mutex::new(Vec::new());
    thread::scope(|scope| {
        for _ in 0..arguments.workers.get().min(members.len()) {
            scope.spawn(|| {
                while let Some(member) = next() {
                    if let Err(words) = of(member, arguments) {
                        let mut failed = failed.lock().expect("no worker panics");
                        failed.push(format!("{}: {words}", member.folder.display()));
                    }
                }
            });
        }
    });
    let results = members
        .iter()
        .map(|member| (&member.settings[..], &*member.folder));
    let table = table::Table::of(results);
    write!(out, "{}", table.text())?;
    let file = folder.join("sweep.csv");
    let written = std::fs::write(&file, table.csv());
    written.map_err(|cause| Failure::Unwritable {
        path: file.clone(),
        cause,
    })?;
    writeln!(out, "wrote {}", file.display())?;
    let failed = failed.into_inner().expect("no worker panics");
    match failed.is_empty() {
        true => Ok(()),
        false => Err(Failure::Sweep(failed.join("\n"))),
    }
}

/// All combinations, the last parameter changing fastest.
fn members(arguments: &Arguments, folder: &Path) -> Vec<Member> {
    let mut all: Vec<Vec<Setting>> = vec![Vec::new()];
    for variation in &arguments.vary {
        let longer = all.iter().flat_map(|begun| {
            let settings = variation.settings.iter();
            settings.map(|setting| [&begun[..], std::slice::from_ref(setting)].concat())
        });
        all = longer.collect();
    }
    let member = |varied: Vec<Setting>| {
        let names: Vec<String> = varied.iter().map(Setting::to_string).collect();
        let fixed = arguments.source.settings.set.iter().cloned();
        Member {
            folder: folder.join(names.join(",")),
            settings: varied.into_iter().chain(fixed).collect(),
        }
    };
    all.into_iter().map(member).collect()
}

/// Runs one member in a process of its own; on failure what that said last.
fn of(member: &Member, arguments: &Arguments) -> Result<(), String> {
    let program = std::env::current_exe().map_err(|cause| cause.to_string())?;
    let mut command = Command::new(program);
    command.arg("run").arg(&arguments.source.deck);
    command.arg("--out").arg(&member.folder);
    command.args(["--quiet", "--threads", "1"]);
    for setting in &member.settings {
        command.arg("--set").arg(setting.to_string());
    }
    if arguments.overwrite {
        command.arg("--overwrite");
    }
    let ended = command.stdin(Stdio::null()).output();
    let ended = ended.map_err(|cause| cause.to_string())?;
    if ended.status.success() {
        return Ok(());
    }
    let said = String::from_utf8_lossy(&ended.stderr);
    Err(said
        .lines()
        .last()
        .unwrap_or("it ended without a word")
        .to_owned())
}
