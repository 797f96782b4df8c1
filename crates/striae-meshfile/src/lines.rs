//! A file line by line and word by word, with faults that know their line.

use super::MeshFileFault;
use std::str::{FromStr, SplitWhitespace};

/// The lines of a file that are not blank.
pub(super) struct Lines<'a> {
    lines: std::iter::Enumerate<std::str::Lines<'a>>,
    last: usize,
}

/// One line.
#[derive(Clone, Copy, Debug)]
pub(super) struct Line<'a> {
    /// Its number, from 1.
    pub(super) number: usize,
    /// Its text without white space around it.
    pub(super) text: &'a str,
}

/// The words of a line that are still to be read.
pub(super) struct Words<'a> {
    line: Line<'a>,
    words: SplitWhitespace<'a>,
}

impl<'a> Lines<'a> {
    pub(super) fn new(text: &'a str) -> Self {
        Self {
            lines: text.lines().enumerate(),
            last: 0,
        }
    }

    /// The next line, `None` at the end of the file.
    pub(super) fn next(&mut self) -> Option<Line<'a>> {
        for (index, text) in self.lines.by_ref() {
            self.last = index + 1;
            let text = text.trim();
            if !text.is_empty() {
                let number = self.last;
                return Some(Line { number, text });
            }
        }
        None
    }

    /// The next line, a fault at the end of the file.
    pub(super) fn expect(&mut self, expected: &str) -> Result<Line<'a>, MeshFileFault> {
        let line = self.next();
        line.ok_or_else(|| MeshFileFault::line(self.last, expected, "the end of the file"))
    }
}

impl<'a> Line<'a> {
    pub(super) fn words(self) -> Words<'a> {
        Words {
            line: self,
            words: self.text.split_whitespace(),
        }
    }

    /// The fault that the line is not what was expected.
    pub(super) fn fault(self, expected: &str) -> MeshFileFault {
        MeshFileFault::line(self.number, expected, quoted(self.text))
    }
}

impl<'a> Words<'a> {
    /// The next word as a value.
    pub(super) fn next<T: FromStr>(&mut self, expected: &str) -> Result<T, MeshFileFault> {
        let number = self.line.number;
        let word = self
            .words
            .next()
            .ok_or_else(|| MeshFileFault::line(number, expected, "the end of the line"))?;
        parsed(number, word, expected)
    }

    /// The next `count` words as values.
    pub(super) fn several<T: FromStr>(
        &mut self,
        count: usize,
        expected: &str,
    ) -> Result<Vec<T>, MeshFileFault> {
        (0..count).map(|_| self.next(expected)).collect()
    }
}

/// A word as a value.
pub(super) fn parsed<T: FromStr>(
    line: usize,
    word: &str,
    expected: &str,
) -> Result<T, MeshFileFault> {
    word.parse()
        .map_err(|_| MeshFileFault::line(line, expected, quoted(word)))
}

/// The text between quotation marks, cut after some forty characters.
pub(super) fn quoted(text: &str) -> String {
    const LONGEST: usize = 40;
    match text.char_indices().nth(LONGEST) {
        Some((end, _)) => format!("`{}...`", &text[..end]),
        None => format!("`{text}`"),
    }
}
