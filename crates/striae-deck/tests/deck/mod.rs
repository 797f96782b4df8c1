//! A good deck, and what is found wrong with changed ones.

#![allow(dead_code)]

pub mod schema;

use std::path::Path;
use striae_deck as deck;

/// A deck without faults that has something of everything.
pub const BASE: &str = include_str!("base.toml");

/// Asserts the faults of the base deck after replacements that the schema sees, too.
#[track_caller]
pub fn misread(what: &str, replacements: &[(&str, &str)], expected: &[&str]) {
    let text = replaced(what, replacements);
    faulty(what, &text, expected);
    assert_eq!(schema::verdict(&text), schema::Verdict::Refused, "{what}");
}

/// Asserts the faults of the base deck after replacements with which it stays well formed.
#[track_caller]
pub fn misstated(what: &str, replacements: &[(&str, &str)], expected: &[&str]) {
    let text = replaced(what, replacements);
    faulty(what, &text, expected);
    assert_eq!(schema::verdict(&text), schema::Verdict::Accepted, "{what}");
}

/// Asserts the faults of a whole deck.
#[track_caller]
pub fn faulty(what: &str, text: &str, expected: &[&str]) {
    let faults = deck::parse(text, "deck.toml", Path::new("")).expect_err(what);
    let found: Vec<String> = faults.iter().map(ToString::to_string).collect();
    let expected: Vec<String> = expected
        .iter()
        .map(|fault| format!("deck.toml:{fault}"))
        .collect();
    assert_eq!(found, expected, "{what}");
}

#[track_caller]
fn replaced(what: &str, replacements: &[(&str, &str)]) -> String {
    replacements
        .iter()
        .fold(BASE.to_owned(), |text, (from, to)| {
            assert_eq!(
                text.matches(from).count(),
                1,
                "{what}: `{from}` must occur once"
            );
            text.replace(from, to)
        })
}
