//! Borders between the crates: the knowledge that each part must not have.
//!
//! [`dependencies`] compares the manifests, as `cargo metadata` reports them,
//! with the table of what each crate may depend on; [`source`] reads the text of
//! every source file for what a dependency cannot tell: files touched outside
//! the crates of input and output, output below the program, unsafe code, files
//! that are too long; [`circles`] follows the imports between the files of a crate;
//! [`openings`] reads how doc comments begin, in Rust and Python; [`features`] compares the features
//! of dependencies between builds.

mod circles;
mod dependencies;
mod features;
mod imports;
mod metadata;
mod openings;
mod source;
mod text;

use std::{
    collections::HashSet,
    fs,
    path::{Path, PathBuf},
};

use crate::fault::Fault;
use source::{Code, Place};

/// Checks the dependencies and the sources of all crates.
///
/// # Errors
/// All breaches together, or why the crates cannot be read.
pub fn check() -> Result<(), Fault> {
    let workspace = metadata::workspace()?;
    let mut breaches = dependencies::breaches(&workspace.packages);
    breaches.extend(features::breaches()?);
    let mut count = 0;
    for package in &workspace.packages {
        let files = sources(&package.folder, &["rs"])?;
        let python = sources(&package.folder, &["py", "pyi"])?;
        let tests: HashSet<PathBuf> = files
            .iter()
            .flat_map(|(path, text)| text::test_files(path, text))
            .collect();
        let within = |path| Path::strip_prefix(path, &workspace.root).unwrap_or(path);
        for (path, text) in &files {
            let within = within(path);
            breaches.extend(openings::breaches(within, text));
            let code = if tests.contains(path) {
                Code::Test
            } else {
                Code::of(&package.name, within)
            };
            breaches.extend(source::breaches(
                &Place::new(&package.name, within, code),
                text,
            ));
        }
        for (path, text) in &python {
            breaches.extend(openings::breaches(within(path), text));
        }
        let product: Vec<(PathBuf, &str)> = files
            .iter()
            .filter(|(path, _)| !tests.contains(path))
            .map(|(path, text)| (within(path).to_owned(), text.as_str()))
            .collect();
        let source = package.folder.join("src");
        breaches.extend(circles::breaches(within(&source), &product));
        count += files.len();
    }
    if breaches.is_empty() {
        println!("{} crates, {count} source files", workspace.packages.len());
        Ok(())
    } else {
        Err(Fault::Breaches(breaches))
    }
}

/// Path and text of all files below a folder with one of the extensions.
fn sources(folder: &Path, extensions: &[&str]) -> Result<Vec<(PathBuf, String)>, Fault> {
    let read = |path: PathBuf| match fs::read_to_string(&path) {
        Ok(text) => Ok((path, text)),
        Err(cause) => Err(Fault::Unreadable { path, cause }),
    };
    files(folder, extensions)?.into_iter().map(read).collect()
}

/// All files below a folder with one of the extensions, sorted by path.
fn files(folder: &Path, extensions: &[&str]) -> Result<Vec<PathBuf>, Fault> {
    let unreadable = |cause| Fault::Unreadable {
        path: folder.to_owned(),
        cause,
    };
    let is_wanted = |path: &Path| {
        let own = path.extension().and_then(|extension| extension.to_str());
        own.is_some_and(|own| extensions.contains(&own))
    };
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).map_err(unreadable)? {
        let path = entry.map_err(unreadable)?.path();
        if path.is_dir() {
            found.extend(files(&path, extensions)?);
        } else if is_wanted(&path) {
            found.push(path);
        }
    }
    found.sort();
    Ok(found)
}
