//! `cargo xtask suite`: problems that other programs publish, without a setting of the solver.
//!
//! ```text
//! cargo xtask suite [--binary PATH] [--keep FOLDER] [--jobs N] [--only NAME,...] [--results]
//! ```
//!
//! `cases/foreign/suite.toml` names the decks beside it, their sources, and the [`problem`]s'
//! published values with [`formula`]s for those of the program. The program [`run`]s each deck as
//! a child process; what its tables say is held against the published values, and the [`page`]
//! `docs/book/reference/suite.md` is written. With `--only` some problems are run and printed, and
//! no page is written. With `--results` runs that are in the folder are read, not repeated.
//!
//! A problem that the program stops at or gets wrong stays in the suite: its entry says why. The
//! task fails where something is off and no entry says so.

mod formula;
mod page;
mod problem;
mod run;
mod tables;

use std::{
    fs,
    path::{Path, PathBuf},
    sync::{
        Mutex,
        atomic::{AtomicUsize, Ordering},
    },
    thread,
};

use crate::{cargo, fault::Fault};
use problem::Problem;
use run::Outcome;

/// Folder of the decks and of their sources.
const FOLDER: &str = "cases/foreign";

/// The page of the book.
const PAGE: &str = "docs/book/reference/suite.md";

/// Options of the command.
struct Options {
    binary: Option<PathBuf>,
    keep: PathBuf,
    jobs: usize,
    only: Vec<String>,
    repeat: Repeat,
}

/// Treatment of runs whose results are there.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Repeat {
    Always,
    IfAbsent,
}

/// Runs the suite, prints it and writes its page.
///
/// # Errors
/// Wrong options, a program that does not start, a faulty `suite.toml`, or results that are off
/// and that no entry explains.
pub fn suite(arguments: &[String]) -> Result<(), Fault> {
    let options = Options::read(arguments)?;
    let binary = match &options.binary {
        Some(binary) => binary.clone(),
        None => cargo::program()?,
    };
    let problems = problem::read(Path::new(FOLDER))?;
    let wanted =
        |problem: &&Problem| options.only.is_empty() || options.only.contains(&problem.deck);
    let problems: Vec<&Problem> = problems.iter().filter(wanted).collect();
    let outcomes = all(&options, &binary, &problems)?;
    println!("\n{}", page::table(&outcomes));
    if options.only.is_empty() {
        let path = PathBuf::from(PAGE);
        fs::write(&path, page::page(&outcomes))
            .map_err(|cause| Fault::Unreadable { path, cause })?;
    }
    match outcomes
        .iter()
        .flat_map(Outcome::unexplained)
        .collect::<Vec<_>>()
    {
        found if found.is_empty() => Ok(()),
        found => Err(Fault::Suite(found.join("\n"))),
    }
}

/// Runs all problems, several at a time, and returns them in the order of the list.
fn all<'a>(
    options: &Options,
    binary: &Path,
    problems: &[&'a Problem],
) -> Result<Vec<Outcome<'a>>, Fault> {
    let next = AtomicUsize::new(0);
    let done = Mutex::new(Vec::new());
    thread::scope(|scope| {
        for _ in 0..options.jobs {
            scope.spawn(|| {
                loop {
                    let at = next.fetch_add(1, Ordering::Relaxed);
                    let Some(problem) = problems.get(at) else {
                        break;
                    };
                    let outcome = run::outcome(problem, binary, &options.keep, options.repeat);
                    if let Ok(outcome) = &outcome {
                        println!("{outcome}");
                    }
                    done.lock()
                        .expect("no thread fails while it holds the list")
                        .push((at, outcome));
                }
            });
        }
    });
    let mut done = done
        .into_inner()
        .expect("no thread fails while it holds the list");
    done.sort_by_key(|(at, _)| *at);
    done.into_iter().map(|(_, outcome)| outcome).collect()
}

impl Options {
    fn read(arguments: &[String]) -> Result<Self, Fault> {
        let mut options = Self {
            binary: None,
            keep: "target/suite".into(),
            jobs: 1,
            only: Vec::new(),
            repeat: Repeat::Always,
        };
        let mut rest = arguments.iter();
        while let Some(name) = rest.next() {
            if name == "--results" {
                options.repeat = Repeat::IfAbsent;
                continue;
            }
            let wrong = || Fault::Option(format!("`{name}` needs another value"));
            let value = rest.next().ok_or_else(wrong)?;
            match name.as_str() {
                "--binary" => options.binary = Some(value.into()),
                "--keep" => options.keep = value.into(),
                "--jobs" => {
                    let jobs = value.parse().ok().filter(|&jobs| jobs > 0);
                    options.jobs = jobs.ok_or_else(wrong)?;
                }
                "--only" => options.only = value.split(',').map(str::to_owned).collect(),
                _ => return Err(Fault::Option(format!("there is no option `{name}`"))),
            }
        }
        Ok(options)
    }
}
