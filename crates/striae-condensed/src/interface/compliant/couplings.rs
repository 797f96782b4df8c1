//! Entries between kept unknowns, sorted by what they couple to.

use crate::interface::Kind;
use rayon::prelude::*;
use striae_sparse::sparse_elimination::Row;

/// Rows that a thread sorts at a time.
const ROWS: usize = 64;

/// Rows of the contact system, entries with bulk unknowns first, then those with multipliers.
#[derive(Debug)]
pub(super) struct Couplings {
    rows: Vec<Row>,
    /// Entries of each row with bulk unknowns.
    bulk: Vec<u32>,
}

impl Couplings {
    /// Sorts the entries of rows, whose order is kept otherwise.
    pub(super) fn new(kinds: &[Kind], mut rows: Vec<Row>) -> Self {
        let bulk = rows.par_iter_mut().with_min_len(ROWS);
        let bulk = bulk.map_init(Row::new, |others, row| {
            row.retain(|entry| {
                let is_bulk = kinds[entry.0 as usize] != Kind::Multiplier;
                if !is_bulk {
                    others.push(*entry);
                }
                is_bulk
            });
            let count = row.len() as u32;
            row.append(others);
            count
        });
        Self {
            bulk: bulk.collect(),
            rows,
        }
    }

    /// All entries of a row.
    pub(super) fn all(&self, row: usize) -> &[(u32, f64)] {
        &self.rows[row]
    }

    /// Entries of a row with bulk unknowns.
    pub(super) fn with_bulk(&self, row: usize) -> &[(u32, f64)] {
        &self.rows[row][..self.bulk[row] as usize]
    }

    /// Entries of a row with multipliers.
    pub(super) fn with_multipliers(&self, row: usize) -> &[(u32, f64)] {
        &self.rows[row][self.bulk[row] as usize..]
    }

    /// The rows as they were.
    pub(super) fn into_rows(mut self) -> Vec<Row> {
        let rows = self.rows.par_iter_mut().with_min_len(ROWS);
        rows.for_each(|row| row.sort_unstable_by_key(|entry| entry.0));
        self.rows
    }
}
