//! `striae-mutants --seeds A..B`: tries mutants in processes of their own.
//!
//! ```text
//! --seeds A..B          the seeds; 0..1000 where nothing is said
//! --targets NAMES       `deck`, `gmsh`, ..., `meshes` or `all`, with commas; `all`
//! --seconds N           processor time after which a mutant hangs; 10
//! --megabytes N         memory that a mutant may take; 2000
//! --jobs N              processes; 2
//! --keep FOLDER         where mutants that fail are kept; target/mutants
//! ```
//!
//! Prints a line for each failure and a table of the targets; ends with 1 where one fails.

mod driver;
mod worker;

use std::{ops::Range, path::PathBuf, process::ExitCode};

use striae_mutants::target::Target;

const USAGE: &str = "usage: striae-mutants [--seeds A..B] [--targets NAMES] [--seconds N] [--megabytes N] [--jobs N] [--keep FOLDER]";

/// Options of the command line.
#[derive(Clone, Debug)]
struct Options {
    seeds: Range<u64>,
    names: String,
    targets: Vec<Target>,
    seconds: u64,
    megabytes: u64,
    jobs: usize,
    keep: PathBuf,
    is_worker: bool,
}

impl Options {
    fn read(mut words: impl Iterator<Item = String>) -> Option<Self> {
        let mut options = Self {
            seeds: 0..1000,
            names: "all".into(),
            targets: Target::ALL.into(),
            seconds: 10,
            megabytes: 2000,
            jobs: 2,
            keep: "target/mutants".into(),
            is_worker: false,
        };
        while let Some(word) = words.next() {
            if word == "--worker" {
                options.is_worker = true;
                continue;
            }
            let value = words.next()?;
            match word.as_str() {
                "--seeds" => {
                    let (first, end) = value.split_once("..")?;
                    options.seeds = first.parse().ok()?..end.parse().ok()?;
                }
                "--targets" => {
                    options.targets = Target::listed(&value).ok()?;
                    options.names = value;
                }
                "--seconds" => options.seconds = value.parse().ok()?,
                "--megabytes" => options.megabytes = value.parse().ok()?,
                "--jobs" => options.jobs = value.parse().ok().filter(|jobs| *jobs > 0)?,
                "--keep" => options.keep = value.into(),
                _ => return None,
            }
        }
        Some(options)
    }
}

fn main() -> ExitCode {
    let Some(options) = Options::read(std::env::args().skip(1)) else {
        eprintln!("{USAGE}");
        return ExitCode::from(2);
    };
    let done = match options.is_worker {
        true => worker::work(&options).map(|()| 0),
        false => driver::drive(&options),
    };
    match done {
        Ok(0) => ExitCode::SUCCESS,
        Ok(_) => ExitCode::FAILURE,
        Err(cause) => {
            eprintln!("striae-mutants: {cause}");
            ExitCode::FAILURE
        }
    }
}
