//! Development tasks, run as `cargo xtask TASK`.
//!
//! | task | what it does |
//! | --- | --- |
//! | `check` | all that has to hold before a change goes in; see [`check`] |
//! | `python` | the Python package: wheel, types, tests; see [`python`] |
//! | `borders` | the border check alone, in a second; see [`borders`] |
//! | `scenes` | random scenes of contact, judged from their output; see [`scenes`] |
//! | `suite` | problems that other programs publish, and their page of the book; see [`suite`] |
//! | `report-test` | reports in headless Chromium; see [`browser`] |
//! | `book` | the book as HTML, its links checked; see [`book`] |
//! | `mathematics` | formulas of the book, for mdBook; see [`book::mathematics`] |
//! | `endurance` | runs that are killed, interrupted, short of disk, damaged; see [`endurance`] |
//! | `mpi` | the feature `petsc` on one to four ranks; see [`mpi`] |
//! | `mutants` | damaged decks and files; see `crates/striae-mutants` |
//! | `fuzz` | the targets of `mutants` under libFuzzer; see [`fuzz`] |
//! | `bench` | times of parts and of whole runs; see `crates/striae-bench/README.md` |
//!
//! Exit codes: 0 when all is well, 1 when a check failed, 2 for an unknown task.

mod book;
mod borders;
mod breach;
mod browser;
mod cargo;
mod check;
mod decks;
mod endurance;
mod fault;
mod fuzz;
mod mpi;
mod python;
mod scenes;
mod suite;

use std::{env, process::ExitCode};

const USAGE: &str = "usage: cargo xtask check | python | borders | scenes [OPTIONS] | suite [OPTIONS] | report-test | book | endurance | mpi [--all] [PARTS] | mutants [OPTIONS] | fuzz [OPTIONS] | bench [ARGUMENTS]";

fn main() -> ExitCode {
    let tasks: Vec<String> = env::args().skip(1).collect();
    let result = match tasks.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        ["check"] => check::check(),
        ["python"] => python::check(),
        ["borders"] => borders::check(),
        ["scenes", ..] => scenes::scenes(&tasks[1..]),
        ["suite", ..] => suite::suite(&tasks[1..]),
        ["report-test"] => browser::report_test(),
        ["book", ..] => book::book(&tasks[1..]),
        ["mathematics", ..] => book::mathematics::preprocess(&tasks[1..]),
        ["endurance", ..] => endurance::endurance(&tasks[1..]),
        ["mpi", ..] => mpi::check(&tasks[1..]),
        ["mutants", ..] => check::mutants(&tasks[1..]),
        ["fuzz", ..] => fuzz::fuzz(&tasks[1..]),
        ["bench", ..] => check::bench(&tasks[1..]),
        _ => {
            eprintln!("{USAGE}");
            return ExitCode::from(2);
        }
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(fault) => {
            eprintln!("{fault}");
            ExitCode::FAILURE
        }
    }
}
