//! The rows of the kept supervariables, which change while others stay.

use crate::partition::Partition;
use rayon::prelude::*;
use std::ops::Range;
use striae_sparse::{SparseMatrix, Supervariable};

/// Supervariables whose rows a thread copies at a time.
const OWNERS: usize = 16;

impl Partition {
    /// Values in the rows of the kept supervariables, in the `room` of older ones.
    pub fn kept_rows(&self, matrix: &SparseMatrix, room: Vec<f64>) -> Vec<f64> {
        let count = self.kept_ranges().map(|range| range.len()).sum();
        let mut values = room;
        values.resize(count, 0.0);
        let mut copies = Vec::new();
        let mut rest = values.as_mut_slice();
        for range in self.kept_ranges() {
            let (own, others) = rest.split_at_mut(range.len());
            copies.push((own, range));
            rest = others;
        }
        let copies = copies.into_par_iter().with_min_len(OWNERS);
        copies.for_each(|(own, range)| own.copy_from_slice(&matrix.values()[range]));
        values
    }

    /// Overwrites the rows of the kept supervariables.
    ///
    /// # Panics
    /// When there are not as many values as [`kept_rows`](Self::kept_rows) returns.
    pub fn set_kept_rows(&self, matrix: &mut SparseMatrix, values: &[f64]) {
        let mut rest = values;
        for range in self.kept_ranges() {
            let (own, others) = rest.split_at(range.len());
            matrix.values_mut()[range].copy_from_slice(own);
            rest = others;
        }
        assert!(rest.is_empty(), "as many values as kept rows have");
    }

    /// `y += A x` in the rows of the kept supervariables.
    ///
    /// # Panics
    /// When a vector does not have one entry per unknown.
    pub fn add_product_of_kept_rows(&self, matrix: &SparseMatrix, x: &[f64], y: &mut [f64]) {
        for row in self.kept().flat_map(|kept| self.group(kept.0)) {
            y[row] += matrix.row_product(row, x);
        }
    }

    /// Values of the rows of each kept supervariable.
    fn kept_ranges(&self) -> impl Iterator<Item = Range<usize>> + '_ {
        let kept = self.kept().map(|Supervariable(i)| i);
        kept.map(|i| self.rows(i)).filter(|range| !range.is_empty())
    }
}
