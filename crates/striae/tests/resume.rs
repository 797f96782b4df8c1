//! A run that goes on from a checkpoint gives the same files as one that did not stop.

use std::{fs, path::Path, process::Command};

/// Two blocks, pressed, then slid with inertia; the last checkpoint is in the middle.
const DECK: &str = r#"
title = "Two blocks"

[[material]]
name = "solid"
law = "neo-hookean"
youngs_modulus = 1e6
poissons_ratio = 0.3
density = 1000

[[body]]
name = "lower"
material = "solid"
mesh = { generator = "block", size = [1, 1, 0.5], divisions = [4, 4, 1] }

[[body]]
name = "upper"
material = "solid"
mesh = { generator = "block", origin = [0.2, 0.2, 0.5], size = [0.6, 0.6, 0.5], divisions = [3, 3, 1] }

[[rigid]]
name = "plate"
tied = [{ body = "upper", nodes = "zmax" }]

[[pair]]
name = "interface"
a = { body = "lower", facets = "zmax" }
b = { body = "upper", facets = "zmin" }
friction = { law = "coulomb", mu = 0.3 }

[[step]]
name = "press"
increments = 2
displacement = [{ body = "lower", nodes = "zmin", x = 0, y = 0, z = 0 }]
rigid = [{ surface = "plate", displacement = [0, 0, -0.02] }]

[[step]]
name = "slide"
increments = 6
dynamics = {}
rigid = [{ surface = "plate", displacement = [0.3, 0, -0.02], free = ["y"], curve = "smooth" }]

[output]
checkpoint_every = 5
"#;

fn striae(folder: &Path, arguments: &[&str]) -> std::process::Output {
    let program = env!("CARGO_BIN_EXE_striae");
    let mut command = Command::new(program);
    command
        .args(arguments)
        .current_dir(folder)
        .output()
        .unwrap()
}

#[test]
fn goes_on_to_the_last_bit() {
    let folder = tempfile::tempdir().unwrap();
    let place = folder.path();
    fs::write(place.join("blocks.toml"), DECK).unwrap();
    let whole = striae(place, &["run", "blocks.toml", "--quiet"]);
    assert!(whole.status.success(), "{whole:?}");
    let results = place.join("results/blocks");
    let read = |name: &str| fs::read(results.join(name)).unwrap();
    let names = [
        "history.csv",
        "bodies.pvd",
        "contact.pvd",
        "fields/upper-00008.vtu",
    ];
    let before = names.map(read);
    // As if the run had stopped after the checkpoint.
    fs::remove_file(results.join("fields/upper-00008.vtu")).unwrap();
    let resumed = striae(place, &["resume", "results/blocks", "--quiet"]);
    assert!(resumed.status.success(), "{resumed:?}");
    for (name, before) in names.into_iter().zip(before) {
        assert!(
            fs::read(results.join(name)).unwrap() == before,
            "{name} differs"
        );
    }
    let rows = String::from_utf8(fs::read(results.join("history.csv")).unwrap()).unwrap();
    assert!(rows.lines().count() > 6, "the checkpoint is not at the end");
}

#[test]
fn refuses_what_it_cannot_go_on_with() {
    let folder = tempfile::tempdir().unwrap();
    let place = folder.path();
    let none = striae(place, &["resume", "nowhere"]);
    assert_eq!(none.status.code(), Some(1));
    fs::write(place.join("blocks.toml"), DECK).unwrap();
    assert!(
        striae(place, &["run", "blocks.toml", "--quiet"])
            .status
            .success()
    );
    let changed = DECK.replace("mu = 0.3", "mu = 0.2");
    fs::write(place.join("blocks.toml"), changed).unwrap();
    let refused = striae(place, &["resume", "results/blocks"]);
    assert_eq!(refused.status.code(), Some(2), "{refused:?}");
    let message = String::from_utf8(refused.stderr).unwrap();
    assert!(
        message.contains("has changed since the checkpoint"),
        "{message}"
    );
    fs::write(place.join("results/blocks/checkpoint.bin"), "no").unwrap();
    let broken = striae(place, &["resume", "results/blocks"]);
    let message = String::from_utf8(broken.stderr).unwrap();
    assert!(
        message.contains("not a checkpoint of this version"),
        "{message}"
    );
}
