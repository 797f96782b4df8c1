//! Row and column scaling by powers of two, so that the scaled matrix
//! `R A C` has largest magnitudes near one in every row and column.
//!
//! Simultaneous scaling by square roots of the norms (Ruiz, RAL-TR-2001-034),
//! rounded to powers of two so that scaling itself makes no round-off and a
//! symmetric matrix stays symmetric.

use crate::{error::SolveError, matrix::SparseMatrix, structure::Supervariable};
use rayon::prelude::*;

/// Most sweeps over the matrix; each halves the exponents that are left.
const SWEEPS: usize = 12;

/// Row factors `R` and column factors `C`.
#[derive(Clone, Debug, Default)]
pub(crate) struct Equilibration {
    pub(crate) rows: Vec<f64>,
    pub(crate) columns: Vec<f64>,
}

impl Equilibration {
    /// Factors for a matrix; rows and columns that are zero are left alone.
    pub(crate) fn of(matrix: &SparseMatrix) -> Result<Self, SolveError> {
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

    /// Factors from the diagonal of the bulk, for the condensed solver.
    ///
    /// Bulk unknowns and their rows get `1/sqrt|a_ii|`. The multipliers of a
    /// supervariable are scaled alike, to the largest entry that bulk rows have in
    /// their columns: one that acts on prescribed unknowns leaves no more than
    /// round-off there. Their rows are scaled to the largest entry. Multipliers
    /// that only other multipliers know come last.
    ///
    /// With an `older` one the bulk unknowns keep its factors.
    pub(crate) fn by_diagonal(
        matrix: &SparseMatrix,
        older: Option<&Self>,
    ) -> Result<Self, SolveError> {
        check_finite(matrix)?;
        let structure = matrix.structure();
        let n = structure.unknowns();
        let mut scaling = Self {
            rows: vec![1.0; n],
            columns: vec![1.0; n],
        };
        let mut multipliers = Vec::new();
        for i in 0..structure.supervariables() {
            let bulk = structure.bulk_group(i);
            multipliers.extend(bulk.end..structure.group(i).end);
            for u in bulk {
                let scale = match older {
                    Some(older) => older.columns[u],
                    None => root(matrix.get(u, u).unwrap_or(0.0).abs()),
                };
                (scaling.rows[u], scaling.columns[u]) = (scale, scale);
            }
        }
        let mut is_multiplier = vec![false; n];
        multipliers.iter().for_each(|&m| is_multiplier[m] = true);
        let mut largest = vec![0.0_f64; n];
        for i in (0..structure.supervariables()).filter(|&i| structure.is_kept(Supervariable(i))) {
            for edge in structure.edges(i) {
                let target = structure.target(edge);
                let own = structure.bulk_group(target).end..structure.group(target).end;
                if own.is_empty() {
                    continue;
                }
                let offset = structure.column(edge) + own.start - structure.group(target).start;
                for (local, u) in structure.bulk_group(i).enumerate() {
                    let values = &matrix.values()[structure.row(i, local)][offset..];
                    for (v, a) in own.clone().zip(values) {
                        largest[v] = largest[v].max(a.abs() * scaling.rows[u]);
                    }
                }
            }
        }
        for i in 0..structure.supervariables() {
            let bulk = structure.bulk_group(i);
            if !bulk.is_empty() {
                let own = &mut largest[bulk.end..structure.group(i).end];
                let common = own.iter().copied().fold(0.0, f64::max);
                own.fill(common);
            }
        }
        multipliers
            .iter()
            .for_each(|&m| scaling.columns[m] = inverse(largest[m]));
        for &m in &multipliers {
            let known = |v: usize| !is_multiplier[v] || largest[v] > 0.0;
            let entries = matrix.row(m).filter(|&(v, _)| known(v));
            let size = entries.map(|(v, a)| a.abs() * scaling.columns[v]);
            scaling.rows[m] = inverse(size.fold(0.0, f64::max));
        }
        let unknown = |v: usize| is_multiplier[v] && largest[v] == 0.0;
        let mut late = vec![0.0_f64; n];
        for &m in &multipliers {
            for (v, a) in matrix.row(m).filter(|&(v, _)| unknown(v)) {
                late[v] = late[v].max(a.abs() * scaling.rows[m]);
            }
        }
        for &m in multipliers.iter().filter(|&&m| unknown(m)) {
            scaling.columns[m] = inverse(late[m]);
        }
        for &m in &multipliers {
            let sizes = matrix.row(m).map(|(v, a)| a.abs() * scaling.columns[v]);
            scaling.rows[m] = inverse(sizes.fold(0.0, f64::max));
        }
        Ok(scaling)
    }

    /// `b := R b`, from the equations of `A` to those of `R A C`.
    pub(crate) fn scale_rows(&self, b: &mut [f64]) {
        b.iter_mut().zip(&self.rows).for_each(|(b, r)| *b *= r);
    }

    /// `x := C x`, from the unknowns of `R A C` to those of `A`.
    pub(crate) fn scale_columns(&self, x: &mut [f64]) {
        x.iter_mut().zip(&self.columns).for_each(|(x, c)| *x *= c);
    }
}

/// Power of two nearest to `1/sqrt(maximum)` in the exponent; one for zero.
fn root(maximum: f64) -> f64 {
    if maximum == 0.0 {
        return 1.0;
    }
    (-(0.5 * maximum.log2()).round()).exp2()
}

/// Power of two nearest to `1/maximum` in the exponent; one for zero.
fn inverse(maximum: f64) -> f64 {
    if maximum == 0.0 {
        return 1.0;
    }
    (-maximum.log2().round()).exp2()
}

fn check_finite(matrix: &SparseMatrix) -> Result<(), SolveError> {
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
