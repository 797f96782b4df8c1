//! Wear of pairs in decks: its meaning, its faults, and what a run writes of it.

mod deck;

use deck::BASE;
use std::path::Path;
use striae_deck::{parse, write};
use striae_output::Output;

const FRICTION: &str = "friction = { law = \"coulomb\", mu = 0.3 }\n";

/// The deck with another pair between its blocks.
fn with(keys: &str) -> String {
    let text = BASE.replacen(FRICTION, &format!("{FRICTION}{keys}\n"), 1);
    assert_ne!(text, BASE);
    text
}

/// The deck with a pair of the rigid plane and the lower block before its own.
fn on_floor(keys: &str) -> String {
    let pair = format!(
        "[[pair]]\nname = \"ground\"\na = {{ rigid = \"floor\" }}\n\
         b = {{ body = \"lower\", facets = \"zmin\" }}\n{FRICTION}{keys}\n[[pair]]\n"
    );
    BASE.replacen("[[pair]]\n", &pair, 1)
}

fn wear(text: &str) -> [f64; 2] {
    let model = parse(text, "deck.toml", Path::new("")).unwrap_or_else(|faults| panic!("{faults}"));
    model.model.pairs[0].wear
}

fn refused(text: &str) -> String {
    parse(text, "deck.toml", Path::new(""))
        .unwrap_err()
        .to_string()
}

#[test]
fn one_number_is_that_of_all_deformable_sides() {
    assert_eq!(wear(BASE), [0.0; 2]);
    assert_eq!(wear(&with("wear = 1e-8")), [1e-8; 2]);
    assert_eq!(wear(&with("wear = { a = 1e-8, b = 2e-8 }")), [1e-8, 2e-8]);
    assert_eq!(wear(&with("wear = { b = 2e-8 }")), [0.0, 2e-8]);
    // The rigid surface becomes side `b`.
    assert_eq!(wear(&on_floor("wear = 1e-8")), [1e-8, 0.0]);
    assert_eq!(wear(&on_floor("wear = { b = 2e-8 }")), [2e-8, 0.0]);
}

#[test]
fn wear_is_written_as_it_is_read() {
    let text = with("wear = { a = 1.5e-8, b = 2e-8 }");
    let model = parse(&text, "deck.toml", Path::new("")).unwrap().model;
    let written = write(&model, &Output::default()).unwrap();
    assert!(
        written.contains("wear = { a = 1.5e-8, b = 2e-8 }"),
        "{written}"
    );
    assert_eq!(wear(&written), [1.5e-8, 2e-8]);
    let without = parse(BASE, "deck.toml", Path::new("")).unwrap().model;
    let written = write(&without, &Output::default()).unwrap();
    assert!(!written.contains("wear"), "{written}");
}

#[test]
fn a_ratio_is_that_of_wear_across_a_texture() {
    let side = "facets = \"zmax\"";
    let textured = format!("{side}, texture = {{ uniform = [1, 0, 0] }}");
    let text = with("wear = 1e-8\nwear_across = 2.5").replacen(side, &textured, 1);
    let model = parse(&text, "deck.toml", Path::new("")).unwrap().model;
    assert_eq!(model.pairs[0].wear_across, 2.5);
    let written = write(&model, &Output::default()).unwrap();
    assert!(written.contains("wear_across = 2.5"), "{written}");
    let other = "facets = \"zmin\"";
    let both = text.replacen(
        other,
        &format!("{other}, texture = {{ uniform = [1, 0, 0] }}"),
        1,
    );
    let said = refused(&both);
    assert!(said.contains("both sides have a texture"), "{said}");
    let said = refused(&with("wear_across = 2.5"));
    assert!(said.contains("but no `wear`"), "{said}");
}

#[test]
fn what_cannot_wear_is_named_with_its_place() {
    for (text, what) in [
        (with("wear = -1e-8"), "at least 0"),
        (with("wear = { a = inf }"), "wear"),
        (
            on_floor("wear = { a = 1e-8, b = 2e-8 }"),
            "deformable side alone",
        ),
        (
            with("wear = 1e-8\nenforcement = \"collocated\""),
            "remove one of the settings",
        ),
        (with("wear_across = -2.0\nwear = 1e-8"), "greater than 0"),
        (
            on_floor("wear_across = 2.0\nwear = 1e-8"),
            "give one a `texture`",
        ),
        (
            with("wear = 1e-8").replacen(FRICTION, "", 1),
            "State a friction law",
        ),
    ] {
        let said = refused(&text);
        assert!(said.contains(what), "{said}");
        let line = 1 + text.lines().position(|line| line.contains("wear")).unwrap();
        assert!(
            said.contains(&format!("deck.toml:{line}:")),
            "{line}: {said}"
        );
    }
    for (stated, what) in [
        ("wear = 1e-8", "has no `wear`"),
        ("initial = \"close\"", "closes no gaps"),
    ] {
        let itself = with(stated).replacen(
            "b = { body = \"upper\", facets = \"zmin\" }",
            "b = \"itself\"",
            1,
        );
        let said = refused(&itself);
        assert!(said.contains(what), "{said}");
    }
}
