//! Products of columns, from which directions are eliminated.
//!
//! The matrix is sparse: columns that have no position in common have no product. Elimination fills
//! it in around each direction, where what it adds fades from node to node; entries that have faded
//! to round-off are dropped, so that the work grows with the number of columns.

use std::collections::BTreeSet;

use crate::{
    common_mass::{SparseRow, SparseSum},
    moved_pair::Column,
};

/// Entry that is dropped, over the root of the diagonal entries of its row and column.
///
/// Far below what is added to the diagonal for columns that depend on each other, whose pivots are no
/// more than that.
const FADED: f64 = 1e-12;

/// A symmetric positive semi-definite matrix by rows, both halves of it.
pub(super) struct Remainder {
    rows: Vec<SparseRow>,
    /// Roots of the diagonal entries before anything was eliminated.
    scales: Vec<f64>,
}

impl Remainder {
    /// Products of columns.
    pub(super) fn new(columns: &[&Column]) -> Self {
        let positions = columns.iter().flat_map(|column| column.keys());
        let count = positions.max().map_or(0, |last| *last as usize + 1);
        let mut users = vec![Vec::new(); count];
        for (at, column) in columns.iter().enumerate() {
            for (number, value) in *column {
                users[*number as usize].push((at as u32, value));
            }
        }
        let mut sum = SparseSum::new(columns.len());
        let row = |column: &&Column| {
            for (number, value) in *column {
                for (other, of_other) in &users[*number as usize] {
                    sum.add(*other, value.dot(of_other));
                }
            }
            sum.take()
        };
        let rows: Vec<SparseRow> = columns.iter().map(row).collect();
        let diagonal = (0..).zip(&rows).map(|(at, row)| entry(row, at));
        Self {
            scales: diagonal.map(f64::sqrt).collect(),
            rows,
        }
    }

    /// Entry of the matrix.
    pub(super) fn entry(&self, row: u32, column: u32) -> f64 {
        entry(&self.rows[row as usize], column)
    }

    /// Row of the matrix.
    pub(super) fn row(&self, row: u32) -> &SparseRow {
        &self.rows[row as usize]
    }

    /// Leaves out all rows and columns but some.
    pub(super) fn restrict(&mut self, to: &BTreeSet<u32>) {
        for (at, row) in (0..).zip(&mut self.rows) {
            match to.contains(&at) {
                true => row.retain(|(column, _)| to.contains(column)),
                false => row.clear(),
            }
        }
    }

    /// Adds to a diagonal entry.
    pub(super) fn shift(&mut self, at: u32, by: f64) {
        let row = &mut self.rows[at as usize];
        if let Ok(place) = row.binary_search_by_key(&at, |&(column, _)| column) {
            row[place].1 += by;
        }
    }

    /// Eliminates a direction, a combination of columns; nothing if it depends on those before.
    pub(super) fn eliminate(&mut self, direction: &[(u32, f64)]) {
        let (mut column, mut merged) = (SparseRow::new(), SparseRow::new());
        for &(at, by) in direction {
            merge(&column, by, &self.rows[at as usize], &mut merged, |_| true);
            std::mem::swap(&mut column, &mut merged);
        }
        let pivot: f64 = direction
            .iter()
            .map(|&(at, by)| by * entry(&column, at))
            .sum();
        if pivot <= 0.0 {
            return;
        }
        // With the root both halves of the matrix stay the same in every bit.
        let root = pivot.sqrt();
        column.iter_mut().for_each(|(_, value)| *value /= root);
        for &(at, value) in &column {
            let scale = FADED * self.scales[at as usize];
            let row = &mut self.rows[at as usize];
            let counts = |&(other, value): &(u32, f64)| {
                value.abs() > scale * self.scales[other as usize] || other == at
            };
            merge(row, -value, &column, &mut merged, counts);
            std::mem::swap(row, &mut merged);
        }
    }

    /// Takes a column out that has been eliminated.
    pub(super) fn forget(&mut self, at: u32) {
        for (other, _) in std::mem::take(&mut self.rows[at as usize]) {
            self.rows[other as usize].retain(|&(column, _)| column != at);
        }
    }
}

/// Entry of a sorted row.
fn entry(row: &[(u32, f64)], column: u32) -> f64 {
    row.binary_search_by_key(&column, |&(at, _)| at)
        .map_or(0.0, |at| row[at].1)
}

/// Writes those entries that count of the sum of a sorted row and a multiple of another one.
fn merge(
    a: &[(u32, f64)],
    by: f64,
    b: &[(u32, f64)],
    into: &mut SparseRow,
    counts: impl Fn(&(u32, f64)) -> bool,
) {
    into.clear();
    into.reserve(a.len() + b.len());
    let mut left = a;
    for &(at, value) in b {
        let before = left.iter().take_while(|(other, _)| *other < at).count();
        into.extend(left[..before].iter().filter(|entry| counts(entry)));
        left = &left[before..];
        let own = match left.first() {
            Some(&(other, own)) if other == at => {
                left = &left[1..];
                own
            }
            _ => 0.0,
        };
        into.extend(Some((at, own + by * value)).filter(|entry| counts(entry)));
    }
    into.extend(left.iter().filter(|entry| counts(entry)));
}

#[cfg(test)]
mod tests {
    use nalgebra::DMatrix;
    use proptest::prelude::*;
    use striae_mesh::Vec3;

    use super::*;

    fn column() -> impl Strategy<Value = Column> {
        let value = prop::array::uniform3(-1.0..1.0_f64).prop_map(Vec3::from);
        prop::collection::btree_map(0..9_u32, value, 1..5)
    }

    proptest! {
        #[test]
        fn elimination_is_a_schur_complement(
            columns in prop::collection::vec(column(), 2..8),
            by in prop::array::uniform2(-1.0..1.0_f64),
        ) {
            let columns: Vec<&Column> = columns.iter().collect();
            let mut remainder = Remainder::new(&columns);
            let count = columns.len();
            let dense = |of: &Remainder| {
                DMatrix::from_fn(count, count, |i, j| of.entry(i as u32, j as u32))
            };
            let before = dense(&remainder);
            prop_assert_eq!(&before, &before.transpose());
            let column = before.column(0) * by[0] + before.column(1) * by[1];
            let pivot = by[0] * column[0] + by[1] * column[1];
            prop_assume!(pivot > 1e-3);
            remainder.eliminate(&[(0, by[0]), (1, by[1])]);
            let after = dense(&remainder);
            prop_assert_eq!(&after, &after.transpose());
            let expected = before - &column * column.transpose() / pivot;
            prop_assert!((after - expected).amax() < 1e-9);
            remainder.forget(0);
            prop_assert!((1..count as u32).all(|at| remainder.entry(at, 0) == 0.0));
        }
    }
}
