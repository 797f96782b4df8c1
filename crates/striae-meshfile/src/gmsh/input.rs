//! A file of Gmsh record by record, as text or binary.
//!
//! In text a record is a line. In a binary file sections begin and end with lines of text, and
//! between them stand integers of four bytes, sizes of as many bytes as the header says, and
//! reals of eight, in the order of bytes that the integer 1 of the header shows. Both are asked
//! for the same things with the same words, so that faults read alike; where there are no
//! lines, places are the section and its record.

use std::borrow::Cow;
use std::str::{FromStr, SplitWhitespace};

use super::super::lines::quoted;
use super::super::{MeshFileFault, Place, Section};

/// The content of a file, read up to some place.
pub(super) struct Input<'a> {
    bytes: &'a [u8],
    at: usize,
    form: Form,
    /// Number of lines read.
    lines: usize,
    section: Section,
    /// Number of records of the section read.
    records: u32,
    words: SplitWhitespace<'a>,
}

/// Encoding of numbers.
#[derive(Clone, Copy, PartialEq)]
enum Form {
    Text,
    /// With this order of bytes, and so many in a size.
    Binary(Order, usize),
}

/// Order of the bytes of a number.
#[derive(Clone, Copy, PartialEq)]
enum Order {
    Little,
    Big,
}

/// A file of text with all that is not UTF-8 replaced, which can only matter in names; a binary
/// file unchanged.
pub(super) fn readable(bytes: &[u8]) -> Cow<'_, [u8]> {
    let mut lines = bytes.split(|byte| *byte == b'\n').map(<[u8]>::trim_ascii);
    let format = lines.find(|line| !line.is_empty() && !line.starts_with(b"$"));
    let format = String::from_utf8_lossy(format.unwrap_or_default());
    if format.split_whitespace().nth(1) == Some("1") {
        return Cow::Borrowed(bytes);
    }
    match String::from_utf8_lossy(bytes) {
        Cow::Borrowed(text) => Cow::Borrowed(text.as_bytes()),
        Cow::Owned(text) => Cow::Owned(text.into_bytes()),
    }
}

impl<'a> Input<'a> {
    pub(super) fn new(bytes: &'a [u8]) -> Self {
        Self {
            bytes,
            at: 0,
            form: Form::Text,
            lines: 0,
            section: Section::Other,
            records: 0,
            words: "".split_whitespace(),
        }
    }

    pub(super) fn is_binary(&self) -> bool {
        self.form != Form::Text
    }

    /// Location of the record that was read last.
    pub(super) fn place(&self) -> Place {
        match self.form {
            Form::Text => Place::Line(self.lines),
            Form::Binary(..) => Place::Record {
                section: self.section,
                record: self.records,
            },
        }
    }

    /// The fault that something else was expected here.
    pub(super) fn fault(&self, expected: &str, found: impl Into<String>) -> MeshFileFault {
        MeshFileFault::at(self.place(), expected, found)
    }

    /// Name of the next section, `None` at the end of the file.
    pub(super) fn section(&mut self) -> Result<Option<&'a str>, MeshFileFault> {
        self.records = 0;
        let Some(line) = self.next_line()? else {
            return Ok(None);
        };
        self.section = Section::new(line);
        let name = line.strip_prefix('$');
        let fault = || self.fault("a section such as $MeshFormat", quoted(line));
        name.map(Some).ok_or_else(fault)
    }

    /// The line that ends the section of that name.
    pub(super) fn end(&mut self, section: &str) -> Result<(), MeshFileFault> {
        let expected = format!("$End{section}");
        let line = self.line(&expected)?;
        if line == expected {
            return Ok(());
        }
        Err(self.fault(&expected, quoted(line)))
    }

    /// Passes over all that is left of a section.
    pub(super) fn skip(&mut self, section: &str) -> Result<(), MeshFileFault> {
        let end = format!("$End{section}");
        if !self.is_binary() {
            while self.line(&end)? != end {}
            return Ok(());
        }
        let rest = &self.bytes[self.at..];
        let found = (rest.windows(end.len())).position(|window| window == end.as_bytes());
        let found = found.ok_or_else(|| self.fault(&end, END))?;
        self.at += found + end.len();
        Ok(())
    }

    /// The rows that follow are binary: reads the number 1 that shows the order of bytes.
    pub(super) fn begin_binary(&mut self, size: usize) -> Result<(), MeshFileFault> {
        let expected = "the number 1 in four bytes";
        let number = self.bytes.get(self.at..self.at + 4);
        let order = match number {
            Some([1, 0, 0, 0]) => Order::Little,
            Some([0, 0, 0, 1]) => Order::Big,
            Some(other) => return Err(self.fault(expected, format!("the bytes {other:?}"))),
            None => return Err(self.fault(expected, END)),
        };
        self.at += 4;
        self.form = Form::Binary(order, size);
        Ok(())
    }

    /// Begins a record that counts: a line of text, or what is next in a binary section.
    pub(super) fn record(&mut self, expected: &str) -> Result<(), MeshFileFault> {
        self.records = self.records.saturating_add(1);
        self.row(expected)
    }

    /// Begins a line of text, or what is next in a binary section.
    pub(super) fn row(&mut self, expected: &str) -> Result<(), MeshFileFault> {
        if self.is_binary() {
            return Ok(());
        }
        self.text_row(expected)
    }

    /// Begins a line of text, also in a binary file.
    pub(super) fn text_row(&mut self, expected: &str) -> Result<(), MeshFileFault> {
        self.words = self.line(expected)?.split_whitespace();
        Ok(())
    }

    /// The next line of text.
    pub(super) fn line(&mut self, expected: &str) -> Result<&'a str, MeshFileFault> {
        let line = self.next_line()?;
        line.ok_or_else(|| self.fault(expected, END))
    }

    /// The next word of a line of text, as a value.
    pub(super) fn word<T: FromStr>(&mut self, expected: &str) -> Result<T, MeshFileFault> {
        let word = self.words.next();
        let word = word.ok_or_else(|| self.fault(expected, "the end of the line"))?;
        let value = word.parse();
        value.map_err(|_| self.fault(expected, quoted(word)))
    }

    /// An integer.
    pub(super) fn integer<T>(&mut self, expected: &str) -> Result<T, MeshFileFault>
    where
        T: FromStr + TryFrom<i64>,
    {
        let Form::Binary(order, _) = self.form else {
            return self.word(expected);
        };
        let bytes = self.take::<4>(expected)?;
        let number = i64::from(match order {
            Order::Little => i32::from_le_bytes(bytes),
            Order::Big => i32::from_be_bytes(bytes),
        });
        T::try_from(number).map_err(|_| self.fault(expected, format!("`{number}`")))
    }

    /// A number of nodes, elements and the like, or one of these.
    pub(super) fn size<T>(&mut self, expected: &str) -> Result<T, MeshFileFault>
    where
        T: FromStr + TryFrom<u64>,
    {
        let Form::Binary(order, size) = self.form else {
            return self.word(expected);
        };
        let number = match (size, order) {
            (4, Order::Little) => u32::from_le_bytes(self.take(expected)?).into(),
            (4, Order::Big) => u32::from_be_bytes(self.take(expected)?).into(),
            (_, Order::Little) => u64::from_le_bytes(self.take(expected)?),
            (_, Order::Big) => u64::from_be_bytes(self.take(expected)?),
        };
        T::try_from(number).map_err(|_| self.fault(expected, format!("`{number}`")))
    }

    /// A real number.
    pub(super) fn real(&mut self, expected: &str) -> Result<f64, MeshFileFault> {
        match self.form {
            Form::Text => self.word(expected),
            Form::Binary(Order::Little, _) => Ok(f64::from_le_bytes(self.take(expected)?)),
            Form::Binary(Order::Big, _) => Ok(f64::from_be_bytes(self.take(expected)?)),
        }
    }

    /// So many values.
    pub(super) fn several<T>(
        &mut self,
        count: usize,
        one: impl Fn(&mut Self) -> Result<T, MeshFileFault>,
    ) -> Result<Vec<T>, MeshFileFault> {
        (0..count).map(|_| one(self)).collect()
    }

    fn take<const N: usize>(&mut self, expected: &str) -> Result<[u8; N], MeshFileFault> {
        let bytes = self.bytes[self.at..].first_chunk::<N>();
        let bytes = *bytes.ok_or_else(|| self.fault(expected, END))?;
        self.at += N;
        Ok(bytes)
    }

    /// The next line that is not blank, without white space around it.
    fn next_line(&mut self) -> Result<Option<&'a str>, MeshFileFault> {
        while self.at < self.bytes.len() {
            let rest = &self.bytes[self.at..];
            let end = rest.iter().position(|byte| *byte == b'\n');
            let line = &rest[..end.unwrap_or(rest.len())];
            let place = self.at;
            self.at += line.len() + usize::from(end.is_some());
            self.lines += 1;
            let line = std::str::from_utf8(line.trim_ascii()).map_err(|_| {
                let place = Place::Byte(place);
                MeshFileFault::at(place, "a line of text", "bytes that are not text")
            })?;
            if !line.is_empty() {
                return Ok(Some(line));
            }
        }
        Ok(None)
    }
}

const END: &str = "the end of the file";
