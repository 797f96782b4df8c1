//! Faults with their places in the text, and how they are shown.
//!
//! Each fault is shown as `file:line:column: message` above the line of the
//! deck it is about, the part in question underlined:
//!
//! ```text
//! deck.toml:9:31: unknown key `divsions` in [[body]] mesh; did you mean `divisions`?
//!    9 | mesh = { generator = "block", divsions = [4, 4, 2] }
//!      |                               ^^^^^^^^
//! ```
//!
//! Lines and columns count from one; columns count characters.

use super::{Laws, fault::FaultKind};
use std::{borrow::Cow, collections::BTreeMap, fmt, ops::Range};

/// Faults that are shown at most, as nobody reads more of them at a time.
const MOST_SHOWN: usize = 50;

/// A range of bytes of the deck's text.
pub type Span = Range<usize>;

/// A place in the text of a deck.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Position {
    /// Line, from one.
    pub line: usize,
    /// Column in characters, from one.
    pub column: usize,
}

/// A place in one of the files of a deck.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Location {
    /// File as the author calls it.
    pub file: String,
    /// Position in the file.
    pub position: Position,
}

/// One fault of a deck.
#[derive(Clone, Debug, PartialEq)]
pub struct Fault {
    /// File as the author calls it.
    pub file: String,
    /// Position in the file; `None` if there is no text at all.
    pub position: Option<Position>,
    /// Kind of fault.
    pub kind: FaultKind,
    excerpt: Option<Excerpt>,
}

/// All faults of a deck in the order of their positions.
#[derive(Clone, Debug, PartialEq)]
pub struct Faults(Vec<Fault>);

#[derive(Clone, Debug, PartialEq)]
struct Excerpt {
    text: String,
    length: usize,
}

impl Faults {
    /// The only fault: the file cannot be read.
    pub fn unreadable(file: &str, cause: &std::io::Error) -> Self {
        let kind = FaultKind::Unreadable {
            cause: cause.to_string(),
        };
        Self(vec![Fault {
            file: file.into(),
            position: None,
            kind,
            excerpt: None,
        }])
    }

    /// The only fault: the bytes of the file are no UTF-8 from some byte on.
    pub(crate) fn no_text(file: &str, bytes: &[u8], valid: usize) -> Self {
        let text = String::from_utf8_lossy(bytes);
        let start = String::from_utf8_lossy(&bytes[..valid]).len();
        let kind = FaultKind::NotText;
        let source = Source::new(0, file.into(), text);
        Self(vec![source.locate(&(start..start + 1), kind)])
    }

    /// The faults in the order of their positions.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = &Fault> {
        self.0.iter()
    }
}

impl fmt::Display for Faults {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for fault in self.0.iter().take(MOST_SHOWN) {
            writeln!(f, "{fault}")?;
            if let (Some(position), Some(excerpt)) = (fault.position, &fault.excerpt) {
                let indent = " ".repeat(position.column - 1);
                writeln!(f, "{:5} | {}", position.line, excerpt.text)?;
                writeln!(f, "      | {indent}{}", "^".repeat(excerpt.length))?;
                if let Some(hint) = fault.kind.hint() {
                    writeln!(f, "      = {hint}")?;
                }
            }
        }
        match self.0.len() {
            1 => write!(f, "1 fault"),
            count if count > MOST_SHOWN => {
                write!(
                    f,
                    "{count} faults, of which the first {MOST_SHOWN} are shown"
                )
            }
            count => write!(f, "{count} faults"),
        }
    }
}

impl std::error::Error for Faults {}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.position {
            Some(Position { line, column }) => {
                write!(f, "{}:{line}:{column}: {}", self.file, self.kind)
            }
            None => write!(f, "{}: {}", self.file, self.kind),
        }
    }
}

/// Faults found so far while a deck is read, beside what it is read with.
pub(crate) struct FaultList<'s> {
    /// The deck, and what it includes.
    sources: Vec<Source<'s>>,
    /// By where their spans start.
    found: BTreeMap<usize, Vec<(Span, FaultKind)>>,
    /// Places whose values are missing by a fault elsewhere.
    excused: Vec<Span>,
    /// Laws that the deck may name.
    laws: &'s Laws,
}

/// A text of the deck; spans count from the start of the first one.
struct Source<'s> {
    start: usize,
    file: Cow<'s, str>,
    text: Cow<'s, str>,
    /// Starts of its lines.
    lines: Vec<usize>,
}

impl<'s> FaultList<'s> {
    pub(crate) fn new(file: &'s str, text: &'s str, laws: &'s Laws) -> Self {
        Self {
            sources: vec![Source::new(0, file.into(), text.into())],
            found: BTreeMap::new(),
            excused: Vec::new(),
            laws,
        }
    }

    /// Laws that the deck may name.
    pub(crate) fn laws(&self) -> &'s Laws {
        self.laws
    }

    /// Adds the text of an included file; returns where its spans start.
    pub(crate) fn include(&mut self, file: String, text: String) -> usize {
        let last = self.sources.last();
        let start = last.map_or(0, |last| last.start + last.text.len() + 1);
        let source = Source::new(start, file.into(), text.into());
        self.sources.push(source);
        start
    }

    /// The text that a span is in, with the span there.
    fn source(&self, span: &Span) -> (&Source<'s>, Span) {
        let after = self
            .sources
            .partition_point(|source| source.start <= span.start);
        let source = &self.sources[after.saturating_sub(1)];
        let end = span.end.saturating_sub(source.start);
        (source, span.start - source.start..end)
    }

    pub(crate) fn push(&mut self, span: &Span, kind: impl Into<FaultKind>) {
        let entry = (span.clone(), kind.into());
        let there = self.found.entry(span.start).or_default();
        if !there.contains(&entry) {
            there.push(entry);
        }
    }

    /// Takes the value at a place as missing by a fault elsewhere.
    pub(crate) fn excuse(&mut self, span: Span) {
        self.excused.push(span);
    }

    /// True where a fault has been found inside the range, or the value is missing by another.
    pub(crate) fn within(&self, range: &Span) -> bool {
        let found = self.found.range(range.start..=range.end.max(range.start));
        let found = found.flat_map(|(_, there)| there.iter().map(|(span, _)| span));
        found
            .chain(&self.excused)
            .any(|span| range.start <= span.start && span.end <= range.end)
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.found.is_empty()
    }

    /// Location of a definition as seen from another place: its line, with its file if that is
    /// another one.
    pub(crate) fn seen_from(&self, definition: &Span, span: &Span) -> String {
        let Location { file, position } = self.location(definition);
        let line = position.line;
        match self.source(span).0.file == file {
            true => format!("in line {line}"),
            false => format!("in `{file}`, line {line}"),
        }
    }

    pub(crate) fn location(&self, span: &Span) -> Location {
        let (source, span) = self.source(span);
        Location {
            file: source.file.clone().into_owned(),
            position: source.position(span.start),
        }
    }

    /// A fault that is found later than others.
    pub(crate) fn only(&self, span: &Span, kind: FaultKind) -> Faults {
        Faults(vec![self.located(span, kind)])
    }

    pub(crate) fn into_faults(mut self) -> Faults {
        let found = std::mem::take(&mut self.found).into_values().flatten();
        Faults(
            found
                .map(|(span, kind)| self.located(&span, kind))
                .collect(),
        )
    }

    fn located(&self, span: &Span, kind: FaultKind) -> Fault {
        let (source, span) = self.source(span);
        source.locate(&span, kind)
    }
}

impl<'s> Source<'s> {
    fn new(start: usize, file: Cow<'s, str>, text: Cow<'s, str>) -> Self {
        let ends = text.match_indices('\n').map(|(end, _)| end + 1);
        let lines = std::iter::once(0).chain(ends).collect();
        Self {
            start,
            file,
            text,
            lines,
        }
    }

    fn locate(&self, span: &Span, kind: FaultKind) -> Fault {
        let position = self.position(span.start);
        let line = self.text[self.lines[position.line - 1]..].split('\n');
        let line = first(line).trim_end();
        // Tabs would shift the underline, so they are shown as one blank.
        let shown: String = line
            .chars()
            .map(|c| if c.is_control() { ' ' } else { c })
            .collect();
        let start = floor(&self.text, span.start);
        let end = floor(&self.text, span.end.max(start));
        let marked = first(self.text[start..end].split('\n')).trim_end();
        let excerpt = Excerpt {
            text: shown,
            length: marked.chars().count().max(1),
        };
        Fault {
            file: self.file.clone().into_owned(),
            position: Some(position),
            kind,
            excerpt: Some(excerpt),
        }
    }

    fn position(&self, offset: usize) -> Position {
        let offset = floor(&self.text, offset);
        let line = self.lines.partition_point(|start| *start <= offset);
        Position {
            line,
            column: self.text[self.lines[line - 1]..offset].chars().count() + 1,
        }
    }
}

fn first<'t>(mut lines: impl Iterator<Item = &'t str>) -> &'t str {
    lines.next().unwrap_or("")
}

/// The last character boundary at or before `offset`.
fn floor(text: &str, offset: usize) -> usize {
    let mut offset = offset.min(text.len());
    while !text.is_char_boundary(offset) {
        offset -= 1;
    }
    offset
}
