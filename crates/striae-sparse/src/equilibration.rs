//! Row and column scaling by powers of two, so that the scaled matrix
//! `R A C` has largest magnitudes near one in every row and column.
//!
//! Simultaneous scaling by square roots of the norms (Ruiz, RAL-TR-2001-034),
//! rounded to powers of two so that scaling itself makes no round-off and a
//! symmetric matrix stays symmetric.

use crate::{error::SolveError, matrix::SparseMatrix};
use rayon::prelude::*;

/// Most sweeps over the matrix; each halves the exponents that are left.
const SWEEPS: usize = 12;

/// Row factors `R` and column factors `C`.
#[derive(Clone, Debug, Default)]
pub struct Equilibration {
    /// `R`.
    pub rows: Vec<f64>,
    /// `C`.
    pub columns: Vec<f64>,
}

impl Equilibration {
    /// Factors for a matrix; rows and columns that are zero are left alone.
    pub fn of(matrix: &SparseMatrix) -> Result<Self, SolveError> {
        check_finite(matrix)?;
        let n = matrix.structure().unknowns();
        let mut scaling = Self {
            rows: vec![1.0; n],
            columns: vec![1.0; n],
        };
        for _ in 0..SWEEPS {
            let (r, c) = (&scaling.rows, &scaling.columns);
            let (rows, columns) = matrix.scaled_maxima(|i, j| r[i] * c[j]);
            let settled = |maxima: &[f64]| maxima.iter().all(|&m| root(m) == 1.0);
            if settled(&rows) && settled(&columns) {
                break;
            }
            scaling
                .rows
                .iter_mut()
                .zip(&rows)
                .for_each(|(s, &m)| *s *= root(m));
            scaling
                .columns
                .iter_mut()
                .zip(&columns)
                .for_each(|(s, &m)| *s *= root(m));
        }
        Ok(scaling)
    }

    /// `b := R b`, from the equations of `A` to those of `R A C`.
    pub fn scale_rows(&self, b: &mut [f64]) {
        b.iter_mut().zip(&self.rows).for_each(|(b, r)| *b *= r);
    }

    /// `x := C x`, from the unknowns of `R A C` to those of `A`.
    pub fn scale_columns(&self, x: &mut [f64]) {
        x.iter_mut().zip(&self.columns).for_each(|(x, c)| *x *= c);
    }
}

/// Power of two nearest to `1/sqrt(maximum)` in the exponent; one for zero.
pub fn root(maximum: f64) -> f64 {
    if maximum == 0.0 {
        return 1.0;
    }
    (-(0.5 * maximum.log2()).round()).exp2()
}

/// Refuses a matrix with an entry that is infinite or not a number.
pub fn check_finite(matrix: &SparseMatrix) -> Result<(), SolveError> {
    let pieces = matrix.values().par_chunks(1 << 14);
    // A sum, in which nothing that is not finite is lost, needs no branches.
    if pieces.all(|piece| piece.iter().fold(0.0, |sum, a| sum + 0.0 * a) == 0.0) {
        return Ok(());
    }
    let finite = |&row: &usize| matrix.row(row).all(|(_, a)| a.is_finite());
    let row = (0..matrix.structure().unknowns())
        .find(|row| !finite(row))
        .unwrap_or(0);
    Err(SolveError::NotFinite { row })
}
