//! The program from outside: exit codes, messages and files.

use std::{
    fs,
    path::{Path, PathBuf},
    process::{Command, Output},
};

use serde_json::Value;

/// Runs the program in a folder.
fn striae(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_striae"))
        .args(arguments)
        .current_dir(folder)
        .output()
        .unwrap()
}

fn stdout(output: &Output) -> String {
    String::from_utf8(output.stdout.clone()).unwrap()
}

fn stderr(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).unwrap()
}

/// Names of everything in a folder, sorted.
fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).unwrap();
    let mut names: Vec<String> = entries
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

fn json(path: PathBuf) -> Value {
    serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap()
}

/// A block pressed on a plane.
const DECK: &str = r#"
title = "Block on a plane"

[[material]]
name = "solid"
law = "neo-hookean"
youngs_modulus = 1000
poissons_ratio = 0.3

[[body]]
name = "block"
material = "solid"
mesh = { generator = "block", size = [1, 1, 1], divisions = [2, 2, 2] }

[[rigid]]
name = "floor"
plane = { point = [0, 0, 0], normal = [0, 0, 1] }

[[pair]]
name = "sole"
a = { body = "block", facets = "zmin" }
b = { rigid = "floor" }
friction = { law = "coulomb", mu = 0.2 }

[[step]]
name = "press"
increments = 2
displacement = [{ body = "block", nodes = "zmax", x = 0, y = 0, z = -0.05 }]
"#;

#[test]
fn the_list_names_every_case_of_the_collection() {
    let folder = tempfile::tempdir().unwrap();
    let output = striae(folder.path(), &["reproduce", "--list"]);
    assert!(output.status.success());
    let listed = stdout(&output);
    let mut listed: Vec<&str> = listed
        .lines()
        .filter_map(|line| line.split_whitespace().next())
        .collect();
    listed.sort_unstable();
    let collection = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../cases");
    let mut cases = names(&collection);
    // Problems that other programs publish are run by a command of their own.
    cases.retain(|name| name != "foreign");
    assert_eq!(listed, cases);
    assert!(names(folder.path()).is_empty());
}

#[test]
fn one_thing_must_be_asked_for() {
    let folder = tempfile::tempdir().unwrap();
    for arguments in [
        &["reproduce"][..],
        &["reproduce", "--all", "--list"],
        &["reproduce", "two-blocks", "--all"],
        &["reproduce", "no-such-case"],
    ] {
        let output = striae(folder.path(), arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
    }
    let output = striae(folder.path(), &["reproduce", "no-such-case"]);
    assert!(stderr(&output).contains("unknown case `no-such-case`; known cases are two-blocks"));
    assert!(names(folder.path()).is_empty());
}

#[test]
fn a_case_prints_its_table_and_writes_its_files() {
    let folder = tempfile::tempdir().unwrap();
    let arguments = ["reproduce", "pad-on-incline", "--quiet", "--out", "made"];
    let output = striae(folder.path(), &arguments);
    assert!(output.status.success(), "{}", stderr(&output));
    let said = stdout(&output);
    for part in [
        "quantity ",
        "| verdict",
        "slide.limit [MPa]",
        "newton.median",
    ] {
        assert!(said.contains(part), "{part} in {said}");
    }
    assert!(
        !said.contains("FAIL") && !said.contains("MISSING"),
        "{said}"
    );
    assert!(stderr(&output).is_empty());
    let case = folder.path().join("made/pad-on-incline");
    let expected = [
        "README.md",
        "friction.csv",
        "friction.png",
        "friction.svg",
        "hold",
        "quantities.csv",
        "slide",
    ];
    assert_eq!(names(&case), expected);
    let statuses =
        ["hold", "slide"].map(|deck| json(case.join(deck).join("summary.json"))["status"].clone());
    assert_eq!(statuses, ["completed", "stopped"]);
}

/// The collocated run of the case is there to be compared, and does not balance by its method.
#[test]
fn a_case_with_a_collocated_run_ends_without_a_warning() {
    let folder = tempfile::tempdir().unwrap();
    let arguments = ["reproduce", "two-blocks", "--quick", "--strict"];
    let output = striae(folder.path(), &arguments);
    assert!(output.status.success(), "{}", stderr(&output));
    let said = stdout(&output);
    assert!(!said.contains("warning"), "{said}");
    assert!(
        said.contains("note: collocated: pair `interface`"),
        "{said}"
    );
}

#[test]
fn a_run_writes_what_it_says() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("block.toml"), DECK).unwrap();
    let output = striae(folder.path(), &["run", "block.toml"]);
    assert!(output.status.success(), "{}", stderr(&output));
    assert!(stdout(&output).contains("output in results/block"));
    let results = folder.path().join("results/block");
    let expected = [
        "bodies.pvd",
        "contact.pvd",
        "deck.toml",
        "end.bin",
        "fields",
        "history.csv",
        "law-sole.svg",
        "rigid.pvd",
        "summary.json",
    ];
    assert_eq!(names(&results), expected);
    let fields = [
        "block-00000.vtu",
        "block-00001.vtu",
        "block-00002.vtu",
        "contact-sole-block-00000.vtu",
        "contact-sole-block-00001.vtu",
        "contact-sole-block-00002.vtu",
        "rigid-floor-00000.vtu",
        "rigid-floor-00001.vtu",
        "rigid-floor-00002.vtu",
    ];
    assert_eq!(names(&results.join("fields")), fields);
    let history = fs::read_to_string(results.join("history.csv")).unwrap();
    assert_eq!(history.lines().count(), 3);
    let summary = json(results.join("summary.json"));
    assert_eq!(summary["case"], "block");
    assert_eq!(summary["status"], "completed");
    assert_eq!(summary["increments"], 2);
    assert_eq!(summary["cutbacks"], 0);
    let lift = summary["pairs"][0]["resultant_a"][2].as_f64().unwrap();
    let held = summary["reactions"]["block.zmax"][2].as_f64().unwrap();
    assert!(lift > 0.0);
    assert!((held + lift).abs() < 1e-8 * lift, "{held} {lift}");
}

#[test]
fn a_faulty_deck_is_refused_with_its_faults_and_nothing_is_written() {
    let folder = tempfile::tempdir().unwrap();
    let broken = DECK.replace("mu = 0.2", "mu = -0.2").replace(
        "body = \"block\", nodes = \"zmax\"",
        "body = \"brick\", nodes = \"zmax\"",
    );
    fs::write(folder.path().join("broken.toml"), broken).unwrap();
    for command in ["run", "check"] {
        let output = striae(folder.path(), &[command, "broken.toml"]);
        assert_eq!(output.status.code(), Some(2));
        let said = stderr(&output);
        assert!(said.contains("broken.toml:"), "{said}");
        assert!(said.contains("mu") && said.contains("brick"), "{said}");
        assert!(stdout(&output).is_empty());
        assert_eq!(names(folder.path()), ["broken.toml"]);
    }
}

#[test]
fn a_run_that_stops_exits_with_one_and_keeps_what_it_has() {
    let folder = tempfile::tempdir().unwrap();
    let pushed = DECK.replace(
        "displacement = [{ body = \"block\", nodes = \"zmax\", x = 0, y = 0, z = -0.05 }]",
        "traction = [{ body = \"block\", facets = \"zmax\", vector = [5, 0, -10] }]",
    );
    fs::write(folder.path().join("deck.toml"), pushed).unwrap();
    let output = striae(
        folder.path(),
        &["run", "deck.toml", "--quiet", "--out", "o"],
    );
    assert_eq!(output.status.code(), Some(1));
    assert!(stderr(&output).contains("step `press` stopped at time"));
    let summary = json(folder.path().join("o/summary.json"));
    assert_eq!(summary["status"], "stopped");
}
