//! A good deck, and what is found wrong with changed ones.

#![allow(dead_code)]

use std::path::Path;
use striae_io::deck;

/// A deck without faults that has something of everything.
pub const BASE: &str = include_str!("base.toml");

/// Asserts the faults of the base deck after replacements.
#[track_caller]
pub fn changed(what: &str, replacements: &[(&str, &str)], expected: &[&str]) {
    let mut text = BASE.to_owned();
    for (from, to) in replacements {
        assert_eq!(
            text.matches(from).count(),
            1,
            "{what}: `{from}` must occur once"
        );
        text = text.replace(from, to);
    }
    whole(what, &text, expected);
}

/// Asserts the faults of a whole deck.
#[track_caller]
pub fn whole(what: &str, text: &str, expected: &[&str]) {
    let faults = deck::parse(text, "deck.toml", Path::new("")).expect_err(what);
    let found: Vec<String> = faults.iter().map(ToString::to_string).collect();
    let expected: Vec<String> = expected
        .iter()
        .map(|fault| format!("deck.toml:{fault}"))
        .collect();
    assert_eq!(found, expected, "{what}");
}
