//! The rows of the kept supervariables, which change while others stay.

use super::SparseMatrix;
use crate::structure::{Structure, Supervariable};
use rayon::prelude::*;
use std::ops::Range;

/// Supervariables whose rows a thread copies at a time.
const OWNERS: usize = 16;

impl SparseMatrix {
    /// Values in the rows of the kept supervariables.
    pub fn kept_rows(&self) -> Vec<f64> {
        let count = kept_rows(&self.structure).map(|range| range.len()).sum();
        let mut values = vec![0.0; count];
        let mut copies = Vec::new();
        let mut rest = values.as_mut_slice();
        for range in kept_rows(&self.structure) {
            let (own, others) = rest.split_at_mut(range.len());
            copies.push((own, range));
            rest = others;
        }
        let copies = copies.into_par_iter().with_min_len(OWNERS);
        copies.for_each(|(own, range)| own.copy_from_slice(&self.values[range]));
        values
    }

    /// Overwrites the rows of the kept supervariables.
    ///
    /// # Panics
    /// When there are not as many values as [`kept_rows`](Self::kept_rows) returns.
    pub fn set_kept_rows(&mut self, values: &[f64]) {
        let mut rest = values;
        for range in kept_rows(&self.structure) {
            let (own, others) = rest.split_at(range.len());
            self.values[range].copy_from_slice(own);
            rest = others;
        }
        assert!(rest.is_empty(), "as many values as kept rows have");
    }

    /// `y += A x` in the rows of the kept supervariables.
    ///
    /// # Panics
    /// When a vector does not have one entry per unknown.
    pub fn add_product_of_kept_rows(&self, x: &[f64], y: &mut [f64]) {
        let structure = &self.structure;
        for row in structure.kept().flat_map(|kept| structure.group(kept.0)) {
            y[row] += self.row_product(row, x);
        }
    }
}

/// Values of the rows of each kept supervariable.
fn kept_rows(structure: &Structure) -> impl Iterator<Item = Range<usize>> + '_ {
    let kept = structure.kept().map(|Supervariable(i)| i);
    kept.filter(|&i| !structure.group(i).is_empty()).map(|i| {
        let last = structure.group(i).len() - 1;
        structure.row(i, 0).start..structure.row(i, last).end
    })
}
