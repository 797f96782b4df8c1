//! Parameters of decks from the command line: `--set`, sweeps, comparisons, JSON.

use std::{
    fs,
    path::Path,
    process::{Command, Output},
};

const DECK: &str = r#"
title = "A block on a floor"
[parameters]
mu = 0.3
way = 0.1
[[material]]
name = "rubber"
law = "neo-hookean"
youngs_modulus = 100
poissons_ratio = 0.3
[[body]]
name = "block"
material = "rubber"
mesh = { generator = "block", size = [1, 1, 1], divisions = [2, 2, 2] }
[[rigid]]
name = "floor"
plane = { point = [0, 0, 0], normal = [0, 0, 1] }
[[pair]]
name = "sole"
a = { body = "block", facets = "zmin" }
b = { rigid = "floor" }
friction = { law = "coulomb", mu = "= mu" }
[[step]]
name = "press"
increments = 1
displacement = [{ body = "block", nodes = "zmax", x = 0, y = 0, z = -0.02 }]
[[step]]
name = "drag"
increments = 2
displacement = [{ body = "block", nodes = "zmax", x = "= way" }]
"#;

fn striae(place: &Path, words: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_striae"))
        .args(words)
        .current_dir(place)
        .output()
        .expect("the program starts")
}

fn stdout(output: &Output) -> String {
    String::from_utf8_lossy(&output.stdout).into_owned()
}

fn stderr(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

fn place() -> tempfile::TempDir {
    let place = tempfile::tempdir().expect("a folder");
    fs::write(place.path().join("deck.toml"), DECK).expect("a deck");
    place
}

/// Friction is proportional to the coefficient in a sweep over it.
#[test]
fn a_sweep_makes_a_table() {
    let place = place();
    let words = [
        "sweep",
        "deck.toml",
        "--vary",
        "mu=0.1,0.2",
        "--workers",
        "2",
        "--out",
        "s",
    ];
    let output = striae(place.path(), &words);
    assert!(output.status.success(), "{output:?}");
    let said = stdout(&output);
    assert!(said.contains("mu") && said.contains("completed"), "{said}");
    let table = fs::read_to_string(place.path().join("s/sweep.csv")).unwrap();
    let mut lines = table
        .lines()
        .map(|line| line.split(',').collect::<Vec<_>>());
    let header = lines.next().unwrap();
    let rows: Vec<Vec<&str>> = lines.collect();
    assert_eq!((header[0], rows.len()), ("mu", 2));
    let at = |name: &str| header.iter().position(|column| *column == name).unwrap();
    let [x, z] = ["pair.sole.resultant_a.x", "pair.sole.resultant_a.z"].map(at);
    for row in &rows {
        let [mu, x, z] = [row[0], row[x], row[z]].map(|text| text.parse::<f64>().unwrap());
        assert!((x.abs() / z - mu).abs() < 1e-6, "{mu}: {x} {z}");
    }
    let compared = striae(
        place.path(),
        &["compare", "s/mu=0.1", "s/mu=0.2", "--within", "0.1"],
    );
    assert_eq!(compared.status.code(), Some(1));
    assert!(
        stdout(&compared).contains("pair.sole.resultant_a.x"),
        "{compared:?}"
    );
    let same = striae(
        place.path(),
        &["compare", "s/mu=0.1", "s/mu=0.1", "--within", "0"],
    );
    assert!(same.status.success(), "{same:?}");
}

#[test]
fn a_sweep_of_a_faulty_deck_runs_nothing() {
    let place = place();
    let words = ["sweep", "deck.toml", "--vary", "mu=0.1,-1", "--out", "s"];
    let output = striae(place.path(), &words);
    assert_eq!(output.status.code(), Some(2));
    assert!(stderr(&output).contains("deck.toml:"), "{output:?}");
    assert!(!place.path().join("s").exists());
}

#[test]
fn a_run_takes_settings_of_its_own_parameters_only() {
    let place = place();
    let path = place.path();
    let run = |words: &[&str]| {
        let output = striae(path, words);
        assert!(output.status.success(), "{output:?}");
    };
    run(&[
        "run",
        "deck.toml",
        "--set",
        "mu=0.2",
        "--out",
        "a",
        "--quiet",
    ]);
    let unknown = striae(path, &["run", "deck.toml", "--set", "nu=1", "--out", "b"]);
    assert_eq!(unknown.status.code(), Some(2));
    assert!(
        stderr(&unknown).contains("its [parameters] are `mu`, `way`"),
        "{unknown:?}"
    );
    assert!(!path.join("b").exists());
}

/// A fault that only meshes show is told by `run` as by `check`, and nothing is written.
#[test]
fn run_refuses_what_check_refuses() {
    let place = place();
    let textured = DECK
        .replace(
            r#"{ rigid = "floor" }"#,
            r#"{ rigid = "floor", texture = { uniform = [0, 0, 1] } }"#,
        )
        .replace(
            r#"{ law = "coulomb", mu = "= mu" }"#,
            r#"{ law = "orthotropic", mu_along = 0.1, mu_across = 0.2 }"#,
        );
    let loose = DECK.replace(
        r#"zmax", x = 0, y = 0, z = -0.02"#,
        r#"zmax", x = 0, y = 0"#,
    );
    for deck in [textured, loose] {
        fs::write(place.path().join("deck.toml"), deck).unwrap();
        let [check, run] = [
            &["check", "deck.toml"][..],
            &["run", "deck.toml", "--out", "r"],
        ]
        .map(|words| striae(place.path(), words));
        assert_eq!((check.status.code(), run.status.code()), (Some(2), Some(2)));
        assert_eq!(stderr(&check), stderr(&run));
        assert!(stderr(&run).starts_with("deck.toml:"), "{run:?}");
        assert!(!place.path().join("r").exists());
    }
}

#[test]
fn what_is_said_comes_as_json() {
    let place = place();
    let json = |words: &[&str]| -> serde_json::Value {
        let output = striae(place.path(), words);
        serde_json::from_str(&stdout(&output)).unwrap_or_else(|_| panic!("{output:?}"))
    };
    let checked = json(&["check", "deck.toml", "--json"]);
    assert_eq!(checked["bodies"][0]["nodes"], 27);
    assert_eq!(checked["faults"], serde_json::json!([]));
    let law = json(&["law", "deck.toml", "--json"]);
    assert_eq!(
        (&law[0]["law"], &law[0]["mu"]),
        (&"coulomb".into(), &0.3.into())
    );
    fs::write(
        place.path().join("m.csv"),
        "angle,friction,test\n0,0.4,1\n90,0.2,2\n",
    )
    .unwrap();
    let fitted = json(&[
        "fit",
        "m.csv",
        "--law",
        "orthotropic",
        "--json",
        "--angle-from",
        "along",
    ]);
    assert_eq!(fitted["constants"][0]["name"], "mu_along");
    assert!((fitted["constants"][0]["value"].as_f64().unwrap() - 0.4).abs() < 1e-9);
    fs::write(
        place.path().join("deck.toml"),
        DECK.replace("0.3\nway", "-1\nway"),
    )
    .unwrap();
    let faulty = json(&["check", "deck.toml", "--json"]);
    assert_eq!(faulty["faults"][0]["line"], 22);
}

/// A run that is killed before its first increment goes on from its start, with the parameters
/// that were set, to the results of one that was not.
#[test]
fn a_run_that_is_killed_at_once_resumes() {
    let place = place();
    let path = place.path();
    let fine = DECK.replace("divisions = [2, 2, 2]", "divisions = [12, 12, 12]");
    fs::write(path.join("deck.toml"), fine).unwrap();
    let words = |folder| {
        [
            "run",
            "deck.toml",
            "--set",
            "mu=0.4",
            "--quiet",
            "--out",
            folder,
        ]
    };
    let mut first = Command::new(env!("CARGO_BIN_EXE_striae"))
        .args(words("killed"))
        .current_dir(path)
        .spawn()
        .expect("the program starts");
    while !path.join("killed/checkpoint.bin").exists() {
        assert!(
            first.try_wait().unwrap().is_none(),
            "a checkpoint comes first"
        );
        std::thread::sleep(std::time::Duration::from_millis(5));
    }
    first.kill().unwrap();
    let resumed = striae(path, &["resume", "killed", "--quiet"]);
    first.wait().unwrap();
    assert!(resumed.status.success(), "{resumed:?}");
    assert!(striae(path, &words("whole")).status.success());
    let [killed, whole] = ["killed", "whole"]
        .map(|folder| fs::read_to_string(path.join(folder).join("history.csv")).unwrap());
    assert_eq!(killed, whole);
}
