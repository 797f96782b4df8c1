//! Openings of documentation: a noun, or a verb in the third person.
//!
//! Paragraphs of Rust doc comments, Python docstrings and the comments `#:` of Python attributes
//! must not open with a question word or a pronoun of [`REFUSED`]: these leave the reader to find
//! the subject elsewhere.

use std::path::Path;

use crate::breach::Breach;

/// Words that no paragraph may open with.
const REFUSED: [&str; 15] = [
    "What", "Whether", "Who", "Whose", "How", "Where", "Which", "Why", "The same", "That", "Those",
    "This", "These", "It", "They",
];

/// Paragraphs of a source file, Rust or Python, that open with a refused word.
pub fn breaches(path: &Path, text: &str) -> Vec<Breach> {
    let is_rust = path.extension().is_some_and(|extension| extension == "rs");
    let openings = if is_rust { rust(text) } else { python(text) };
    let refused = openings.into_iter().filter_map(|(number, opening)| {
        let word = REFUSED.into_iter().find(|word| opens_with(opening, word))?;
        Some(Breach {
            place: format!("{}:{number}", path.display()),
            wrong: format!(
                "documentation opens with `{word}`; start with a noun (\"Gap at ...\", `true` if \
                 ...) or a verb in the third person (\"Returns whether ...\")"
            ),
        })
    });
    refused.collect()
}

fn opens_with(opening: &str, word: &str) -> bool {
    let rest = opening.strip_prefix(word);
    rest.is_some_and(|rest| !rest.starts_with(|next: char| next.is_alphanumeric()))
}

/// First lines of paragraphs of doc comments, with their numbers from 1.
fn rust(text: &str) -> Vec<(usize, &str)> {
    let mut before = None;
    let mut found = Vec::new();
    for (line, number) in text.lines().zip(1..) {
        let line = line.trim_start();
        let marks = ["///", "//!"]
            .into_iter()
            .find(|mark| line.starts_with(mark));
        let paragraph = marks.map(|mark| (mark, line[mark.len()..].trim()));
        let paragraph = paragraph.filter(|(_, words)| !words.is_empty());
        if let Some((mark, words)) = paragraph
            && before != Some(mark)
        {
            found.push((number, words));
        }
        before = paragraph.map(|(mark, _)| mark);
    }
    found
}

/// First lines of docstrings and of comments on attributes, with their numbers from 1.
fn python(text: &str) -> Vec<(usize, &str)> {
    let opening = |line| {
        let marks = ["\"\"\"", "r\"\"\"", "#: "];
        let line = str::trim_start(line);
        marks.into_iter().find_map(|mark| line.strip_prefix(mark))
    };
    let lines = text.lines().zip(1..);
    lines
        .filter_map(|(line, number)| Some((number, opening(line)?)))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn places(path: &str, text: &str) -> Vec<String> {
        let found = breaches(Path::new(path), text);
        found.into_iter().map(|breach| breach.place).collect()
    }

    #[test]
    fn a_question_word_at_the_start_is_refused_with_its_place_and_a_remedy() {
        let text = "//! Faults.\n\n    /// Whether it holds.\n    fn holds() {}\n";
        let found = breaches(Path::new("a.rs"), text);
        let words = found.iter().map(Breach::to_string).collect::<String>();
        assert!(words.starts_with("a.rs:3: documentation opens with `Whether`; "));
        assert!(words.contains("Returns whether"), "{words}");
    }

    #[test]
    fn every_paragraph_has_an_opening_but_not_every_line() {
        let wrapped = "/// Gap at the point that tells\n/// What is meant.\n";
        assert!(places("a.rs", wrapped).is_empty());
        let paragraph = "/// Gap at a point.\n///\n/// It is positive.\n";
        assert_eq!(places("a.rs", paragraph), ["a.rs:3"]);
    }

    #[test]
    fn only_whole_words_count_and_only_in_documentation() {
        let text = "/// Whole facets.\n/// Whatever.\n// What a reader asks.\n";
        assert!(places("a.rs", text).is_empty());
    }

    #[test]
    fn docstrings_and_comments_on_attributes_are_read() {
        let text =
            "#: Who asks.\nA = 1\n\ndef f():\n    \"\"\"What is left.\"\"\"\n    # What else.\n";
        assert_eq!(places("a.py", text), ["a.py:1", "a.py:5"]);
        assert_eq!(places("a.pyi", text), ["a.pyi:1", "a.pyi:5"]);
    }
}
