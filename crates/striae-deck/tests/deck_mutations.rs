//! Whatever is done to a deck, reading it ends with a deck or with faults that
//! have places; and what the schema refuses is refused.

mod deck;

use deck::{
    BASE,
    schema::{Verdict, verdict},
};
use proptest::prelude::*;
use std::path::Path;
use striae_deck::{Position, parse};

/// Something done to the tokens of a deck.
#[derive(Clone, Debug)]
enum Mutation {
    Delete(usize),
    Repeat(usize),
    Swap(usize, usize),
    Replace(usize, &'static str),
    Insert(usize, String),
    DeleteLine(usize),
    SwapLines(usize, usize),
    Cut(usize),
}

const VALUES: [&str; 18] = [
    "true",
    "-1",
    "0",
    "3",
    "2.5",
    "nan",
    "-inf",
    "1e400",
    "\"\"",
    "\"zmin\"",
    "\"upper\"",
    "\"interface\"",
    "[]",
    "{}",
    "[1, 2, 3]",
    "[[1]]",
    "2024-01-01",
    "\"\u{e9}\u{1f40d}\"",
];

fn mutation() -> impl Strategy<Value = Mutation> {
    let place = || any::<prop::sample::Index>().prop_map(|index| index.index(1 << 20));
    prop_oneof![
        place().prop_map(Mutation::Delete),
        place().prop_map(Mutation::Repeat),
        (place(), place()).prop_map(|(a, b)| Mutation::Swap(a, b)),
        (place(), prop::sample::select(&VALUES[..]))
            .prop_map(|(at, value)| Mutation::Replace(at, value)),
        (place(), ".{1,4}").prop_map(|(at, text)| Mutation::Insert(at, text)),
        place().prop_map(Mutation::DeleteLine),
        (place(), place()).prop_map(|(a, b)| Mutation::SwapLines(a, b)),
        place().prop_map(Mutation::Cut),
    ]
}

fn mutated(text: &str, mutation: &Mutation) -> String {
    if let Mutation::DeleteLine(_) | Mutation::SwapLines(..) = mutation {
        let mut lines: Vec<&str> = text.split_inclusive('\n').collect();
        if !lines.is_empty() {
            let count = lines.len();
            match mutation {
                Mutation::DeleteLine(at) => drop(lines.remove(at % count)),
                Mutation::SwapLines(a, b) => lines.swap(a % count, b % count),
                _ => unreachable!(),
            }
        }
        return lines.concat();
    }
    let mut tokens = tokens(text);
    if tokens.is_empty() {
        return String::new();
    }
    let count = tokens.len();
    match mutation {
        Mutation::Delete(at) => drop(tokens.remove(at % count)),
        // A blank keeps numbers, and with them meshes, from growing.
        Mutation::Repeat(at) => tokens[at % count] = format!("{0} {0}", tokens[at % count]),
        Mutation::Swap(a, b) => tokens.swap(a % count, b % count),
        Mutation::Replace(at, value) => tokens[at % count] = (*value).into(),
        Mutation::Insert(at, text) if !text.contains(|c: char| c.is_ascii_digit()) => {
            tokens.insert(at % count, text.clone());
        }
        Mutation::Cut(at) => tokens.truncate(at % count),
        _ => {}
    }
    tokens.concat()
}

/// Words, quoted texts and numbers as a whole, everything else by character.
fn tokens(text: &str) -> Vec<String> {
    let mut tokens: Vec<String> = Vec::new();
    let mut in_word = false;
    for c in text.chars() {
        let word = c.is_alphanumeric() || "_-.\"".contains(c);
        match tokens.last_mut() {
            Some(last) if word && in_word => last.push(c),
            _ => tokens.push(c.into()),
        }
        in_word = word;
    }
    tokens
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1500))]

    #[test]
    fn every_fault_has_a_place(mutations in prop::collection::vec(mutation(), 1..5)) {
        let text = mutations.iter().fold(BASE.to_owned(), |text, mutation| mutated(&text, mutation));
        let lines = text.split('\n').count();
        let Err(faults) = parse(&text, "deck.toml", Path::new("")) else {
            prop_assert_eq!(verdict(&text), Verdict::Accepted);
            return Ok(());
        };
        prop_assert!(faults.iter().len() > 0);
        let places: Vec<Position> = faults.iter().filter_map(|fault| fault.position).collect();
        prop_assert_eq!(places.len(), faults.iter().len());
        prop_assert!(places.iter().all(|place| (1..=lines).contains(&place.line) && place.column >= 1));
        prop_assert!(places.is_sorted());
        let shown = faults.to_string();
        prop_assert!(faults.iter().take(50).all(|fault| shown.contains(&fault.to_string())));
    }
}
