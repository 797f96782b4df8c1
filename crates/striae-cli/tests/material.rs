//! `striae material` from outside: numbers, files and refused arguments.

use std::{fs, process::Command};

const DECK: &str = r#"
title = "Two bodies of rubber"

[[material]]
name = "rubber"
law = "mooney-rivlin"
c10 = 0.2
c01 = -0.02
poissons_ratio = 0.4999

[[body]]
name = "one"
material = "rubber"
mesh = { generator = "block", size = [1, 1, 1], divisions = [1, 1, 1] }

[[body]]
name = "two"
material = "rubber"
mesh = { generator = "block", origin = [2, 0, 0], size = [1, 1, 1], divisions = [1, 1, 1] }

[[step]]
name = "rest"
displacement = [
    { body = "one", nodes = "all", x = 0, y = 0, z = 0 },
    { body = "two", nodes = "all", x = 0, y = 0, z = 0 },
]
"#;

#[test]
fn materials_are_drawn_once_with_their_range_of_stability() {
    let folder = tempfile::tempdir().expect("a folder");
    let deck = folder.path().join("deck.toml");
    fs::write(&deck, DECK).expect("a deck");
    let output = Command::new(env!("CARGO_BIN_EXE_striae"))
        .args(["material", "deck.toml", "--out", "made"])
        .current_dir(folder.path())
        .output()
        .expect("the program");
    let said = String::from_utf8(output.stdout).expect("text");
    assert!(output.status.success(), "{said}");
    let lines: Vec<&str> = said.lines().collect();
    assert!(
        lines[0].starts_with("body `one`: Mooney-Rivlin; at rest E = 1.0799"),
        "{said}"
    );
    // Equibiaxial tension is neutral at the stretch 2.249 of the incompressible solid.
    let equibiaxial: Vec<&str> = lines[3].split_whitespace().collect();
    assert_eq!(equibiaxial[0], "equibiaxial");
    let last: f64 = equibiaxial[6].parse().expect("a number");
    assert!((last - 2.249).abs() < 0.02, "{said}");
    assert!(said.contains("body `two`: as body `one`"), "{said}");
    for end in ["svg", "png", "csv"] {
        let file = folder.path().join(format!("made/material-one.{end}"));
        assert!(file.exists(), "{}", file.display());
    }
}

/// Files are named by bodies, with what file systems do not take spelled out.
#[test]
fn any_name_of_a_body_gives_a_file() {
    let folder = tempfile::tempdir().expect("a folder");
    let deck = DECK.replace("\"one\"", "\"../one\"");
    fs::write(folder.path().join("deck.toml"), deck).expect("a deck");
    let output = Command::new(env!("CARGO_BIN_EXE_striae"))
        .args(["material", "deck.toml", "--out", "made"])
        .current_dir(folder.path())
        .output()
        .expect("the program");
    assert!(output.status.success(), "{output:?}");
    let file = folder.path().join("made/material-%2E.%2Fone.svg");
    assert!(file.exists(), "{output:?}");
}

#[test]
fn stretches_on_the_wrong_side_are_refused() {
    let output = Command::new(env!("CARGO_BIN_EXE_striae"))
        .args(["material", "deck.toml", "--to", "0.9"])
        .output()
        .expect("the program");
    assert_eq!(output.status.code(), Some(2));
    let said = String::from_utf8(output.stderr).expect("text");
    assert!(said.contains("it must be a number above 1"), "{said}");
}
