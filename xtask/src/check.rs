//! `cargo xtask check`: formatting, borders, lints, documentation, tests, examples,
//! packages and, where there is Python, its package.
//!
//! Cheap checks come first. Everything is built in the release profile, so that
//! one compilation of the dependencies serves tests and programs, and another,
//! of types only, serves lints and documentation.

use std::{
    fs,
    path::PathBuf,
    time::{Duration, Instant},
};

use crate::{
    borders,
    cargo::{self, cargo, release},
    fault::Fault,
    python,
};

/// A check that is one call of cargo.
struct Stage {
    name: &'static str,
    arguments: &'static [&'static str],
    environment: &'static [(&'static str, &'static str)],
}

const FORMAT: Stage = Stage {
    name: "formatting",
    arguments: &["fmt", "--all", "--check"],
    environment: &[],
};

const BUILT: [Stage; 3] = [
    Stage {
        name: "lints",
        arguments: &[
            "clippy",
            "--release",
            "--workspace",
            "--all-targets",
            "--",
            "--deny",
            "warnings",
        ],
        environment: &[],
    },
    Stage {
        name: "documentation",
        arguments: &["doc", "--release", "--workspace", "--no-deps"],
        environment: &[("RUSTDOCFLAGS", "--deny warnings")],
    },
    Stage {
        name: "tests",
        arguments: &["test", "--release", "--workspace"],
        environment: &[],
    },
];

/// Packages of the crates that other programs use: contact alone, and what it needs.
const PACKAGES: Stage = Stage {
    name: "packages",
    arguments: &[
        "package",
        "--no-verify",
        "--allow-dirty",
        "--quiet",
        "--package",
        "striae-verify",
        "--package",
        "striae-declared",
        "--package",
        "striae-mesh",
        "--package",
        "striae-law",
        "--package",
        "striae-surface",
        "--package",
        "striae-contact",
    ],
    environment: &[],
};

/// Runs all checks, up to the first that fails.
///
/// # Errors
/// Returns the failure of that check.
pub fn check() -> Result<(), Fault> {
    let started = Instant::now();
    timed(FORMAT.name, || run(&FORMAT))?;
    timed("borders", borders::check)?;
    for stage in &BUILT {
        timed(stage.name, || run(stage))?;
    }
    timed("examples", examples)?;
    timed(PACKAGES.name, || run(&PACKAGES))?;
    if python::is_possible() {
        timed("python", python::check)?;
    } else {
        println!("== python passed over: {}", Fault::NoPython);
    }
    println!("all checks passed in {}", seconds(started.elapsed()));
    Ok(())
}

/// Runs the examples of the library.
fn examples() -> Result<(), Fault> {
    let folder = PathBuf::from("crates/striae/examples");
    let unreadable = |cause| Fault::Unreadable {
        path: folder.clone(),
        cause,
    };
    let mut names = Vec::new();
    for entry in fs::read_dir(&folder).map_err(unreadable)? {
        let path = entry.map_err(unreadable)?.path();
        // Folders hold what the examples share.
        let stem = path.file_stem().filter(|_| path.is_file());
        names.extend(stem.map(|name| name.to_string_lossy().into_owned()));
    }
    names.sort();
    cargo(&["build", "--release", "--workspace", "--examples"], &[])?;
    let built = release().join("examples");
    names
        .iter()
        .try_for_each(|name| cargo::run(&built.join(name), &[], &[]))
}

/// Runs the benchmarks with the given arguments.
///
/// # Errors
/// When they cannot be built or fail.
pub fn bench(arguments: &[String]) -> Result<(), Fault> {
    let mut all: Vec<&str> = ["run", "--release", "-p", "striae-bench", "--"].into();
    all.extend(arguments.iter().map(String::as_str));
    cargo(&all, &[])
}

/// Tries damaged decks and files with the given arguments.
///
/// # Errors
/// When they cannot be built or some fail.
pub fn mutants(arguments: &[String]) -> Result<(), Fault> {
    let program = "striae-mutants";
    cargo(
        &["build", "--release", "--workspace", "--bin", program],
        &[],
    )?;
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    cargo::run(&release().join(program), &words, &[])
}

fn timed(name: &str, check: impl FnOnce() -> Result<(), Fault>) -> Result<(), Fault> {
    println!("== {name}");
    let started = Instant::now();
    check()?;
    println!("== {name} passed in {}", seconds(started.elapsed()));
    Ok(())
}

fn run(stage: &Stage) -> Result<(), Fault> {
    cargo(stage.arguments, stage.environment)
}

fn seconds(duration: Duration) -> String {
    format!("{:.0} s", duration.as_secs_f64())
}
