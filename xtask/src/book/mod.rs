//! `cargo xtask book`: the book as HTML in `target/book`, from a fresh clone.
//!
//! | option | what it does |
//! | --- | --- |
//! | none | checks all links, builds the book with mdBook, checks the pages |
//!
//! mdBook is installed into `target/tools` when it is called for the first time, in the
//! version that [`MDBOOK`] pins. Formulas become MathML, so that the book needs neither a
//! network nor scripts for them.

pub mod links;
pub mod mathematics;
mod site;

use std::{
    path::{Path, PathBuf},
    process::Command,
};

use crate::{borders::Breach, fault::Fault};

/// The version of mdBook.
const MDBOOK: &str = "0.5.4";

/// Where programs are installed.
const TOOLS: &str = "target/tools";

/// Where the book is built; `docs/book.toml` says so.
const BUILT: &str = "target/book";

/// Builds the book.
///
/// # Errors
/// When a link leads nowhere, mdBook cannot be had, or a formula cannot be read.
pub fn book(options: &[String]) -> Result<(), Fault> {
    if let Some(unknown) = options.first() {
        return Err(Fault::Option(format!(
            "`cargo xtask book` knows no `{unknown}`"
        )));
    }
    sound(links::breaches(Path::new("."))?)?;
    run(Command::new(mdbook()?).args(["build", "docs"]))?;
    sound(site::breaches(Path::new(BUILT))?)?;
    println!("open {BUILT}/index.html");
    Ok(())
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
