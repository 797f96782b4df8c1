//! Parameters of decks from the command line: `--set`, sweeps, comparisons, JSON, derivatives.
//!
//! Longer than other files, as all commands are tried on the same deck.

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
depth = 0.02
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
displacement = [{ body = "block", nodes = "zmax", x = 0, y = 0, z = "= -depth" }]
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
        &["compare", "s/mu=0.1", "s/mu=0.2", "--tolerance", "0.1"],
    );
    assert_eq!(compared.status.code(), Some(1));
    assert!(
        stdout(&compared).contains("pair.sole.resultant_a.x"),
        "{compared:?}"
    );
    assert!(stderr(&compared).starts_with("the runs differ: `"));
    for (words, code) in [
        (&["compare", "s/mu=0.1", "s/mu=0.1", "--within", "0"][..], 0),
        (&["compare", "s/mu=0.1", "s/mu=0.2"], 1),
        (&["compare", "s/mu=0.1", "s/mu=0.2", "--tolerance", "2"], 0),
        (&["compare", "s/mu=0.1", "s/mu=0.2", "--tolerance", "-1"], 2),
        (&["compare", "s/mu=0.1", "none"], 2),
    ] {
        let compared = striae(place.path(), words);
        assert_eq!(compared.status.code(), Some(code), "{compared:?}");
    }
}

/// Cells of a table of a sweep by the names of their columns.
fn rows(file: &Path) -> Vec<std::collections::BTreeMap<String, String>> {
    let text = fs::read_to_string(file).expect("a table");
    let mut lines = text.lines();
    let names: Vec<&str> = lines.next().expect("a header").split(',').collect();
    let row = |line: &str| {
        let cells = line.splitn(names.len(), ',').map(str::to_owned);
        names
            .iter()
            .map(|name| (*name).to_owned())
            .zip(cells)
            .collect()
    };
    lines.map(row).collect()
}

#[test]
fn a_run_that_fails_is_a_row_with_its_reason() {
    let place = place();
    let words = [
        "sweep",
        "deck.toml",
        "--vary",
        "step.press.displacement.0.z=-0.01,-1.5",
        "--set",
        "mu=0.2",
        "-o",
        "s",
    ];
    let output = striae(place.path(), &words);
    assert_eq!(output.status.code(), Some(1), "{output:?}");
    let said = stderr(&output);
    assert!(said.contains("1 of 2 runs failed:\n  step.press"), "{said}");
    let rows = rows(&place.path().join("s/sweep.csv"));
    let statuses: Vec<&str> = rows.iter().map(|row| row["status"].as_str()).collect();
    assert_eq!(statuses, ["completed", "stopped"]);
    assert_eq!(rows[0]["increments"], "3");
    assert_eq!(rows[0]["reason"], "");
    assert!(rows[1]["reason"].len() > 10, "{rows:?}");
    // Nothing is written over results that are there.
    let again = striae(place.path(), &words);
    assert_eq!(again.status.code(), Some(2), "{again:?}");
    let said = stderr(&again);
    assert!(
        said.contains("holds the results of an earlier run"),
        "{said}"
    );
    let other = words.map(|word| word.replace("-1.5", "-0.02"));
    let other: Vec<&str> = other.iter().map(String::as_str).collect();
    assert_eq!(striae(place.path(), &other).status.code(), Some(2));
    assert_eq!(self::rows(&place.path().join("s/sweep.csv")), rows);
    // The table and the two runs.
    assert_eq!(place.path().join("s").read_dir().unwrap().count(), 3);
    let twice = [&words[..], &["--vary", "mu=1,2"]].concat();
    let twice = striae(place.path(), &twice);
    assert_eq!(twice.status.code(), Some(2));
    assert!(stderr(&twice).contains("`mu` is set or varied twice"));
}

/// Ctrl-C stops all runs after their increment, and the table lists what is there.
#[cfg(unix)]
#[test]
fn an_interrupted_sweep_keeps_what_is_there() {
    let place = place();
    let path = place.path();
    let long = DECK.replace("increments = 2\n", "increments = 4000\n");
    fs::write(path.join("deck.toml"), long).unwrap();
    let mut sweep = Command::new(env!("CARGO_BIN_EXE_striae"))
        .args(["sweep", "deck.toml", "--vary", "mu=0.1,0.2,0.3"])
        .args(["--workers", "2", "--out", "s"])
        .current_dir(path)
        .stderr(std::process::Stdio::piped())
        .spawn()
        .expect("the program starts");
    let begun = |mu: &str| {
        let history = fs::read_to_string(path.join(format!("s/mu={mu}/history.csv")));
        history.is_ok_and(|text| text.lines().count() > 3)
    };
    while !(begun("0.1") && begun("0.2")) {
        assert!(sweep.try_wait().unwrap().is_none(), "it takes longer");
        std::thread::sleep(std::time::Duration::from_millis(5));
    }
    let id = sweep.id().to_string();
    assert!(
        Command::new("kill")
            .args(["-INT", &id])
            .status()
            .unwrap()
            .success()
    );
    let ended = sweep.wait_with_output().unwrap();
    assert_eq!(ended.status.code(), Some(130), "{ended:?}");
    assert!(stderr(&ended).contains("interrupted with 0 of 3 runs completed"));
    let rows = rows(&path.join("s/sweep.csv"));
    let statuses: Vec<&str> = rows.iter().map(|row| row["status"].as_str()).collect();
    assert_eq!(statuses, ["interrupted", "interrupted", "not run"]);
    assert!(path.join("s/mu=0.1/checkpoint.bin").exists());
    assert!(!path.join("s/mu=0.3").exists());
}

/// A number that was set by its path is set again when a run continues with other steps.
#[test]
fn numbers_set_by_paths_go_on() {
    let place = place();
    let path = place.path();
    let further = DECK.to_owned()
        + "[[step]]\nname = \"rest\"\nincrements = 1\ndisplacement = [{ body = \"block\", nodes = \"zmax\", x = 0.2 }]\n";
    fs::write(path.join("further.toml"), further).unwrap();
    let set = ["--set", "pair.sole.friction.mu=0.15", "--set", "way=0.05"];
    let run = |words: &[&str]| striae(path, words);
    let first = run(&[&["run", "deck.toml", "--quiet", "--output", "a"][..], &set].concat());
    assert!(first.status.success(), "{first:?}");
    let with = [
        "resume",
        "a",
        "--with",
        "further.toml",
        "--quiet",
        "-o",
        "b",
    ];
    let other = run(&with);
    assert_eq!(other.status.code(), Some(2), "{other:?}");
    let same = run(&[&with[..], &set].concat());
    assert!(same.status.success(), "{same:?}");
}

#[test]
fn a_sweep_of_a_faulty_deck_runs_nothing() {
    let place = place();
    let words = ["sweep", "deck.toml", "--vary", "mu=0.1,-0.2", "--out", "s"];
    let output = striae(place.path(), &words);
    assert_eq!(output.status.code(), Some(2));
    let said = stderr(&output);
    assert!(
        said.contains("deck.toml:") && said.contains(" but is -0.2\n"),
        "{said}"
    );
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
        stderr(&unknown).contains("its [parameters] are `depth`, `mu`, `way`"),
        "{unknown:?}"
    );
    assert!(!path.join("b").exists());
}

/// A fault that only meshes show is reported by `run` as by `check`, and nothing is written.
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
        r#"zmax", x = 0, y = 0, z = "= -depth""#,
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
    assert_eq!(faulty["faults"][0]["line"], 23);
}

/// A run that is killed before its first increment continues from its start, with the parameters
/// that were set, to the results of an uninterrupted one.
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

#[test]
fn decks_ask_for_derivatives_by_their_numbers() {
    let place = place();
    let path = "material.rubber.youngs_modulus";
    let asked = format!("{DECK}[sensitivity]\nwrt = [\"mu\", \"{path}\", \"mu\"]\n");
    fs::write(place.path().join("asked.toml"), asked).unwrap();
    let run = |words: &[&str]| {
        let output = striae(place.path(), words);
        assert!(output.status.success(), "{}", stderr(&output));
    };
    run(&[
        "run",
        "deck.toml",
        "--out",
        "told",
        "--wrt",
        "mu",
        "--wrt",
        path,
    ]);
    run(&["run", "asked.toml", "--out", "asked", "--wrt", "mu"]);
    for name in ["mu", path] {
        let of = |folder: &str| {
            let file = place.path().join(folder);
            fs::read_to_string(file.join(format!("sensitivity-{name}.csv"))).unwrap()
        };
        assert_eq!(of("asked"), of("told"));
        assert_eq!(of("asked").lines().count(), 4);
    }
    let misspelt = format!("{DECK}[sensitivity]\nwrt = [\"material.ruber.youngs_modulus\"]\n");
    fs::write(place.path().join("asked.toml"), &misspelt).unwrap();
    let line = misspelt.lines().count();
    for command in ["check", "run"] {
        let refused = striae(place.path(), &[command, "asked.toml"]);
        assert_eq!(refused.status.code(), Some(2));
        let said = stderr(&refused);
        let expected = format!("asked.toml:{line}:8: `material.ruber.youngs_modulus` is no number");
        assert!(said.contains(&expected), "{said}");
        assert!(said.contains("did you mean `rubber`?"), "{said}");
    }
}

#[test]
fn derivatives_are_refused_where_a_run_goes_on() {
    let place = place();
    let run = striae(place.path(), &["run", "deck.toml", "--out", "out"]);
    assert!(run.status.success(), "{}", stderr(&run));
    let step = "[[step]]\nname = \"on\"\nincrements = 1\n";
    let further = format!("{DECK}{step}[sensitivity]\nwrt = [\"mu\"]\n");
    fs::write(place.path().join("further.toml"), further).unwrap();
    let words = ["resume", "out", "--with", "further.toml", "--out", "on"];
    let refused = striae(place.path(), &words);
    assert_eq!(refused.status.code(), Some(2), "{}", stderr(&refused));
    assert!(
        stderr(&refused).contains("`[sensitivity]`"),
        "{}",
        stderr(&refused)
    );
    assert!(!place.path().join("on").exists());
}
