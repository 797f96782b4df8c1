//! Configurations that cannot be tied, and their messages.

use std::path::Path;

use striae::{
    deck,
    model::{Fault, FaultKind, tie::TieFault},
    prelude::*,
};

use super::scene::{halves, pull, rubber, tie, tied};

const START: &str = r#"
title = "Two blocks"
[[material]]
name = "rubber"
law = "neo-hookean"
youngs_modulus = 1e6
poissons_ratio = 0.3
[[body]]
name = "lower"
material = "rubber"
mesh = { generator = "block", size = [1, 1, 0.5], divisions = [4, 4, 2] }
[[step]]
name = "hold"
displacement = [
    { body = "lower", nodes = "zmin", x = 0, y = 0, z = 0 },
    { body = "upper", nodes = "zmax", x = 0, y = 0, z = 0 },
]
"#;

/// The words that meet a deck with the upper block at a height, and ties.
fn words_at(height: f64, ties: &str) -> String {
    let upper = format!(
        r#"
[[body]]
name = "upper"
material = "rubber"
mesh = {{ generator = "block", origin = [0, 0, {height}], size = [1, 1, 0.5], divisions = [3, 3, 2] }}
"#
    );
    let deck = format!("{START}{upper}{ties}");
    let read = deck::parse(&deck, "deck.toml", Path::new(""));
    read.err()
        .map_or_else(String::new, |faults| faults.to_string())
}

const GLUE: &str = r#"
[[tie]]
name = "glue"
a = { body = "lower", facets = "zmax" }
b = { body = "upper", facets = "zmin" }
"#;

#[test]
fn what_is_well_meets_no_words() {
    assert_eq!(words_at(0.5, GLUE), "");
    // Up to a tenth of the facet size is closed, and any gap that is allowed.
    assert_eq!(words_at(0.52, GLUE), "");
    assert_eq!(words_at(0.9, &format!("{GLUE}within = 0.41\n")), "");
}

#[test]
fn faults_of_decks_say_what_to_do() {
    let twice = format!("{GLUE}{}", GLUE.replace("glue", "paste"));
    let named_twice = format!("{GLUE}{GLUE}");
    let pair = r#"
[[pair]]
name = "contact"
a = { body = "upper", facets = "zmin" }
b = { body = "lower", facets = "zmax" }
"#;
    let pair = format!("{GLUE}{pair}");
    let cases: [(f64, &str, &[&str]); 11] = [
        (
            0.5,
            &GLUE.replace("\"upper\"", "\"uper\""),
            &["no body is named `uper`", "did you mean `upper`?"],
        ),
        (
            0.5,
            &GLUE.replace("zmin", "bottom"),
            &["has no facet set `bottom`"],
        ),
        (
            0.5,
            &GLUE.replace("body = \"upper\"", "rigid = \"upper\""),
            &["rigid"],
        ),
        (
            0.5,
            &GLUE.replace("body = \"upper\"", "body = \"lower\""),
            &["joins body `lower` to itself", "two bodies"],
        ),
        (0.5, &format!("{GLUE}within = -1\n"), &["within"]),
        (0.5, &format!("{GLUE}gap = 1\n"), &["gap"]),
        (0.5, &named_twice, &["tie `glue` is already defined"]),
        (
            0.5,
            &twice,
            &["tie `paste` joins facets that tie `glue` already joins"],
        ),
        (
            0.5,
            &pair,
            &["pair `contact`, which lets them slide and open"],
        ),
        (
            0.6,
            GLUE,
            &[
                "`lower` and `upper` are 0.1 apart, 30 % of the facet size",
                "set `within`",
            ],
        ),
        (
            2.0,
            GLUE,
            &[
                "do not meet",
                "nearest of their nodes are 1.5 apart",
                "within",
            ],
        ),
    ];
    for (height, ties, expected) in cases {
        let words = words_at(height, ties);
        for part in expected {
            assert!(words.contains(part), "{part}\n{words}");
        }
    }
}

fn tie_fault(faults: Vec<Fault>) -> (String, TieFault) {
    match faults.as_slice() {
        [
            Fault {
                path,
                kind: FaultKind::Tie { fault },
            },
        ] => (path.to_string(), fault.clone()),
        other => panic!("{other:?}"),
    }
}

#[test]
fn ties_without_free_nodes_hold_nothing() {
    let held = pull(0.1).hold("lower", "zmax").hold("upper", "zmin");
    let faults = tied(&halves([0.0; 2])).step(held).build().unwrap_err();
    let (path, fault) = tie_fault(faults.0);
    assert_eq!(path, "ties[0]");
    assert!(
        matches!(&fault, TieFault::Loose { tie, .. } if tie == "glue"),
        "{fault}"
    );
}

#[test]
fn moves_that_turn_elements_inside_out_are_refused() {
    // A gap stretches the elements of the lower block; an overlap presses them out.
    let [mut lower, upper] = halves([0.0; 2]);
    (lower.size.z, lower.divisions) = (0.3, [4, 4, 30]);
    assert!(near([lower, upper]).build().is_ok());
    let [mut lower, upper] = halves([0.0; 2]);
    (lower.size.z, lower.divisions) = (0.6, [4, 4, 30]);
    let (_, fault) = tie_fault(near([lower, upper]).build().unwrap_err().0);
    assert!(
        matches!(&fault, TieFault::Inverted { body, .. } if body == "lower"),
        "{fault}"
    );
}

/// Blocks that are tied up to a distance.
fn near(blocks: [striae::mesh::generate::Block; 2]) -> striae::model::ModelBuilder {
    let [lower, upper] = blocks.map(|block| block.mesh().unwrap());
    model("Two blocks")
        .body(body("lower", lower, rubber()))
        .body(body("upper", upper, rubber()))
        .tie(tie("glue", surface("lower", "zmax"), surface("upper", "zmin")).within(0.3))
        .step(pull(0.1))
}
