//! The keywords of an Abaqus file with their parameters and rows.

use super::super::MeshFileFault;
use super::super::lines::{Line, Lines};

/// `*NAME, PARAMETER=value, ...` and the rows that follow.
pub struct Keyword<'a> {
    /// Line of the text in which it stands, see [`InputFile::place`](super::InputFile::place).
    pub line: usize,
    text: &'a str,
    /// In capitals, words parted by one space.
    pub name: String,
    /// In capitals with the value, empty without one.
    parameters: Vec<(String, &'a str)>,
    /// The rows below it.
    pub rows: Vec<Row<'a>>,
}

/// A row of words that were parted by commas, never empty.
#[derive(Clone)]
pub struct Row<'a> {
    /// Line of the text in which it stands.
    pub line: usize,
    /// The words, without white space around them.
    pub words: Vec<&'a str>,
    /// Record of whether a comma ends the row, so that the next one continues it.
    continued: Continued,
}

#[derive(Clone, Copy, PartialEq)]
enum Continued {
    Here,
    OnNextLine,
}

/// All keywords of a file.
pub(super) fn keywords(text: &str) -> Result<Vec<Keyword<'_>>, MeshFileFault> {
    let mut lines = Lines::new(text);
    let mut keywords: Vec<Keyword<'_>> = Vec::new();
    while let Some(line) = lines.next() {
        if line.text.starts_with("**") {
            continue;
        }
        if line.text.starts_with('*') {
            let mut keyword = Keyword::new(line);
            let mut last = line;
            while last.text.ends_with(',') {
                last = lines.expect("more parameters")?;
                keyword.add_parameters(last.text);
            }
            keywords.push(keyword);
        } else if let Some(keyword) = keywords.last_mut() {
            keyword.rows.push(Row::new(line));
        } else if !line.text.contains("**") {
            // A comment on top may have signs of a prompt or of an encoding before it.
            return Err(line.fault("a keyword such as *NODE"));
        }
    }
    Ok(keywords)
}

impl<'a> Keyword<'a> {
    fn new(line: Line<'a>) -> Self {
        let (name, parameters) = line.text[1..]
            .split_once(',')
            .unwrap_or((&line.text[1..], ""));
        let words: Vec<String> = name.split_whitespace().map(str::to_uppercase).collect();
        let mut keyword = Self {
            line: line.number,
            text: line.text,
            name: words.join(" "),
            parameters: Vec::new(),
            rows: Vec::new(),
        };
        keyword.add_parameters(parameters);
        keyword
    }

    fn add_parameters(&mut self, text: &'a str) {
        for parameter in text.split(',').filter(|text| !text.trim().is_empty()) {
            let (name, value) = parameter.split_once('=').unwrap_or((parameter, ""));
            let value = value.trim().trim_matches('"');
            self.parameters.push((name.trim().to_uppercase(), value));
        }
    }

    /// The value of a parameter, empty where it has none.
    pub fn parameter(&self, name: &str) -> Option<&'a str> {
        let found = self.parameters.iter().find(|(key, _)| key == name);
        found.map(|&(_, value)| value)
    }

    /// All parameters in capitals with their values.
    pub fn parameters(&self) -> impl Iterator<Item = (&str, &'a str)> {
        let all = self.parameters.iter();
        all.map(|(name, value)| (name.as_str(), *value))
    }

    /// The value of a parameter that has to be there.
    pub(super) fn required(&self, name: &str) -> Result<&'a str, MeshFileFault> {
        let value = self.parameter(name).filter(|value| !value.is_empty());
        value.ok_or_else(|| self.fault(&format!("the parameter {name}")))
    }

    /// A fault if there is any parameter but these.
    pub(super) fn allow(&self, known: &[&str]) -> Result<(), MeshFileFault> {
        let mut keys = self.parameters.iter().map(|(key, _)| key.as_str());
        match keys.find(|key| !known.contains(key)) {
            None => Ok(()),
            Some(key) => Err(self.fault(&format!("no parameter {key}"))),
        }
    }

    /// A fault if the rows are in another file.
    pub(super) fn refuse_input(&self) -> Result<(), MeshFileFault> {
        match self.parameter("INPUT") {
            None => Ok(()),
            Some(_) => Err(self.fault("the rows in this file")),
        }
    }

    /// The rows, each joined with those that continue it until it has so many words.
    pub fn joined_rows(&self, words: usize) -> Vec<Row<'a>> {
        let mut joined: Vec<Row<'a>> = Vec::new();
        for row in &self.rows {
            match joined.last_mut() {
                Some(last)
                    if last.continued == Continued::OnNextLine && last.words.len() < words =>
                {
                    last.words.extend(&row.words);
                    last.continued = row.continued;
                }
                _ => joined.push(row.clone()),
            }
        }
        joined
    }

    pub(super) fn fault(&self, expected: &str) -> MeshFileFault {
        let (number, text) = (self.line, self.text);
        Line { number, text }.fault(expected)
    }
}

impl<'a> Row<'a> {
    fn new(line: Line<'a>) -> Self {
        let (text, continued) = match line.text.strip_suffix(',') {
            Some(text) => (text, Continued::OnNextLine),
            None => (line.text, Continued::Here),
        };
        Self {
            line: line.number,
            words: text.split(',').map(str::trim).collect(),
            continued,
        }
    }

    /// The row with so many words at most.
    pub fn shortened(&self, words: usize) -> Self {
        let mut row = self.clone();
        row.words.truncate(words);
        row
    }

    /// A row of a single word.
    pub(super) fn of_word(line: usize, word: &'a str) -> Self {
        Self {
            line,
            words: vec![word],
            continued: Continued::Here,
        }
    }

    pub(super) fn fault(&self, expected: &str) -> MeshFileFault {
        let text = self.words.join(", ");
        Line {
            number: self.line,
            text: &text,
        }
        .fault(expected)
    }
}
