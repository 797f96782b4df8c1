//! Published decks on several ranks, which are threads, against the same decks on one.

#[path = "../../../striae-solve/tests/ranks/told.rs"]
mod told;

use std::path::Path;

use striae_deck::parse;
use told::assert_same;

/// Runs a deck with some of its text replaced by something quicker.
fn run(text: &str, quicker: &[(&str, &str)]) {
    let mut text = text.to_owned();
    for (slow, quick) in quicker {
        assert!(text.contains(slow), "{slow}");
        text = text.replace(slow, quick);
    }
    let mut model = parse(&text, "deck.toml", Path::new("")).unwrap().model;
    model.solver.tolerance = 1e-11;
    let told = assert_same(&model);
    assert_eq!(told.ending, "all steps completed");
}

macro_rules! deck {
    ($path:literal) => {
        include_str!(concat!("../../../../cases/", $path, ".toml"))
    };
}

#[test]
fn patch_frictionless() {
    run(deck!("patch-frictionless/three-to-four-lower-finer"), &[]);
}

#[test]
fn patch_stick() {
    run(deck!("patch-stick/four-to-three"), &[]);
}

#[test]
fn two_blocks() {
    run(deck!("two-blocks/deck"), &[]);
}

#[test]
fn hertz_mindlin() {
    let coarse = (
        "element_size = 0.8, fine_half",
        "element_size = 1.6, fine_half",
    );
    let fewer = ("increments = 10", "increments = 3");
    run(deck!("hertz-mindlin/deck"), &[coarse, fewer]);
}

#[test]
fn tyre_rolling() {
    let coarse = ("divisions = [4, 90, 6]", "divisions = [2, 30, 3]");
    let press = ("increments = 10", "increments = 4");
    let roll = (
        "duration = 0.45\nincrements = 90",
        "duration = 0.045\nincrements = 9",
    );
    let way = ("displacement = [0.9, 0", "displacement = [0.09, 0");
    run(deck!("tyre-rolling/deck"), &[coarse, press, roll, way]);
}

#[test]
fn bar_impact() {
    let short = (
        "duration = 3\nincrements = 300",
        "duration = 0.3\nincrements = 30",
    );
    run(deck!("bar-impact/deck"), &[short]);
}

#[test]
fn functions_and_forces_at_nodes() {
    let deck = r#"
title = "a shaken block under forces that vary"
[[material]]
name = "elastic"
law = "neo-hookean"
youngs_modulus = 100
poissons_ratio = 0.3
density = 1e-2
[[body]]
name = "block"
material = "elastic"
mesh = { generator = "block", size = [3, 1, 1], divisions = [9, 3, 3] }
[[curve]]
name = "beat"
points = [[0, 0], [0.1, 1], [0.3, 0]]
period = 0.3
time = "run"
[[step]]
name = "shake"
duration = 0.4
increments = 4
dynamics = {}
displacement = [{ body = "block", nodes = "zmin", x = "0.01*sin(5*t)*(1 + y)", y = 0, z = 0 }]
force = [{ body = "block", nodes = "zmax", total = [0, "0.1*x*t", 0.2], curve = "beat" }]
pressure = [{ body = "block", facets = "xmax", value = "0.5*z*t" }]
traction = [{ body = "block", facets = "zmax", vector = [0.1, "0.1*y", 0], direction = "follower" }]
"#;
    run(deck, &[]);
}
