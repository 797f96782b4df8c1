//! Features of dependencies, which tests, program and wheel must have in common.
//!
//! Cargo builds a dependency anew for every set of features, and all that depends on it. Tests need
//! dependencies that ask others for more; `striae-sparse` and `striae-deck` ask for the same, so
//! that one build serves all.

use std::collections::BTreeSet;

use crate::{breach::Breach, cargo, fault::Fault};

/// Build with the dependencies of tests.
const TESTS: [&str; 3] = ["--workspace", "--edges", "normal,dev"];
/// Builds that share it.
const OTHERS: [(&str, [&str; 4]); 2] = [
    ("program", ["--workspace", "--edges", "normal", "--locked"]),
    (
        "wheel",
        ["--package=striae-py", "--edges", "normal", "--locked"],
    ),
];

/// Finds dependencies that another build has with other features than the tests.
///
/// # Errors
/// When cargo does not answer.
pub fn breaches() -> Result<Vec<Breach>, Fault> {
    let tests = features(&TESTS)?;
    let mut breaches = Vec::new();
    for (name, arguments) in OTHERS {
        let others = features(&arguments)?;
        breaches.extend(others.difference(&tests).map(|package| Breach {
            place: format!("features of the {name}"),
            wrong: format!("`{package}` is not built so for the tests; ask for what they have"),
        }));
    }
    Ok(breaches)
}

/// Packages of a build, each with its version and features.
fn features(arguments: &[&str]) -> Result<BTreeSet<String>, Fault> {
    const FORMAT: [&str; 5] = ["tree", "--prefix", "none", "--format", "{p} {f}"];
    let text = cargo::answer(&[&FORMAT[..], arguments].concat())?;
    let text = String::from_utf8_lossy(&text);
    let lines = text.lines().map(|line| line.trim_end_matches(" (*)"));
    Ok(lines.map(str::to_owned).collect())
}
