//! The history of a run that is resumed, as it was at its checkpoint.
//!
//! Since then it may have more rows, and more columns of contact that was made, see
//! [`row`](crate::row()): what counts is the table without them.

use std::path::Path;

use crate::{
    OutputError,
    checkpoint::Written,
    checksums::sum_of,
    history::{History, Table},
};

/// Name of the file.
pub(crate) const HISTORY: &str = "history.csv";

/// The table at the checkpoint.
///
/// # Errors
/// If the file cannot be read, or has changed.
pub(crate) fn table(folder: &Path, written: &Written) -> Result<Table, OutputError> {
    let path = folder.join(HISTORY);
    let table = Table::read(&path)?;
    let table = table.narrowed(&written.columns, written.iterations.len());
    let known = written.sums.iter().find(|(name, _)| name == HISTORY);
    match (table, known) {
        (Some(table), Some((_, sum))) if sum_of(table.text().as_bytes()) == *sum => Ok(table),
        _ => Err(OutputError::Damaged(path)),
    }
}

/// Continues the history after its checkpoint.
///
/// # Errors
/// If the file cannot be read or written, or has changed.
pub(crate) fn continued(folder: &Path, written: &Written) -> Result<History, OutputError> {
    History::with(folder.join(HISTORY), table(folder, written)?)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::checksums::sum;

    /// A history of two rows in a folder, and what its checkpoint knows of it.
    fn kept(folder: &Path) -> (History, Written) {
        let mut history = History::create(folder.join(HISTORY)).unwrap();
        history.append(&[("time", 0.1), ("end", -0.0)]).unwrap();
        history.append(&[("time", 0.3), ("end", 1e-300)]).unwrap();
        let written = Written {
            iterations: vec![3, 4],
            columns: vec!["time".to_owned(), "end".to_owned()],
            sums: vec![sum(folder, Path::new(HISTORY)).unwrap()],
            ..Written::default()
        };
        (history, written)
    }

    #[test]
    fn rows_and_columns_after_the_checkpoint_are_left_out() {
        let folder = tempfile::tempdir().unwrap();
        let folder = folder.path();
        let (mut history, written) = kept(folder);
        let before = std::fs::read(folder.join(HISTORY)).unwrap();
        let wider = [("time", 0.5), ("open", 7.0), ("end", 2.0)];
        history.append_wider(&wider, |_| 9.0).unwrap();
        continued(folder, &written).unwrap();
        assert_eq!(std::fs::read(folder.join(HISTORY)).unwrap(), before);
    }

    #[test]
    fn changed_rows_are_refused() {
        let folder = tempfile::tempdir().unwrap();
        let folder = folder.path();
        let (_, written) = kept(folder);
        for damaged in [
            "time,end\n0.1,-0.0\n0.4,1e-300\n",
            "time,end\n0.1,-0.0\n",
            "time\n0.1\n0.3\n",
            "",
        ] {
            std::fs::write(folder.join(HISTORY), damaged).unwrap();
            let error = continued(folder, &written).unwrap_err();
            assert!(matches!(error, OutputError::Damaged(_)), "{error}");
        }
    }

    #[test]
    fn a_run_that_had_no_row_begins_anew() {
        let folder = tempfile::tempdir().unwrap();
        let folder = folder.path();
        let mut history = History::create(folder.join(HISTORY)).unwrap();
        let written = Written {
            sums: vec![sum(folder, Path::new(HISTORY)).unwrap()],
            ..Written::default()
        };
        history.append(&[("time", 0.1)]).unwrap();
        let mut again = continued(folder, &written).unwrap();
        again.append(&[("gap", 0.2)]).unwrap();
        assert_eq!(Table::read(&folder.join(HISTORY)).unwrap().columns, ["gap"]);
    }
}
