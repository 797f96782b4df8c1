//! Damage to bytes: tokens, lines and numbers of texts, bytes and words of binary files.
//!
//! ```text
//! token   left out, repeated, exchanged, replaced by a value, a number scaled
//! line    left out, repeated, exchanged, moved, taken from another file
//! byte    changed, left out, put in, a word of 4 or 8 bytes replaced
//! ```

use crate::random::Random;

/// Form of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// Lines of text.
    Text,
    /// Bytes, perhaps with some text between.
    Binary,
}

impl Form {
    /// The form of a file: texts have no control characters.
    pub fn of(bytes: &[u8]) -> Self {
        let control = |byte: &u8| *byte < 0x20 && !byte.is_ascii_whitespace();
        match bytes.iter().any(control) {
            true => Self::Binary,
            false => Self::Text,
        }
    }
}

/// Values that take the place of others.
pub(crate) const VALUES: [&str; 50] = [
    "true",
    "-1",
    "0",
    "1",
    "2",
    "3",
    "2.5",
    "-0.0",
    "1e-30",
    "1e-9",
    "1e9",
    "1e30",
    "-1e30",
    "nan",
    "inf",
    "-inf",
    "1e308",
    "1e-320",
    "1e400",
    "255",
    "65536",
    "999999",
    "1000000",
    "2147483647",
    "2147483648",
    "-2147483649",
    "4294967295",
    "4294967296",
    "9223372036854775807",
    "-9223372036854775808",
    "18446744073709551615",
    "18446744073709551616",
    "0x10",
    "\"\"",
    "\"zmin\"",
    "\"zmax\"",
    "\"all\"",
    "\"block\"",
    "[]",
    "{}",
    "[0, 0, 0]",
    "[1, 2, 3]",
    "[999999, 999999, 999999]",
    "[nan, 0, 0]",
    "[[1]]",
    "2024-01-01",
    "\"\u{e9}\u{1f40d}\"",
    "\u{0}",
    "\"E*0.5\"",
    ",",
];

/// Words of a binary file that take the place of others.
const WORDS: [[u8; 8]; 12] = [
    [0; 8],
    [0xff; 8],
    [1, 0, 0, 0, 0, 0, 0, 0],
    [0, 0, 0, 1, 0, 0, 0, 0],
    [0xff, 0xff, 0xff, 0x7f, 0, 0, 0, 0],
    [0, 0, 0, 0x80, 0, 0, 0, 0],
    [0, 0, 0, 0, 1, 0, 0, 0],
    [0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0x7f],
    [0, 0, 0, 0, 0, 0, 0xf0, 0x7f],
    [0, 0, 0, 0, 0, 0, 0xf8, 0x7f],
    [0, 0, 0xc0, 0x7f, 0, 0, 0xc0, 0x7f],
    [0x99, 0x76, 0x96, 0x7e, 0x99, 0x76, 0x96, 0x7e],
];

/// A file after one to five pieces of damage; `other` is one of the same kind. Of every other
/// file only one or two numbers are changed, so that many are read to the end.
pub fn mutated(bytes: &[u8], other: &[u8], form: Form, random: &mut Random) -> Vec<u8> {
    let mut bytes = bytes.to_vec();
    if random.once_in(2) {
        let count = 1 + random.below(2);
        return (0..count).fold(bytes, |bytes, _| in_numbers(&bytes, random));
    }
    let count = 1 + random.below(5).min(random.below(5));
    for _ in 0..count {
        bytes = match (form, random.below(8)) {
            (Form::Text, 0..5) | (Form::Binary, 0..2) => in_tokens(&bytes, random),
            (Form::Text, 5..7) | (Form::Binary, 2) => in_lines(&bytes, other, random),
            _ => in_bytes(bytes, random),
        };
    }
    bytes
}

fn in_tokens(bytes: &[u8], random: &mut Random) -> Vec<u8> {
    let mut tokens: Vec<Vec<u8>> = tokens(bytes);
    let words: Vec<usize> = (0..tokens.len())
        .filter(|at| is_word(tokens[*at][0]))
        .collect();
    if words.is_empty() {
        return bytes.to_vec();
    }
    let at = match random.once_in(5) {
        true => random.below(tokens.len()),
        false => *random.pick(&words),
    };
    match random.below(10) {
        0 => tokens[at].clear(),
        // A blank keeps numbers, and with them meshes, from growing.
        1 => tokens[at] = [&tokens[at][..], b" ", &tokens[at][..]].concat(),
        2 | 3 => tokens.swap(at, *random.pick(&words)),
        4 => tokens[at] = tokens[*random.pick(&words)].clone(),
        5 => tokens[at] = scaled(&tokens[at], random),
        _ => tokens[at] = random.pick(&VALUES).as_bytes().to_vec(),
    }
    tokens.concat()
}

/// Numbers that take the place of others of the same kind.
const NUMBERS: [&str; 12] = [
    "0", "1", "2", "3", "-1", "0.5", "1e-6", "1e6", "-0.1", "100", "1e-12", "1e12",
];

/// Changes a number to another one.
fn in_numbers(bytes: &[u8], random: &mut Random) -> Vec<u8> {
    let mut tokens = tokens(bytes);
    let is_number = |token: &[u8]| str::from_utf8(token).is_ok_and(|t| t.parse::<f64>().is_ok());
    let numbers: Vec<usize> = (0..tokens.len())
        .filter(|at| is_number(&tokens[*at]))
        .collect();
    if numbers.is_empty() {
        return bytes.to_vec();
    }
    let at = *random.pick(&numbers);
    match random.below(4) {
        0 => tokens[at] = random.pick(&NUMBERS).as_bytes().to_vec(),
        1 => tokens[at] = tokens[*random.pick(&numbers)].clone(),
        _ => tokens[at] = scaled(&tokens[at], random),
    }
    tokens.concat()
}

/// A number of another size or sign; what is no number stays.
fn scaled(token: &[u8], random: &mut Random) -> Vec<u8> {
    let text = String::from_utf8_lossy(token);
    let factor = *random.pick(&[-1.0, 0.5, 2.0, 10.0, 0.1, 1e3, 1e-3, 1e6, 1e-6, 0.0]);
    if let Ok(number) = text.parse::<i64>() {
        return ((number as f64 * factor) as i64).to_string().into_bytes();
    }
    match text.parse::<f64>() {
        Ok(number) => format!("{:?}", number * factor).into_bytes(),
        Err(_) => token.to_vec(),
    }
}

/// Words, quoted texts and numbers as a whole, everything else by byte.
pub(crate) fn tokens(bytes: &[u8]) -> Vec<Vec<u8>> {
    let mut tokens: Vec<Vec<u8>> = Vec::new();
    let mut in_word = false;
    for &byte in bytes {
        match tokens.last_mut() {
            Some(last) if in_word && is_word(byte) => last.push(byte),
            _ => tokens.push(vec![byte]),
        }
        in_word = is_word(byte);
    }
    tokens
}

fn is_word(byte: u8) -> bool {
    byte.is_ascii_alphanumeric() || b"_-.+\"$*".contains(&byte) || byte >= 0x80
}

fn in_lines(bytes: &[u8], other: &[u8], random: &mut Random) -> Vec<u8> {
    let mut lines: Vec<&[u8]> = bytes.split_inclusive(|byte| *byte == b'\n').collect();
    if lines.is_empty() {
        return other.to_vec();
    }
    let at = random.below(lines.len());
    let to = random.below(lines.len());
    match random.below(6) {
        0 => drop(lines.remove(at)),
        1 => lines.insert(to, lines[at]),
        2 => lines.swap(at, to),
        3 => {
            let line = lines.remove(at);
            lines.insert(to.min(lines.len()), line);
        }
        4 => lines.truncate(at),
        _ => {
            let others: Vec<&[u8]> = other.split_inclusive(|byte| *byte == b'\n').collect();
            if !others.is_empty() {
                let from = random.below(others.len());
                let count = 1 + random.below(4);
                for line in others[from..].iter().take(count).rev() {
                    lines.insert(to, line);
                }
            }
        }
    }
    lines.concat()
}

fn in_bytes(mut bytes: Vec<u8>, random: &mut Random) -> Vec<u8> {
    if bytes.is_empty() {
        return vec![random.bits() as u8];
    }
    let at = random.below(bytes.len());
    let end = (at + 1 + random.below(16)).min(bytes.len());
    match random.below(7) {
        0 => bytes[at] = random.bits() as u8,
        1 => bytes[at] ^= 1 << random.below(8),
        2 => drop(bytes.drain(at..end)),
        3 => bytes.insert(at, random.bits() as u8),
        4 => {
            let copy = bytes[at..end].to_vec();
            bytes.splice(at..at, copy);
        }
        _ => {
            let word = random.pick(&WORDS);
            let length = *random.pick(&[4, 8]);
            let end = (at + length).min(bytes.len());
            bytes[at..end].copy_from_slice(&word[..end - at]);
        }
    }
    bytes
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_seed_gives_the_same_mutant_and_others_differ() {
        let text = b"size = [1, 2, 3]\nname = \"block\"\n";
        let of = |seed| mutated(text, b"x = 1\n", Form::Text, &mut Random::new(seed));
        assert_eq!(of(7), of(7));
        let changed = (0..200).filter(|seed| of(*seed) != text).count();
        assert!(changed > 150, "{changed}");
    }

    #[test]
    fn tokens_are_the_text() {
        let text = b"a = [1e-3, \"b\"]\n";
        assert_eq!(tokens(text).concat(), text);
        assert_eq!(tokens(text)[5], b"1e-3");
    }
}
