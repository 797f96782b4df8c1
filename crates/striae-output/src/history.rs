//! The history of a run: one row an accepted increment, as comma-separated text.
//!
//! Column names are dotted and free of units, such as `reaction.bottom.z` or
//! `pair.interface.resultant_a.x`. Numbers are written with the fewest digits (at most 17)
//! that read back as the same bits, those of columns that count (see [`COUNTS`]) as integers.
//! Every row is flushed, so an interrupted run keeps all it accepted.
//!
//! The first row fixes the columns. Only [`History::append_wider`] adds some, by writing the
//! whole file again.
//!
//! [`History`] writes; [`Table`] reads such a file back, and writes any other
//! table of numbers.

mod table;

use std::fs::File;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use crate::OutputError;
use striae_files::FileError;
pub use table::Table;
use table::{header, line, refuse_duplicates};

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
        table.rows.truncate(rows);
        Self::with(path, table)
    }

    /// Replaces an older file by a table, to which rows can be appended.
    pub(crate) fn with(path: PathBuf, table: Table) -> Result<Self, OutputError> {
        if table.rows.is_empty() {
            return Self::create(path);
        }
        table.write(&path)?;
        Ok(Self {
            file: opened(&path)?,
            path,
            rows: table.rows.len(),
            columns: table.columns,
        })
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

    /// Appends one row that may have new columns among those so far, for which the rows so far
    /// take the number `before` of the column.
    pub fn append_wider(
        &mut self,
        row: &[(&str, f64)],
        before: impl Fn(&str) -> f64,
    ) -> Result<(), OutputError> {
        let names = || row.iter().map(|(name, _)| *name);
        let is_same = self.columns.iter().map(String::as_str).eq(names());
        if self.rows > 0 && !is_same {
            let mut table = Table::read(&self.path)?;
            if table.widen(&names().collect::<Vec<_>>(), before) {
                table.write(&self.path)?;
                self.file = opened(&self.path)?;
                self.columns = table.columns;
            }
        }
        self.append(row)
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

/// Opens a file to append to it.
fn opened(path: &Path) -> Result<File, OutputError> {
    let opened = File::options().append(true).open(path);
    opened.map_err(|cause| {
        let path = path.to_owned();
        FileError::Write { path, cause }.into()
    })
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

    #[test]
    fn a_wider_row_widens_the_rows_before() {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join("history.csv");
        let mut history = History::create(&path).unwrap();
        let before = |name: &str| if name == "open" { 7.0 } else { 0.0 };
        history
            .append_wider(&[("time", 1.0), ("end", 2.0)], before)
            .unwrap();
        let wider = [("time", 3.0), ("open", 4.0), ("force", 5.0), ("end", 6.0)];
        history.append_wider(&wider, before).unwrap();
        history.append_wider(&wider, before).unwrap();
        let table = Table::read(&path).unwrap();
        assert_eq!(table.columns, ["time", "open", "force", "end"]);
        let later = vec![3.0, 4.0, 5.0, 6.0];
        assert_eq!(table.rows, [vec![1.0, 7.0, 0.0, 2.0], later.clone(), later]);
        let narrow = table
            .narrowed(&["time".to_owned(), "end".to_owned()], 1)
            .unwrap();
        assert_eq!(narrow.text(), "time,end\n1.0,2.0\n");
        assert_eq!(table.narrowed(&["gap".to_owned()], 1), None);
        // Columns that have gone are a fault, and the file stays as it was.
        let error = history
            .append_wider(&[("time", 7.0), ("new", 8.0)], before)
            .unwrap_err();
        assert!(
            matches!(error, OutputError::Column { row: 4, .. }),
            "{error}"
        );
        assert_eq!(Table::read(&path).unwrap(), table);
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
