//! Runs that are interrupted and taken up again, from outside: exit codes, messages, files.
#![cfg(unix)]

use std::{
    fs,
    io::{BufRead, BufReader},
    path::Path,
    process::{Command, Output, Stdio},
};

/// Cubes side by side as an Abaqus file, one pressed on the floor.
const MESH: &str = "*Node
1, 0., 0., 0.
2, 1., 0., 0.
3, 1., 1., 0.
4, 0., 1., 0.
5, 0., 0., 1.
6, 1., 0., 1.
7, 1., 1., 1.
8, 0., 1., 1.
*Element, type=C3D8
1, 1, 2, 3, 4, 5, 6, 7, 8
*Nset, nset=top
5, 6, 7, 8
*Elset, elset=all
1,
*Surface, type=ELEMENT, name=sole
all, S1
";

const DECK: &str = r#"
title = "A cube from a file, pressed and slid"

[[material]]
name = "solid"
law = "neo-hookean"
youngs_modulus = 1000
poissons_ratio = 0.3

[[body]]
name = "block"
material = "solid"
mesh = { file = "cube.inp" }

[[rigid]]
name = "floor"
plane = { point = [0, 0, 0], normal = [0, 0, 1] }

[[pair]]
name = "sole"
a = { body = "block", facets = "sole" }
b = { rigid = "floor" }
friction = { law = "coulomb", mu = 0.2, by_accumulated_slip = { form = "exponential", final_over_initial = 0.5, slip = 0.5 } }

[contact]
all = true
friction = { law = "coulomb", mu = 0.2 }

[[step]]
name = "press"
increments = 2
displacement = [{ body = "block", nodes = "top", x = 0, y = 0, z = -0.05 }]

[[step]]
name = "slide"
increments = 2000
displacement = [{ body = "block", nodes = "top", x = 2 }]

[output]
fields_every = 100
"#;

fn program(folder: &Path, arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_striae"));
    command.args(arguments).current_dir(folder);
    command
}

fn striae(folder: &Path, arguments: &[&str]) -> Output {
    program(folder, arguments).output().unwrap()
}

fn stderr(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).unwrap()
}

/// Starts the program and interrupts it after some lines of progress; what it then said.
fn interrupted(folder: &Path, arguments: &[&str], lines: usize) -> String {
    ended_by("-INT", folder, arguments, lines)
}

/// Output of a run that was ended by a signal.
fn ended_by(signal: &str, folder: &Path, arguments: &[&str], lines: usize) -> String {
    let mut command = program(folder, arguments);
    let mut child = command
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut said = BufReader::new(child.stderr.take().unwrap()).lines();
    for _ in 0..lines {
        said.next().unwrap().unwrap();
    }
    let id = child.id().to_string();
    let sent = Command::new("kill").args([signal, &id]).status().unwrap();
    assert!(sent.success());
    let last = said.map(Result::unwrap).last().unwrap();
    assert_eq!(child.wait().unwrap().code(), Some(130), "{last}");
    last
}

/// A folder with the deck, run to somewhere in the middle.
fn stopped() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("cube.inp"), MESH).unwrap();
    fs::write(folder.path().join("cube.toml"), DECK).unwrap();
    let last = interrupted(folder.path(), &["run", "cube.toml"], 5);
    assert!(last.starts_with("interrupted at time"), "{last}");
    let hint = "continue with `striae resume results/cube`";
    assert!(last.ends_with(hint), "{last}");
    folder
}

#[test]
fn interrupted_runs_give_the_files_of_uninterrupted_ones() {
    let folder = stopped();
    let place = folder.path();
    let whole = striae(place, &["run", "cube.toml", "--quiet", "--out", "whole"]);
    assert!(whole.status.success(), "{}", stderr(&whole));
    interrupted(place, &["resume", "results/cube"], 20);
    interrupted(place, &["resume", "results/cube", "--threads", "1"], 40);
    // Rows that were written after the checkpoint, the last one in part.
    let history = place.join("results/cube/history.csv");
    let rows = fs::read_to_string(&history).unwrap();
    let last = rows.lines().last().unwrap();
    fs::write(&history, format!("{rows}{last}\n{}", &last[..9])).unwrap();
    let resumed = striae(place, &["resume", "results/cube", "--quiet"]);
    assert!(resumed.status.success(), "{}", stderr(&resumed));
    for name in ["history.csv", "bodies.pvd", "contact.pvd"] {
        let [a, b] = ["whole", "results/cube"].map(|run| fs::read(place.join(run).join(name)));
        assert!(a.unwrap() == b.unwrap(), "{name} differs");
    }
    let again = striae(place, &["resume", "results/cube"]);
    assert_eq!(again.status.code(), Some(2));
    assert!(stderr(&again).contains("results/cube holds a completed run"));
}

#[test]
fn other_signals_that_end_programs_interrupt_a_run() {
    let folder = stopped();
    for signal in ["-TERM", "-HUP", "-USR1"] {
        let last = ended_by(signal, folder.path(), &["resume", "results/cube"], 3);
        assert!(last.starts_with("interrupted at time"), "{signal}: {last}");
    }
}

#[test]
fn a_run_that_cannot_go_on_leaves_where_it_came_to() {
    let folder = tempfile::tempdir().unwrap();
    let place = folder.path();
    fs::write(place.join("cube.inp"), MESH).unwrap();
    fs::write(
        place.join("cube.toml"),
        DECK.replace("z = -0.05", "z = -1.5"),
    )
    .unwrap();
    let ended = |arguments: &[&str]| {
        let output = striae(place, arguments);
        assert_eq!(output.status.code(), Some(1), "{}", stderr(&output));
        assert!(stderr(&output).contains("turned inside out"));
        let results = place.join("results/cube");
        assert!(results.join("checkpoint.bin").exists());
        let summary = fs::read_to_string(results.join("summary.json")).unwrap();
        let own = |line: &&str| !line.contains("_s\":") && !line.contains("peak_rss_mib");
        let summary: String = summary.lines().filter(own).collect();
        (
            summary,
            fs::read_to_string(results.join("history.csv")).unwrap(),
        )
    };
    let first = ended(&["run", "cube.toml"]);
    assert!(first.1.lines().count() > 2);
    // It makes the last attempt again, and comes to the same end.
    assert_eq!(ended(&["resume", "results/cube"]), first);
}

#[test]
fn a_limit_on_the_size_of_files_is_told() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("cube.inp"), MESH).unwrap();
    fs::write(folder.path().join("cube.toml"), DECK).unwrap();
    let mut command = Command::new("sh");
    command.args(["-c", "ulimit -f 8; exec \"$0\" \"$@\""]);
    command.args([env!("CARGO_BIN_EXE_striae"), "run", "cube.toml"]);
    let output = command.current_dir(folder.path()).output().unwrap();
    assert_eq!(output.status.code(), Some(1), "{}", stderr(&output));
    assert!(stderr(&output).contains("File too large"));
}

#[test]
fn results_are_overwritten_only_when_told_to() {
    let folder = stopped();
    let place = folder.path();
    let again = striae(place, &["run", "cube.toml"]);
    assert_eq!(again.status.code(), Some(2));
    let said = stderr(&again);
    assert!(said.contains("`--overwrite`"), "{said}");
    assert!(place.join("results/cube/checkpoint.bin").exists());
    let deck = DECK.replace("increments = 2000", "increments = 2");
    fs::write(place.join("cube.toml"), deck).unwrap();
    let over = striae(place, &["run", "cube.toml", "--overwrite", "--quiet"]);
    assert!(over.status.success(), "{}", stderr(&over));
    assert!(!place.join("results/cube/checkpoint.bin").exists());
    let fields = fs::read_dir(place.join("results/cube/fields")).unwrap();
    let latest = fields.map(|file| file.unwrap().file_name().into_string().unwrap());
    let number = |name: String| name.rsplit('-').next().unwrap().to_owned();
    assert_eq!(latest.map(number).max().unwrap(), "00004.vtu");
}

#[test]
fn two_runs_do_not_share_a_folder() {
    let folder = stopped();
    let place = folder.path();
    let mut first = program(place, &["resume", "results/cube"]);
    let mut first = first
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut said = BufReader::new(first.stderr.take().unwrap()).lines();
    said.next().unwrap().unwrap();
    for arguments in [
        &["resume", "results/cube"][..],
        &["run", "cube.toml", "--overwrite"],
    ] {
        let second = striae(place, arguments);
        assert_eq!(second.status.code(), Some(2));
        let text = stderr(&second);
        assert!(
            text.contains("results/cube is still being written by another run"),
            "{text}"
        );
    }
    first.kill().unwrap();
    first.wait().unwrap();
}

#[test]
fn a_reader_that_has_enough_is_no_fault() {
    let folder = tempfile::tempdir().unwrap();
    let mut command = program(folder.path(), &["schema"]);
    let mut child = command
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stdout.take());
    let output = child.wait_with_output().unwrap();
    assert_eq!(stderr(&output), "");
}

#[test]
fn what_cannot_be_gone_on_with_is_refused() {
    let folder = stopped();
    let place = folder.path();
    let results = place.join("results/cube");
    let checkpoint = fs::read(results.join("checkpoint.bin")).unwrap();
    let history = fs::read_to_string(results.join("history.csv")).unwrap();
    let with = |at: usize, byte: u8| {
        let mut bytes = checkpoint.clone();
        bytes[at] ^= byte;
        bytes
    };
    let cut = |length: usize| checkpoint[..length].to_vec();
    let middle = checkpoint.len() / 2;
    let refused = |file: &str, content: &[u8], expected: &str| {
        let path = place.join(file);
        let before = fs::read(&path).unwrap();
        fs::write(&path, content).unwrap();
        let output = striae(place, &["resume", "results/cube"]);
        fs::write(&path, before).unwrap();
        let said = stderr(&output);
        assert_eq!(output.status.code(), Some(2), "{file}: {said}");
        assert!(said.contains(expected), "{expected} in {said}");
        assert_eq!(said.trim_end().lines().count(), 1, "{said}");
    };
    let file = "results/cube/checkpoint.bin";
    refused(file, b"", "checkpoint.bin is not a checkpoint");
    refused(
        file,
        history.as_bytes(),
        "checkpoint.bin is not a checkpoint",
    );
    refused(file, &with(0, 1), "checkpoint.bin is not a checkpoint");
    let format = checkpoint[18];
    let other = format!("a checkpoint of format {}, not {format}", format ^ 64);
    refused(file, &with(18, 64), &other);
    for damaged in [
        cut(20),
        cut(30),
        cut(middle),
        with(26, 1),
        with(middle, 128),
    ] {
        refused(file, &damaged, "checkpoint.bin is damaged");
    }
    let longer = [&checkpoint[..], b"0"].concat();
    refused(file, &longer, "checkpoint.bin is damaged");
    let deck = DECK.replace("mu = 0.2", "mu = 0.3");
    refused(
        "cube.toml",
        deck.as_bytes(),
        "has changed since the run began",
    );
    let mesh = MESH.replace("7, 1., 1., 1.", "7, 1., 1., 1.01");
    refused(
        "cube.inp",
        mesh.as_bytes(),
        "has changed since the run began",
    );
    let short = history.lines().next().unwrap().to_owned() + "\n";
    let file = "results/cube/history.csv";
    refused(file, short.as_bytes(), "history.csv is damaged");
    let start = history.find('\n').unwrap() + 1;
    let changed = |at: usize, mut bytes: Vec<u8>| {
        bytes[at] ^= 1;
        bytes
    };
    let bytes = changed(start, history.clone().into_bytes());
    refused(file, &bytes, "history.csv is damaged");
    let file = "results/cube/fields/block-00000.vtu";
    let fields = fs::read(place.join(file)).unwrap();
    let bytes = changed(fields.len() / 2, fields);
    refused(file, &bytes, "block-00000.vtu is damaged");
    let nowhere = striae(place, &["resume", "nowhere"]);
    assert_eq!(nowhere.status.code(), Some(2));
    assert!(stderr(&nowhere).contains("there is no folder nowhere"));
    fs::create_dir(place.join("empty")).unwrap();
    let empty = striae(place, &["resume", "empty"]);
    assert_eq!(empty.status.code(), Some(2));
    let words = "empty has no checkpoint.bin: the run of a deck writes one every few increments";
    assert!(stderr(&empty).contains(words), "{}", stderr(&empty));
    fs::create_dir_all(place.join("early/fields")).unwrap();
    let early = striae(place, &["resume", "early"]);
    assert_eq!(early.status.code(), Some(2));
    let words = "the run has not come to its first checkpoint, or writes none";
    assert!(stderr(&early).contains(words), "{}", stderr(&early));
    // A comment changes nothing that is run.
    fs::write(place.join("cube.toml"), format!("# again\n{DECK}")).unwrap();
    interrupted(place, &["resume", "results/cube"], 3);
    fs::remove_file(place.join("cube.toml")).unwrap();
    let lost = striae(place, &["resume", "results/cube"]);
    assert_eq!(lost.status.code(), Some(2), "{}", stderr(&lost));
}
