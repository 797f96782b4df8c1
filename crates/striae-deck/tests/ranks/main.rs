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
