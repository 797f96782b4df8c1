//! Warnings of runs and faults of meshes, from outside: messages, files and exit codes.

use std::{
    fs,
    path::Path,
    process::{Command, Output},
};

use striae_output::summary::{Summary, WarningSummary};

/// A block above a floor, pressed by `way` from the height `z`.
fn deck(z: f64, way: f64, normal: i8) -> String {
    format!(
        r#"
title = "A block above a floor"

[[material]]
name = "solid"
law = "neo-hookean"
youngs_modulus = 1000
poissons_ratio = 0.3

[[body]]
name = "block"
material = "solid"
mesh = {{ generator = "block", origin = [0, 0, {z}], size = [1, 1, 1], divisions = [2, 2, 2] }}

[[rigid]]
name = "floor"
plane = {{ point = [0, 0, 0], normal = [0, 0, {normal}] }}

[[pair]]
name = "sole"
a = {{ body = "block", facets = "zmin" }}
b = {{ rigid = "floor" }}

[[step]]
name = "press"
increments = 2
displacement = [{{ body = "block", nodes = "zmax", x = 0, y = 0, z = {} }}]
"#,
        -way
    )
}

fn striae(folder: &Path, deck: &str, arguments: &[&str]) -> Output {
    fs::write(folder.join("deck.toml"), deck).unwrap();
    let mut command = Command::new(env!("CARGO_BIN_EXE_striae"));
    command
        .args(arguments)
        .args(["deck.toml"])
        .current_dir(folder);
    command.output().unwrap()
}

fn stderr(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).unwrap()
}

fn warnings(folder: &Path) -> Vec<WarningSummary> {
    Summary::read(&folder.join("out/summary.json"))
        .unwrap()
        .warnings
}

const RUN: [&str; 3] = ["run", "--out", "out"];
const STRICT: [&str; 5] = ["run", "--strict", "--overwrite", "--out", "out"];

#[test]
fn a_pair_that_never_meets_is_a_warning_and_strictly_exit_code_1() {
    let folder = tempfile::tempdir().unwrap();
    let gap = deck(0.1, 0.08, 1);
    let lenient = striae(folder.path(), &gap, &RUN);
    assert_eq!(lenient.status.code(), Some(0), "{}", stderr(&lenient));
    let said = "warning: pair `sole` can never meet";
    assert!(stderr(&lenient).contains(said), "{}", stderr(&lenient));
    let found = warnings(folder.path());
    assert_eq!(found.len(), 1);
    assert_eq!(found[0].kind, "never-meets");
    assert_eq!(found[0].pair.as_deref(), Some("sole"));
    let strict = striae(folder.path(), &gap, &STRICT);
    assert_eq!(strict.status.code(), Some(1));
    assert!(stderr(&strict).contains("1 warning, which `--strict` forbids"));
}

#[test]
fn a_run_without_fault_is_without_warning() {
    let folder = tempfile::tempdir().unwrap();
    let pressed = striae(folder.path(), &deck(0.0, 0.05, 1), &STRICT);
    assert_eq!(pressed.status.code(), Some(0), "{}", stderr(&pressed));
    assert!(warnings(folder.path()).is_empty());
    assert!(!stderr(&pressed).contains("warning"));
}

#[test]
fn check_says_how_pairs_fit_and_that_they_can_never_meet() {
    let folder = tempfile::tempdir().unwrap();
    let checked = striae(folder.path(), &deck(0.5, 0.1, 1), &["check"]);
    assert_eq!(checked.status.code(), Some(0));
    let said = String::from_utf8(checked.stdout).unwrap();
    assert!(said.contains("smallest gap 0.5 at node"), "{said}");
    assert!(
        said.contains("warning: pair `sole` can never meet"),
        "{said}"
    );
}

#[test]
fn overlaps_and_normals_that_point_away_are_faults_with_a_remedy() {
    let folder = tempfile::tempdir().unwrap();
    for (text, remedy) in [
        (deck(-0.1, 0.1, 1), "initial = \"close\""),
        (deck(0.1, 0.1, -1), "reverse the normal of `floor`"),
    ] {
        let output = striae(folder.path(), &text, &RUN);
        assert_eq!(output.status.code(), Some(2));
        let said = stderr(&output);
        assert!(
            said.contains("deck.toml:") && said.contains(remedy),
            "{said}"
        );
    }
}
