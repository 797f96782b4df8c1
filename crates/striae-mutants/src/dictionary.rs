//! Words of a format, for libFuzzer to put into inputs.

use std::{collections::BTreeSet, fmt::Write};

use crate::{
    mutation::{VALUES, tokens},
    target::{Sample, Target, schema},
};

/// Lengths of words.
const LENGTHS: std::ops::RangeInclusive<usize> = 2..=40;

/// A dictionary in the form of libFuzzer: the words of some files and the values of mutants.
pub fn dictionary(target: Target, samples: &[Sample]) -> String {
    let keys = match target {
        Target::Deck => schema(),
        _ => Vec::new(),
    };
    let texts = samples.iter().map(|sample| &sample.bytes[..]);
    let words = texts.chain([&keys[..]]).flat_map(tokens);
    let words = words.map(|word| word.trim_ascii().to_vec());
    let words = words.filter(|word| word[..].first().is_some_and(is_letter));
    let values = VALUES.iter().map(|value| value.as_bytes().to_vec());
    let all: BTreeSet<Vec<u8>> = words.chain(values).collect();
    let all = all.iter().filter(|word| LENGTHS.contains(&word.len()));
    all.map(|word| format!("{}\n", quoted(word))).collect()
}

fn is_letter(byte: &u8) -> bool {
    byte.is_ascii_alphabetic() || b"$*\"".contains(byte)
}

fn quoted(word: &[u8]) -> String {
    let mut text = String::from("\"");
    for &byte in word {
        match byte {
            b'"' | b'\\' => write!(text, "\\{}", char::from(byte)),
            b' '..=b'~' => write!(text, "{}", char::from(byte)),
            _ => write!(text, "\\x{byte:02X}"),
        }
        .expect("a string takes what is written");
    }
    text + "\""
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_are_those_of_the_files_with_what_libfuzzer_cannot_read_escaped() {
        let sample = Target::Stl.sample(b"solid 7 a\\b \"n\xe9\"\n");
        let text = dictionary(Target::Stl, &[sample]);
        assert!(text.lines().any(|line| line == "\"solid\""), "{text}");
        assert!(
            text.lines().any(|line| line == "\"\\\"n\\xE9\\\"\""),
            "{text}"
        );
        assert!(!text.lines().any(|line| line == "\"7\""), "{text}");
    }

    #[test]
    fn keys_of_decks_are_words() {
        let text = dictionary(Target::Deck, &[]);
        assert!(text.contains("poissons_ratio"), "{text}");
    }
}
