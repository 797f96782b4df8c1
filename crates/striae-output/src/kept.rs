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
