//! The history of a run: one row an accepted increment, as comma-separated text.
//!
//! The first row fixes the columns. Their names are dotted and free of units,
//! such as `reaction.bottom.z` or `pair.interface.resultant_a.x`. Numbers are
//! written with the fewest digits (at most 17) that read back as the same bits, those of
//! columns that count (see [`COUNTS`]) as integers.
//! Every row is flushed, so an interrupted run keeps all it accepted.
//!
//! [`History`] writes; [`Table`] reads such a file back, and writes any other
//! table of numbers.

use std::collections::BTreeSet;
use std::fs::File;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use crate::OutputError;
use striae_files::{FileError, quoted, read_text, write_atomically};

/// Last parts of the names of columns that count something.
pub const COUNTS: [&str; 7] = [
    "increment",
    "step",
    "iterations",
    "cutbacks",
    "stick",
    "slip",
    "open",
];

/// A growing file of rows.
#[derive(Debug)]
pub struct History {
    path: PathBuf,
    file: File,
    columns: Vec<String>,
    rows: usize,
}

impl History {
    /// Starts a new history, replacing an older file.
    pub fn create(path: impl Into<PathBuf>) -> Result<Self, OutputError> {
        let path = path.into();
        match File::create(&path) {
            Ok(file) => Ok(Self {
                path,
                file,
                columns: Vec::new(),
                rows: 0,
            }),
            Err(cause) => Err(FileError::Write { path, cause }.into()),
        }
    }

    /// Starts a new history where there are no rows yet, else continues an older one.
    pub(crate) fn after(path: PathBuf, rows: usize) -> Result<Self, OutputError> {
        match rows {
            0 => Self::create(path),
            rows => Self::resume(path, rows),
        }
    }

    /// Continues an older history after its first `rows` rows, as after a restart.
    pub fn resume(path: impl Into<PathBuf>, rows: usize) -> Result<Self, OutputError> {
        let path = path.into();
        let mut table = Table::read(&path)?;
        if table.rows.len() < rows {
            let found = table.rows.len();
            let cause = format!("{found} rows where {rows} are needed");
            return Err(OutputError::Content { path, cause });
        }
        if rows == 0 {
            return Self::create(path);
        }
        table.rows.truncate(rows);
        table.write(&path)?;
        match File::options().append(true).open(&path) {
            Ok(file) => Ok(Self {
                path,
                file,
                columns: table.columns,
                rows,
            }),
            Err(cause) => Err(FileError::Write { path, cause }.into()),
        }
    }

    /// Appends one row of named numbers; the first row fixes names and order.
    pub fn append(&mut self, row: &[(&str, f64)]) -> Result<(), OutputError> {
        let mut text = String::new();
        if self.columns.is_empty() {
            self.columns = row.iter().map(|(name, _)| (*name).to_owned()).collect();
            refuse_duplicates(&self.path, &self.columns)?;
            text = header(&self.columns);
        }
        self.check(row)?;
        text += &line(row.iter().copied());
        self.write(&text).map_err(|cause| FileError::Write {
            path: self.path.clone(),
            cause,
        })?;
        self.rows += 1;
        Ok(())
    }

    fn check(&self, row: &[(&str, f64)]) -> Result<(), OutputError> {
        let width = self.columns.len().max(row.len());
        for index in 0..width {
            let expected = self.columns.get(index).map_or("none", String::as_str);
            let found = row.get(index).map_or("none", |(name, _)| name);
            if expected != found {
                return Err(OutputError::Column {
                    path: self.path.clone(),
                    row: self.rows + 1,
                    expected: expected.to_owned(),
                    found: format!("`{found}`"),
                });
            }
        }
        Ok(())
    }

    fn write(&mut self, text: &str) -> io::Result<()> {
        self.file.write_all(text.as_bytes())?;
        self.file.flush()
    }
}

/// Named columns of numbers.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Table {
    /// Names of the columns.
    pub columns: Vec<String>,
    /// Rows, each with one number a column.
    pub rows: Vec<Vec<f64>>,
}

impl Table {
    /// Reads a history; a last line cut short by an interruption is left out.
    pub fn read(path: &Path) -> Result<Self, OutputError> {
        let text = read_text(path)?;
        let whole = text.rfind('\n').map_or("", |end| &text[..end]);
        let mut lines = whole.lines();
        let columns: Vec<String> = match lines.next() {
            Some(names) => fields(names),
            None => return Ok(Self::default()),
        };
        let rows = lines
            .enumerate()
            .map(|(index, line)| {
                row(line, columns.len()).map_err(|cause| OutputError::Content {
                    path: path.to_owned(),
                    cause: format!("line {}: {cause}", index + 2),
                })
            })
            .collect::<Result<_, _>>()?;
        Ok(Self { columns, rows })
    }

    /// Writes the table, whole or not at all.
    pub fn write(&self, path: &Path) -> Result<(), OutputError> {
        refuse_duplicates(path, &self.columns)?;
        let names = || self.columns.iter().map(String::as_str);
        let rows = self.rows.iter();
        let rows = rows.map(|row| line(names().zip(row.iter().copied())));
        let text: String = std::iter::once(header(&self.columns)).chain(rows).collect();
        write_atomically(path, text.as_bytes())?;
        Ok(())
    }

    /// The numbers of one column.
    pub fn column(&self, name: &str) -> Option<Vec<f64>> {
        let index = self.columns.iter().position(|column| column == name)?;
        Some(self.rows.iter().map(|row| row[index]).collect())
    }
}

fn refuse_duplicates(path: &Path, columns: &[String]) -> Result<(), OutputError> {
    let mut seen = BTreeSet::new();
    match columns.iter().find(|name| !seen.insert(*name)) {
        Some(name) => Err(OutputError::Duplicate {
            path: path.to_owned(),
            name: name.clone(),
        }),
        None => Ok(()),
    }
}

fn header(columns: &[String]) -> String {
    let quoted: Vec<String> = columns.iter().map(|name| quoted(name)).collect();
    quoted.join(",") + "\n"
}

/// A line of numbers with the names of their columns.
fn line<'a>(numbers: impl Iterator<Item = (&'a str, f64)>) -> String {
    let shortest: Vec<String> = numbers
        .map(|(name, number)| match is_count(name) && is_whole(number) {
            true => format!("{number:.0}"),
            false => format!("{number:?}"),
        })
        .collect();
    shortest.join(",") + "\n"
}

/// Returns whether the numbers of a column are counts.
fn is_count(column: &str) -> bool {
    let last = column.rsplit('.').next();
    last.is_some_and(|last| COUNTS.contains(&last))
}

/// Returns whether all digits of a number are before the point and known.
fn is_whole(number: f64) -> bool {
    const LARGEST: f64 = (1_u64 << f64::MANTISSA_DIGITS) as f64;
    number.fract() == 0.0 && number.abs() <= LARGEST
}

fn row(line: &str, columns: usize) -> Result<Vec<f64>, String> {
    let numbers: Vec<f64> = line
        .split(',')
        .map(|field| {
            let number = field.trim().parse();
            number.map_err(|_| format!("`{field}` is not a number"))
        })
        .collect::<Result<_, _>>()?;
    if numbers.len() == columns {
        Ok(numbers)
    } else {
        Err(format!("{} numbers for {columns} columns", numbers.len()))
    }
}

fn fields(line: &str) -> Vec<String> {
    let (mut fields, mut field) = (Vec::new(), String::new());
    let mut in_quotes = false;
    let mut letters = line.chars().peekable();
    while let Some(letter) = letters.next() {
        match letter {
            '"' if in_quotes && letters.peek() == Some(&'"') => {
                letters.next();
                field.push('"');
            }
            '"' => in_quotes = !in_quotes,
            ',' if !in_quotes => fields.push(std::mem::take(&mut field)),
            _ => field.push(letter),
        }
    }
    fields.push(field);
    fields
}

#[cfg(test)]
mod tests {
    use std::io::Write as _;

    use proptest::prelude::*;

    use super::*;

    #[test]
    fn rows_are_on_disk_as_soon_as_appended() {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join("history.csv");
        let mut history = History::create(&path).unwrap();
        for step in 1..=3 {
            let time = 0.1 * f64::from(step);
            let row = [("time", time), ("reaction.bottom.z", -time / 3.0)];
            history.append(&row).unwrap();
            let table = Table::read(&path).unwrap();
            assert_eq!(table.columns, ["time", "reaction.bottom.z"]);
            assert_eq!(table.rows.len(), step as usize);
            assert_eq!(table.column("time").unwrap().last(), Some(&time));
        }
    }

    #[test]
    fn another_set_of_columns_is_refused_and_not_written() {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join("history.csv");
        let mut history = History::create(&path).unwrap();
        history.append(&[("time", 0.0), ("gap", 1.0)]).unwrap();
        for row in [
            vec![("time", 1.0), ("slip", 1.0)],
            vec![("time", 1.0)],
            vec![("time", 1.0), ("gap", 1.0), ("slip", 1.0)],
        ] {
            let error = history.append(&row).unwrap_err();
            assert!(
                matches!(error, OutputError::Column { row: 2, .. }),
                "{error}"
            );
        }
        assert_eq!(Table::read(&path).unwrap().rows, [[0.0, 1.0]]);
        let mut twice = History::create(&path).unwrap();
        let error = twice.append(&[("gap", 0.0), ("gap", 1.0)]).unwrap_err();
        assert!(matches!(error, OutputError::Duplicate { .. }));
    }

    #[test]
    fn an_interrupted_row_is_left_out_and_a_restart_goes_on() {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join("history.csv");
        let mut history = History::create(&path).unwrap();
        for step in 0..4 {
            history.append(&[("time", f64::from(step))]).unwrap();
        }
        history.file.write_all(b"3.99").unwrap();
        let mut resumed = History::resume(&path, 2).unwrap();
        resumed.append(&[("time", 1.5)]).unwrap();
        let table = Table::read(&path).unwrap();
        assert_eq!(table.column("time").unwrap(), [0.0, 1.0, 1.5]);
        let error = History::resume(&path, 4).unwrap_err().to_string();
        assert!(error.ends_with("3 rows where 4 are needed"), "{error}");
        let mut afresh = History::resume(&path, 0).unwrap();
        afresh.append(&[("slip", 0.5)]).unwrap();
        assert_eq!(Table::read(&path).unwrap().columns, ["slip"]);
    }

    #[test]
    fn faults_are_reported_with_their_line() {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join("history.csv");
        std::fs::write(&path, "a,b\n1,2\n1,x\n").unwrap();
        let error = Table::read(&path).unwrap_err().to_string();
        assert!(error.ends_with("line 3: `x` is not a number"), "{error}");
        std::fs::write(&path, "a,b\n1\n").unwrap();
        let error = Table::read(&path).unwrap_err().to_string();
        assert!(
            error.ends_with("line 2: 1 numbers for 2 columns"),
            "{error}"
        );
    }

    proptest! {
        #[test]
        fn tables_come_back_bit_by_bit(
            rows in prop::collection::vec(prop::collection::vec(any::<f64>(), 3), 0..20),
            name in "[a-z,\" .]{1,12}",
        ) {
            let directory = tempfile::tempdir().unwrap();
            let path = directory.path().join("table.csv");
            let columns = vec![name, "A".into(), "B".into()];
            let table = Table { columns, rows };
            table.write(&path).unwrap();
            let back = Table::read(&path).unwrap();
            prop_assert_eq!(&back.columns, &table.columns);
            let bits = |t: &Table| t.rows.iter().flatten().map(|v| {
                if v.is_nan() { f64::NAN.to_bits() } else { v.to_bits() }
            }).collect::<Vec<_>>();
            prop_assert_eq!(bits(&back), bits(&table));
        }
    }
}
