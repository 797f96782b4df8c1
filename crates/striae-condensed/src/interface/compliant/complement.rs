//! The dense system of the multipliers, `G_m - G F C`.
//!
//! Columns are taken in panels. The columns of `C` of a panel have entries in few rows, which
//! lie in runs, as unknowns are numbered along the mesh: `F C` is a product of a few blocks of
//! columns of `F`. `G F C` combines rows of that, with vector instructions.

use super::couplings::Couplings;
use crate::interface::{Kind, flexibility::Inverse};
use faer::{
    Accum, Par,
    linalg::matmul::matmul,
    mat::{MatMut, MatRef},
};
use pulp::{Simd, WithSimd};
use rayon::prelude::*;
use std::ops::Range;
use striae_sparse::{Real, sparse_elimination::Row};

/// Columns of `F C` that are worked on at a time.
const WIDTH: usize = 64;
/// Rows without entries between two with entries that are taken along.
const GAP: usize = 12;
/// Not a row of a panel.
const NONE: u32 = u32::MAX;

/// `G_m - G F C`, column by column.
pub(super) fn complement<T: Real>(
    kinds: &[Kind],
    rows: &Couplings,
    multipliers: &[u32],
    inverses: &[Inverse<T>],
) -> Vec<f64> {
    let count = multipliers.len();
    let mut number = vec![NONE; kinds.len()];
    for (at, &k) in multipliers.iter().enumerate() {
        number[k as usize] = at as u32;
    }
    // Where the bulk unknowns are in a panel of `F C`, and the columns of `C`.
    let mut at = vec![NONE; kinds.len()];
    let mut columns = vec![Row::new(); count];
    let mut order = 0;
    for inverse in inverses {
        for &k in &inverse.places {
            at[k as usize] = order;
            order += 1;
            for &(c, a) in rows.with_multipliers(k as usize) {
                columns[number[c as usize] as usize].push((k, a));
            }
        }
    }
    let constraints: Vec<Constraint<T>> = multipliers
        .par_iter()
        .map(|&k| Constraint::new((rows, k as usize), &at, &number))
        .collect();
    let mut complement = vec![0.0; count * count];
    let panels = complement.par_chunks_mut((count * WIDTH).max(1));
    panels
        .zip(columns.par_chunks(WIDTH))
        .enumerate()
        .for_each(|(k, (target, columns))| {
            let mut panel = vec![T::default(); order as usize * WIDTH];
            let mut first = 0;
            for inverse in inverses {
                let end = first + inverse.places.len() * WIDTH;
                multiplied(
                    inverse,
                    columns,
                    (&at, first / WIDTH),
                    &mut panel[first..end],
                );
                first = end;
            }
            let first = (k * WIDTH) as u32;
            for (row, constraint) in constraints.iter().enumerate() {
                let mut entries = [T::default(); WIDTH];
                let multiplied = Combined {
                    bulk: &constraint.bulk,
                    panel: &panel,
                    entries: &mut entries,
                };
                pulp::Arch::new().dispatch(multiplied);
                for &(column, a) in &constraint.multipliers {
                    if let Some(lane) = column.checked_sub(first)
                        && (lane as usize) < columns.len()
                    {
                        entries[lane as usize] += T::of(a);
                    }
                }
                let targets = target.iter_mut().skip(row).step_by(count);
                targets.zip(&entries).for_each(|(t, e)| *t = e.double());
            }
        });
    complement
}

/// A row of `[G G_m]`.
struct Constraint<T> {
    /// Rows of the panel and entries with the other sign.
    bulk: Vec<(u32, T)>,
    /// Numbers of multipliers and entries.
    multipliers: Row,
}

impl<T: Real> Constraint<T> {
    fn new((rows, row): (&Couplings, usize), at: &[u32], number: &[u32]) -> Self {
        let bulk = rows.with_bulk(row).iter();
        let bulk = bulk.filter(|e| at[e.0 as usize] != NONE);
        let others = rows.with_multipliers(row).iter();
        Self {
            bulk: bulk.map(|&(k, a)| (at[k as usize], T::of(-a))).collect(),
            multipliers: others.map(|&(k, a)| (number[k as usize], a)).collect(),
        }
    }
}

/// `F C` for some columns and one body, row by row.
fn multiplied<T: Real>(
    inverse: &Inverse<T>,
    columns: &[Row],
    (at, first): (&[u32], usize),
    panel: &mut [T],
) {
    let n = inverse.places.len();
    let own = |k: u32| {
        (at[k as usize] as usize)
            .checked_sub(first)
            .filter(|&i| i < n)
    };
    // Rows in which the columns have entries.
    let mut place = vec![NONE; n];
    let entries = columns.iter().flatten();
    entries
        .filter_map(|&(k, _)| own(k))
        .for_each(|i| place[i] = 0);
    let runs = runs(&place);
    let mut dense: Vec<T> = Vec::new();
    for run in &runs {
        for i in run.clone() {
            place[i] = (dense.len() / WIDTH) as u32;
            dense.resize(dense.len() + WIDTH, T::default());
        }
    }
    for (lane, column) in columns.iter().enumerate() {
        for &(k, a) in column {
            if let Some(i) = own(k) {
                dense[place[i] as usize * WIDTH + lane] += T::of(a);
            }
        }
    }
    for run in runs {
        let first = place[run.start] as usize * WIDTH;
        matmul(
            MatMut::from_row_major_slice_mut(panel, n, WIDTH),
            Accum::Add,
            MatRef::from_column_major_slice(
                &inverse.values[run.start * n..run.end * n],
                n,
                run.len(),
            ),
            MatRef::from_row_major_slice(&dense[first..][..run.len() * WIDTH], run.len(), WIDTH),
            T::of(1.0),
            Par::Seq,
        );
    }
}

/// Ranges of rows that are marked, with gaps too short to be worth a product of their own.
fn runs(marked: &[u32]) -> Vec<Range<usize>> {
    let mut runs: Vec<Range<usize>> = Vec::new();
    for i in (0..marked.len()).filter(|&i| marked[i] != NONE) {
        match runs.last_mut().filter(|run| i - run.end <= GAP) {
            Some(run) => run.end = i + 1,
            None => runs.push(i..i + 1),
        }
    }
    runs
}

/// A sparse combination of the rows of a panel.
struct Combined<'a, T> {
    bulk: &'a [(u32, T)],
    panel: &'a [T],
    entries: &'a mut [T; WIDTH],
}

impl<T: Real> WithSimd for Combined<'_, T> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let (sums, _) = T::lanes_mut::<S>(self.entries);
        for &(row, factor) in self.bulk {
            let (values, _) = T::lanes::<S>(&self.panel[row as usize * WIDTH..][..WIDTH]);
            let factor = T::splat(simd, factor);
            for (sum, value) in sums.iter_mut().zip(values) {
                *sum = T::multiply_add(simd, *value, factor, *sum);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn runs_of_rows_with_short_gaps_are_taken_together() {
        let marks = |rows: &[usize]| {
            let mut marked = vec![NONE; 60];
            rows.iter().for_each(|&row| marked[row] = 0);
            runs(&marked)
        };
        assert_eq!(marks(&[]), []);
        assert_eq!(marks(&[3, 4, 5, 16, 40]), [3..17, 40..41]);
    }
}
