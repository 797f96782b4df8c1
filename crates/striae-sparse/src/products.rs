//! Products of a sparse matrix with vectors.
//!
//! The rows of a supervariable have the same columns, so that the entries of the
//! vector are collected once for all of them. Threads share the supervariables
//! in fixed pieces.

use crate::{
    matrix::SparseMatrix,
    triangular::{Block, subtract_transposed},
};
use rayon::prelude::*;
use std::ops::Range;

/// Supervariables in a piece.
const PIECE: usize = 256;

/// A square matrix that is known by its products with vectors.
pub trait LinearOperator: Sync {
    /// Number of rows and columns.
    fn unknowns(&self) -> usize;

    /// `y = A x`.
    ///
    /// # Panics
    /// When a vector does not have one entry per unknown.
    fn multiply(&self, x: &[f64], y: &mut [f64]);

    /// Sums over each row of `A x`, with unknowns measured in `units`.
    fn row_sums(&self, x: &[f64], units: &[f64]) -> Vec<RowSums>;

    /// `b - A x` and its componentwise backward error, unknowns measured in `units`.
    fn residual(&self, x: &[f64], b: &[f64], units: &[f64]) -> Residual {
        let sizes = x.iter().zip(units).map(|(x, unit)| x.abs() / unit);
        let largest = sizes.fold(0.0, f64::max);
        let round_off = 1000.0 * x.len() as f64 * f64::EPSILON;
        let mut backward_error = 0.0;
        let sums = self.row_sums(x, units);
        let rows = sums.iter().zip(b).map(|(row, b)| {
            let r = b - row.product;
            let bound = row.norm * largest + b.abs();
            let size = row.terms + b.abs();
            let size = if size > round_off * bound {
                size
            } else {
                row.terms + row.norm * largest
            };
            let error = if r == 0.0 { 0.0 } else { r.abs() / size };
            // `f64::max` would drop an error that is not a number.
            if error > backward_error || error.is_nan() {
                backward_error = error;
            }
            r
        });
        let values = rows.collect();
        Residual {
            values,
            backward_error,
        }
    }
}

/// Sums over a row of `A x`.
#[derive(Clone, Copy, Debug, Default)]
pub struct RowSums {
    /// Of `a x`.
    pub product: f64,
    /// Of `|a x|`.
    pub terms: f64,
    /// Of `|a|` in the units of `x`.
    pub norm: f64,
}

impl RowSums {
    /// Adds an entry `a` whose unknown is `x`.
    pub fn add(&mut self, a: f64, x: f64, unit: f64) {
        self.product += a * x;
        self.terms += (a * x).abs();
        self.norm += a.abs() * unit;
    }
}

impl LinearOperator for SparseMatrix {
    fn unknowns(&self) -> usize {
        self.structure().unknowns()
    }

    fn multiply(&self, x: &[f64], y: &mut [f64]) {
        Self::multiply(self, x, y);
    }

    fn row_sums(&self, x: &[f64], units: &[f64]) -> Vec<RowSums> {
        let mut rows = vec![RowSums::default(); x.len()];
        self.by_pieces(&mut rows, |supervariables, rows| {
            let mut rest = rows;
            let mut own = Vec::new();
            for i in supervariables {
                own.clear();
                for group in self.structure().column_groups(i) {
                    own.extend(x[group.clone()].iter().zip(&units[group]));
                }
                let (rows, others) = rest.split_at_mut(self.structure().group(i).len());
                rest = others;
                for (local, row) in rows.iter_mut().enumerate() {
                    let values = &self.values()[self.structure().row(i, local)];
                    for (&a, &(&x, &unit)) in values.iter().zip(&own) {
                        row.add(a, x, unit);
                    }
                }
            }
        });
        rows
    }
}

impl SparseMatrix {
    /// `y = A x`.
    ///
    /// # Panics
    /// When a vector does not have one entry per unknown.
    pub fn multiply(&self, x: &[f64], y: &mut [f64]) {
        assert_eq!(
            (x.len(), y.len()),
            (self.structure().unknowns(), self.structure().unknowns())
        );
        self.by_pieces(y, |supervariables, y| {
            let mut rest = y;
            let mut own = Vec::new();
            for i in supervariables {
                // With the other sign, as products are subtracted.
                own.clear();
                for group in self.structure().column_groups(i) {
                    own.extend(x[group].iter().map(|x| -x));
                }
                let (rows, others) = rest.split_at_mut(self.structure().group(i).len());
                rest = others;
                rows.fill(0.0);
                let values = &self.values()[self.structure().row(i, 0).start..];
                subtract_transposed(rows, Block::new(values, own.len()), &own);
            }
        });
    }

    /// Calls `work` for pieces of the supervariables with their parts of a vector, on all threads.
    fn by_pieces<T: Send>(
        &self,
        mut v: &mut [T],
        work: impl Fn(Range<usize>, &mut [T]) + Send + Sync,
    ) {
        let count = self.structure().supervariables();
        let mut pieces = Vec::with_capacity(count.div_ceil(PIECE));
        for begin in (0..count).step_by(PIECE) {
            let end = (begin + PIECE).min(count);
            let rows = self.structure().group(end - 1).end - self.structure().group(begin).start;
            let (own, others) = v.split_at_mut(rows);
            v = others;
            pieces.push((begin..end, own));
        }
        pieces
            .into_par_iter()
            .for_each(|(range, own)| work(range, own));
    }
}

/// Residual of a linear system.
pub struct Residual {
    /// `b - A x`.
    pub values: Vec<f64>,
    /// Componentwise backward error.
    pub backward_error: f64,
}
