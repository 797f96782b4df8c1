//! `cargo xtask book`: the book as HTML in `target/book`, from a fresh clone.
//!
//! | option | what it does |
//! | --- | --- |
//! | none | checks all links, builds the book with mdBook, checks the pages |
//! | `--run` | runs the cases first, what `striae reproduce --quick` runs, and remakes the [gallery] |
//! | `--all` | the same with the cases in full, which takes hours |
//! | `--results FOLDER` | remakes the gallery from results of `striae reproduce` that are there |
//!
//! mdBook is installed into `target/tools` when it is called for the first time, in the
//! version that [`MDBOOK`] pins. Formulas become MathML, so that the book needs neither a
//! network nor scripts for them.

mod exhibits;
mod gallery;
pub mod links;
pub mod mathematics;
mod site;

use std::{
    env,
    path::{Path, PathBuf},
    process::Command,
};

use crate::{breach::Breach, cargo, fault::Fault};
use gallery::Extent;

/// The version of mdBook.
const MDBOOK: &str = "0.5.4";

/// Folder in which programs are installed.
const TOOLS: &str = "target/tools";

/// Folder in which the book is built; `docs/book.toml` names it.
const BUILT: &str = "target/book";

/// Variable from which mdBook takes the command of `docs/book.toml` that makes formulas.
const PREPROCESSOR: &str = "MDBOOK_PREPROCESSOR__MATHEMATICS__COMMAND";

/// Folder in which cases are run for the gallery.
const RESULTS: &str = "target/gallery";

/// Builds the book.
///
/// # Errors
/// When a case cannot be run, a link leads nowhere, mdBook cannot be had, or a formula cannot
/// be read.
pub fn book(options: &[String]) -> Result<(), Fault> {
    let words: Vec<&str> = options.iter().map(String::as_str).collect();
    match words[..] {
        [] => {}
        ["--run"] => exhibited(Extent::Quick)?,
        ["--all"] => exhibited(Extent::All)?,
        ["--results", folder] => gallery::make(&cargo::program()?, Path::new(folder))?,
        _ => {
            let usage = "usage: cargo xtask book [--run | --all | --results FOLDER]";
            return Err(Fault::Option(usage.into()));
        }
    }
    sound(links::breaches(Path::new("."))?)?;
    let mut build = Command::new(mdbook()?);
    // mdBook would call cargo, which may be busy; this program does the same.
    if let Ok(own) = env::current_exe() {
        build.env(PREPROCESSOR, format!("{} mathematics", own.display()));
    }
    run(build.args(["build", "docs"]))?;
    sound(site::breaches(Path::new(BUILT))?)?;
    println!("open {BUILT}/index.html");
    Ok(())
}

/// Runs the cases and makes the gallery of them.
fn exhibited(extent: Extent) -> Result<(), Fault> {
    let program = cargo::program()?;
    let results = Path::new(RESULTS);
    gallery::reproduce(&program, extent, results)?;
    gallery::make(&program, results)
}

fn sound(breaches: Vec<Breach>) -> Result<(), Fault> {
    if breaches.is_empty() {
        return Ok(());
    }
    let lines: Vec<String> = breaches.iter().map(Breach::to_string).collect();
    Err(Fault::Book(lines.join("\n")))
}

/// mdBook, installed if it is not there.
fn mdbook() -> Result<PathBuf, Fault> {
    let program = PathBuf::from(TOOLS).join("bin/mdbook");
    let there = Command::new(&program).arg("--version").output();
    if there.is_ok_and(|said| String::from_utf8_lossy(&said.stdout).contains(MDBOOK)) {
        return Ok(program);
    }
    println!("installing mdBook {MDBOOK} into {TOOLS}");
    run(Command::new("cargo").args([
        "install",
        "mdbook",
        "--version",
        MDBOOK,
        "--locked",
        "--no-default-features",
        "--features",
        "search",
        "--root",
        TOOLS,
    ]))?;
    Ok(program)
}

/// Runs a command that has to end well.
fn run(command: &mut Command) -> Result<(), Fault> {
    let name = format!("{command:?}");
    let status = command.status().map_err(|cause| Fault::Start {
        command: name.clone(),
        cause,
    })?;
    match status.success() {
        true => Ok(()),
        false => Err(Fault::Failed {
            command: name,
            status,
        }),
    }
}
