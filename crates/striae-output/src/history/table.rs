//! Tables of numbers as comma-separated text.

use std::collections::BTreeSet;
use std::path::Path;

use striae_files::{quoted, read_text, write_atomically};

use super::COUNTS;
use crate::OutputError;

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
        write_atomically(path, self.text().as_bytes())?;
        Ok(())
    }

    /// The table as text, none without columns.
    pub(crate) fn text(&self) -> String {
        if self.columns.is_empty() {
            return String::new();
        }
        let names = || self.columns.iter().map(String::as_str);
        let rows = self.rows.iter();
        let rows = rows.map(|row| line(names().zip(row.iter().copied())));
        std::iter::once(header(&self.columns)).chain(rows).collect()
    }

    /// Adds columns, with the number `before` of the column in all rows; `columns` are all that
    /// there are then. Returns `false` and leaves the table as it is unless those so far are among
    /// them in the same order.
    pub fn widen(&mut self, columns: &[&str], before: impl Fn(&str) -> f64) -> bool {
        let mut so_far = self.columns.iter().enumerate().peekable();
        let places: Vec<Option<usize>> = columns
            .iter()
            .map(|name| so_far.next_if(|(_, known)| known == name).map(|(at, _)| at))
            .collect();
        if so_far.next().is_some() {
            return false;
        }
        let number = |row: &[f64], at: usize| match places[at] {
            Some(known) => row[known],
            None => before(columns[at]),
        };
        for row in &mut self.rows {
            *row = (0..columns.len()).map(|at| number(row, at)).collect();
        }
        self.columns = columns.iter().map(|name| (*name).to_owned()).collect();
        true
    }

    /// The first `rows` rows of some columns; `None` where there are not as many or a column is
    /// missing.
    pub(crate) fn narrowed(&self, columns: &[String], rows: usize) -> Option<Self> {
        let place = |name| self.columns.iter().position(|known| known == name);
        let places: Vec<usize> = columns.iter().map(place).collect::<Option<_>>()?;
        let rows = self.rows.get(..rows)?.iter();
        let rows = rows.map(|row| places.iter().map(|&at| row[at]).collect());
        Some(Self {
            columns: columns.to_vec(),
            rows: rows.collect(),
        })
    }

    /// The numbers of one column.
    pub fn column(&self, name: &str) -> Option<Vec<f64>> {
        let index = self.columns.iter().position(|column| column == name)?;
        Some(self.rows.iter().map(|row| row[index]).collect())
    }
}

pub(super) fn refuse_duplicates(path: &Path, columns: &[String]) -> Result<(), OutputError> {
    let mut seen = BTreeSet::new();
    match columns.iter().find(|name| !seen.insert(*name)) {
        Some(name) => Err(OutputError::Duplicate {
            path: path.to_owned(),
            name: name.clone(),
        }),
        None => Ok(()),
    }
}

pub(super) fn header(columns: &[String]) -> String {
    let quoted: Vec<String> = columns.iter().map(|name| quoted(name)).collect();
    quoted.join(",") + "\n"
}

/// A line of numbers with the names of their columns.
pub(super) fn line<'a>(numbers: impl Iterator<Item = (&'a str, f64)>) -> String {
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
