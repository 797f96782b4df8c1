//! Commands that messages propose, as a shell takes them.

use std::path::Path;

/// Letters beside those of words that no shell takes for its own.
const PLAIN: &str = "/._-+,:@%=";

/// A path as one word of a POSIX shell.
pub fn word(path: &Path) -> String {
    let text = path.display().to_string();
    let is_plain = |letter: char| {
        letter.is_alphanumeric() || PLAIN.contains(letter) || cfg!(windows) && letter == '\\'
    };
    match !text.is_empty() && text.chars().all(is_plain) {
        true => text,
        false => format!("'{}'", text.replace('\'', r"'\''")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_are_one_word() {
        for (path, expected) in [
            (
                "results/pad-sweep/mu=0.1,L=20",
                "results/pad-sweep/mu=0.1,L=20",
            ),
            ("Prüfung/deck.toml", "Prüfung/deck.toml"),
            ("two words", "'two words'"),
            ("e \"q\"", "'e \"q\"'"),
            ("it's", r"'it'\''s'"),
            ("$HOME", "'$HOME'"),
        ] {
            assert_eq!(word(Path::new(path)), expected);
        }
    }
}
