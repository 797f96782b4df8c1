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
        let mut column = SparseRow::new();
        for &(at, by) in direction {
            column = sum(&column, by, &self.rows[at as usize]).collect();
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
            let row = &self.rows[at as usize];
            let left = sum(row, -value, &column).filter(|&(other, value)| {
                value.abs() > scale * self.scales[other as usize] || other == at
            });
            self.rows[at as usize] = left.collect();
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

/// Sum of a sorted row and a multiple of another one.
fn sum<'a>(a: &'a [(u32, f64)], by: f64, b: &'a [(u32, f64)]) -> impl Iterator<Item = (u32, f64)> {
    let (mut a, mut b) = (a.iter().peekable(), b.iter().peekable());
    std::iter::from_fn(move || match (a.peek(), b.peek()) {
        (Some(&&(i, x)), Some(&&(j, y))) if i == j => {
            a.next();
            b.next();
            Some((i, x + by * y))
        }
        (Some(&&(i, x)), other) if other.is_none_or(|&&(j, _)| i < j) => {
            a.next();
            Some((i, x))
        }
        (_, Some(&&(j, y))) => {
            b.next();
            Some((j, by * y))
        }
        (_, None) => None,
    })
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
