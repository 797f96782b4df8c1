//! Row and column scaling by powers of two, so that the scaled matrix
//! `R A C` has largest magnitudes near one in every row and column.
//!
//! Simultaneous scaling by square roots of the norms (Ruiz, RAL-TR-2001-034),
//! rounded to powers of two so that scaling itself makes no round-off and a
//! symmetric matrix stays symmetric.

use crate::{error::SolveError, matrix::SparseMatrix, structure::Supervariable};
use rayon::prelude::*;
use std::ops::Range;

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
            multipliers.extend(structure.multiplier_group(i));
            for u in structure.bulk_group(i) {
                let scale = match older {
                    Some(older) => older.columns[u],
                    None => root(matrix.get(u, u).unwrap_or(0.0).abs()),
                };
                (scaling.rows[u], scaling.columns[u]) = (scale, scale);
            }
        }
        let mut is_multiplier = vec![false; n];
        multipliers.iter().for_each(|&m| is_multiplier[m] = true);
        let kept_bulk = |i: usize| match structure.is_kept(Supervariable(i)) {
            true => structure.bulk_group(i),
            false => 0..0,
        };
        let mut largest = largest_in_columns(matrix, &scaling.rows, |_| true, kept_bulk);
        for i in 0..structure.supervariables() {
            if !structure.bulk_group(i).is_empty() {
                let own = &mut largest[structure.multiplier_group(i)];
                let common = own.iter().copied().fold(0.0, f64::max);
                own.fill(common);
            }
        }
        multipliers
            .iter()
            .for_each(|&m| scaling.columns[m] = inverse(largest[m]));
        let unknown = |v: usize| is_multiplier[v] && largest[v] == 0.0;
        let columns: Vec<f64> = (0..n)
            .map(|v| if unknown(v) { 0.0 } else { scaling.columns[v] })
            .collect();
        scaling.scale_rows_of(matrix, &multipliers, &columns);
        let with_unknown = |i: usize| structure.multiplier_group(i).any(unknown);
        let others = |i: usize| structure.multiplier_group(i);
        let late = largest_in_columns(matrix, &scaling.rows, with_unknown, others);
        for &m in multipliers.iter().filter(|&&m| unknown(m)) {
            scaling.columns[m] = inverse(late[m]);
        }
        let columns = scaling.columns.clone();
        scaling.scale_rows_of(matrix, &multipliers, &columns);
        Ok(scaling)
    }

    /// Scales some rows to the largest of their entries times `columns`.
    fn scale_rows_of(&mut self, matrix: &SparseMatrix, rows: &[usize], columns: &[f64]) {
        let sizes = rows.par_iter().with_min_len(16);
        let sizes: Vec<f64> = sizes
            .map(|&row| inverse(largest_in_row(matrix, row, columns)))
            .collect();
        for (&row, size) in rows.iter().zip(sizes) {
            self.rows[row] = size;
        }
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

/// Largest magnitude of the entries of a row times factors of the columns.
fn largest_in_row(matrix: &SparseMatrix, row: usize, columns: &[f64]) -> f64 {
    let structure = matrix.structure();
    let i = structure.owner(row).0;
    let mut values = &matrix.values()[structure.row(i, row - structure.group(i).start)];
    let mut largest = 0.0_f64;
    for group in structure.column_groups(i) {
        let (own, others) = values.split_at(group.len());
        values = others;
        for (a, factor) in own.iter().zip(&columns[group]) {
            largest = largest.max(a.abs() * factor);
        }
    }
    largest
}

/// Largest magnitude of the entries in each column of the multipliers of some supervariables,
/// in some rows of each neighbour, times factors of the rows; zero in all other columns.
fn largest_in_columns(
    matrix: &SparseMatrix,
    factors: &[f64],
    wanted: impl Fn(usize) -> bool + Sync,
    rows: impl Fn(usize) -> Range<usize> + Sync,
) -> Vec<f64> {
    let structure = matrix.structure();
    let of_one = |&t: &usize| {
        let own = structure.multiplier_group(t);
        let mut largest = vec![0.0_f64; own.len()];
        for i in structure.edges(t).map(|edge| structure.target(edge)) {
            let rows = rows(i);
            // The pattern is symmetric, so the mirrored edge exists.
            let Some(edge) = structure.edge(i, t).filter(|_| !rows.is_empty()) else {
                continue;
            };
            let offset = structure.column(edge) + own.start - structure.group(t).start;
            for row in rows {
                let place = structure.row(i, row - structure.group(i).start);
                let entries = &matrix.values()[place][offset..];
                for (largest, a) in largest.iter_mut().zip(entries) {
                    *largest = largest.max(a.abs() * factors[row]);
                }
            }
        }
        largest
    };
    let has_any = |t: &usize| !structure.multiplier_group(*t).is_empty() && wanted(*t);
    let owners: Vec<usize> = (0..structure.supervariables()).filter(has_any).collect();
    let found: Vec<Vec<f64>> = owners.par_iter().with_min_len(8).map(of_one).collect();
    let mut largest = vec![0.0; structure.unknowns()];
    for (&t, found) in owners.iter().zip(found) {
        largest[structure.multiplier_group(t)].copy_from_slice(&found);
    }
    largest
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
