//! The lines and numbers of a legacy file.

use super::super::super::lines::quoted;
use super::super::super::{MeshFileFault, Place};
use super::super::number::{Number, Order, Values};

/// A file, read up to some place.
pub(super) struct File<'a> {
    pub(super) bytes: &'a [u8],
    at: usize,
    /// Number of lines that have ended.
    lines: usize,
    pub(super) form: Form,
    /// Part of the version before the point.
    pub(super) version: u32,
    /// Location of the line that was read last.
    pub(super) place: Place,
}

#[derive(PartialEq)]
pub(super) enum Form {
    Text,
    Binary,
}

/// A line with a keyword.
pub(super) struct Words<'a> {
    pub(super) all: &'a str,
    pub(super) rest: std::str::SplitWhitespace<'a>,
    pub(super) place: Place,
}

impl<'a> File<'a> {
    pub(super) fn new(bytes: &'a [u8]) -> Result<Self, MeshFileFault> {
        let mut file = Self {
            bytes,
            at: 0,
            lines: 0,
            form: Form::Text,
            version: 0,
            place: Place::Line(1),
        };
        let head = file.raw_line().unwrap_or_default();
        let version = head.rsplit_once(' ').map_or("", |(_, version)| version);
        let major = version.split('.').next().and_then(|word| word.parse().ok());
        file.version = match major.filter(|_| head.starts_with("# vtk DataFile Version")) {
            Some(version @ 1..=5) => version,
            _ => {
                let expected = "# vtk DataFile Version 1.0 to 5.1";
                return Err(MeshFileFault::at(file.place, expected, quoted(head)));
            }
        };
        file.raw_line();
        let form = file.line().unwrap_or_default();
        file.form = match form.to_uppercase().as_str() {
            "ASCII" => Form::Text,
            "BINARY" => Form::Binary,
            _ => {
                return Err(MeshFileFault::at(
                    file.place,
                    "ASCII or BINARY",
                    quoted(form),
                ));
            }
        };
        Ok(file)
    }

    /// The next line, also a blank one, without white space around it.
    pub(super) fn raw_line(&mut self) -> Option<&'a str> {
        let rest = self.bytes.get(self.at..).filter(|rest| !rest.is_empty())?;
        self.lines += 1;
        self.place = match self.form {
            Form::Text => Place::Line(self.lines),
            Form::Binary => Place::Byte(self.at),
        };
        let end = rest.iter().position(|byte| *byte == b'\n');
        self.at += end.map_or(rest.len(), |end| end + 1);
        let line = rest[..end.unwrap_or(rest.len())].trim_ascii();
        let words = std::str::from_utf8(line);
        // Bytes that are none of a text end up as an unknown keyword.
        Some(words.unwrap_or(NO_TEXT))
    }

    /// The next line that is not blank.
    pub(super) fn line(&mut self) -> Option<&'a str> {
        loop {
            match self.raw_line() {
                Some("") => {}
                other => return other,
            }
        }
    }

    /// Passes over the next line if it begins with a word.
    pub(super) fn skip_line(&mut self, word: &str) {
        let rest = self.bytes.get(self.at..).unwrap_or_default();
        let begin = rest.get(..word.len()).unwrap_or_default();
        if begin.eq_ignore_ascii_case(word.as_bytes()) {
            self.raw_line();
        }
    }

    /// A line of which there has to be one.
    pub(super) fn words(&mut self, expected: &str) -> Result<Words<'a>, MeshFileFault> {
        let line = self.line();
        let line = line.ok_or_else(|| MeshFileFault::at(self.place, expected, END))?;
        Ok(Words::new(line, self.place))
    }

    /// Lines up to the next blank one.
    pub(super) fn skip_metadata(&mut self) {
        while self.raw_line().is_some_and(|line| !line.is_empty()) {}
    }

    /// So many numbers, from the beginning of a line.
    pub(super) fn values(&mut self, count: usize, number: Number) -> Result<Values, MeshFileFault> {
        let short = |found: usize| {
            MeshFileFault::at(self.place, format!("{count} numbers"), format!("{found}"))
        };
        let rest = &self.bytes[self.at.min(self.bytes.len())..];
        if self.form == Form::Binary {
            let size = count.checked_mul(number.size());
            let bytes = size.and_then(|size| rest.get(..size));
            let bytes = bytes.ok_or_else(|| short(rest.len() / number.size()))?;
            self.at += bytes.len();
            return Ok(number.values(Order::Big, bytes));
        }
        let (mut words, mut at) = (Vec::new(), 0);
        while words.len() < count {
            let skipped = rest[at..]
                .iter()
                .take_while(|byte| byte.is_ascii_whitespace());
            let skipped = skipped.count();
            self.lines += rest[at..at + skipped]
                .iter()
                .filter(|byte| **byte == b'\n')
                .count();
            let word = &rest[at + skipped..];
            let end = word.iter().position(u8::is_ascii_whitespace);
            let word = &word[..end.unwrap_or(word.len())];
            if word.is_empty() {
                return Err(short(words.len()));
            }
            at += skipped + word.len();
            let word = std::str::from_utf8(word).unwrap_or(NO_TEXT);
            words.push((self.lines + 1, word));
        }
        self.at += at;
        number
            .parsed(words.iter().map(|word| word.1))
            .map_err(|wrong| {
                let line = words.iter().find(|word| word.1 == wrong);
                let line = line.map_or(self.lines, |word| word.0);
                MeshFileFault::line(line, "a number", quoted(wrong))
            })
    }

    /// So many integers.
    pub(super) fn whole(
        &mut self,
        count: usize,
        number: Number,
    ) -> Result<Vec<i64>, MeshFileFault> {
        let place = self.place;
        let whole = self.values(count, number)?.whole();
        whole.ok_or_else(|| MeshFileFault::at(place, "integers", "real numbers"))
    }
}

impl<'a> Words<'a> {
    pub(super) fn new(all: &'a str, place: Place) -> Self {
        Self {
            all,
            rest: all.split_whitespace(),
            place,
        }
    }

    pub(super) fn next(&mut self, expected: &str) -> Result<&'a str, MeshFileFault> {
        let word = self.rest.next();
        word.ok_or_else(|| self.fault(expected, "the end of the line"))
    }

    pub(super) fn count(&mut self) -> Result<usize, MeshFileFault> {
        let word = self.next("a whole number")?;
        let count = word.parse();
        count.map_err(|_| self.fault("a whole number", quoted(word)))
    }

    pub(super) fn number(&mut self) -> Result<Number, MeshFileFault> {
        let word = self.next("a type of numbers")?;
        let number = Number::of_legacy(word);
        number.ok_or_else(|| self.fault("a type of numbers such as int or double", quoted(word)))
    }

    pub(super) fn fault(&self, expected: &str, found: impl Into<String>) -> MeshFileFault {
        MeshFileFault::at(self.place, expected, found)
    }
}

const END: &str = "the end of the file";
const NO_TEXT: &str = "bytes that are not text";
