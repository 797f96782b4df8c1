//! Partial LU of a dense front with threshold pivoting among its pivot rows.
//!
//! The front is `m x m`; its first `summed` rows and columns are fully summed. It is kept in three
//! column-major pieces: `left` (`m x summed`), `above` (`summed x rest`) and `rest` (`rest x rest`,
//! the contribution). A column is eliminated if one of the fully summed rows has an entry of at
//! least [`THRESHOLD`] times the largest in the column; otherwise it moves to the end and, when
//! nothing more can be eliminated, is left to the parent. The elimination is recursive (Toledo,
//! doi:10.1137/S0895479896297744), so nearly all work is in matrix products.
//!
//! Products are cut into pieces of columns whose number depends on the sizes
//! alone: the result is the same to the last bit for any number of threads.

use faer::{
    Accum, Par,
    linalg::{matmul::matmul, triangular_solve::solve_unit_lower_triangular_in_place},
    mat::{MatMut, MatRef},
    prelude::*,
};
use rayon::prelude::*;

/// Share of the largest entry in its column that a pivot must have.
pub const THRESHOLD: f64 = 0.01;
/// Largest magnitude in a column of the equilibrated matrix that counts as zero.
const TINY: f64 = 4.0 * f64::EPSILON;
/// Pivot that replaces a zero in a front without a parent.
const REPLACEMENT: f64 = 1.0 / ((1_u64 << 26) as f64);
/// Columns that are eliminated one by one.
const NARROW: usize = 8;
/// Work below which threads are not worth their overhead.
const PARALLEL_FLOPS: usize = 4_000_000;
const PARALLEL_SWAPS: usize = 1 << 15;
/// Fewest columns in a piece of a product, and the work in a piece of rows.
const COLUMNS: usize = 96;
const ROWS_FLOPS: usize = 500_000;

/// Treatment of columns that cannot be eliminated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Leftover {
    /// The columns are left to the parent.
    Delay,
    /// There is no parent: a replacement pivot is put in.
    Replace,
}

/// The fully summed columns of a front during elimination.
pub struct Panel<'a> {
    values: &'a mut [f64],
    size: usize,
    summed: usize,
    rows: &'a mut [u32],
    columns: &'a mut [u32],
    /// Row that came to position `k` by the swap of step `k`.
    swaps: Vec<usize>,
}

/// Outcome of an elimination.
#[derive(Clone, Copy, Debug)]
pub struct Eliminated {
    /// Pivots that were eliminated.
    pub pivots: usize,
    /// Number of columns with replaced pivots.
    pub replaced: usize,
    /// Smallest magnitude of a pivot.
    pub smallest: f64,
}

/// Eliminates what can be eliminated; `rows` and `columns` name the unknowns
/// of the front and are permuted along with it.
pub fn eliminate(
    left: &mut [f64],
    above: &mut [f64],
    rest: &mut [f64],
    rows: &mut [u32],
    columns: &mut [u32],
    leftover: Leftover,
) -> Eliminated {
    let size = rows.len();
    let summed = left.len().checked_div(size).unwrap_or(0);
    let swaps = Vec::with_capacity(summed);
    let mut panel = Panel {
        values: left,
        size,
        summed,
        rows,
        columns,
        swaps,
    };
    let replaced = panel.eliminate_all(leftover);
    let pivots = panel.swaps.len();
    let smallest = (0..pivots)
        .map(|k| panel.values[k * size + k].abs())
        .fold(f64::INFINITY, f64::min);
    let swaps = std::mem::take(&mut panel.swaps);
    update_border(panel.values, above, rest, &swaps, size);
    Eliminated {
        pivots,
        replaced,
        smallest,
    }
}

impl Panel<'_> {
    fn eliminate_all(&mut self, leftover: Leftover) -> usize {
        let mut replaced = 0;
        while self.swaps.len() < self.summed {
            let k = self.swaps.len();
            let found = self.factor(k, self.summed);
            self.swap_rows(k..k + found, 0..k);
            if found == 0 {
                if leftover == Leftover::Delay {
                    break;
                }
                self.values[k * self.size + k] = REPLACEMENT;
                replaced += 1;
            }
        }
        replaced
    }

    /// Eliminates among columns `begin..end`; `begin` pivots are done before.
    ///
    /// Returns the number of new pivots, which come first. All columns in the
    /// range are up to date, those outside have seen neither swaps nor updates.
    fn factor(&mut self, begin: usize, end: usize) -> usize {
        if end - begin <= NARROW {
            return self.factor_narrow(begin, end);
        }
        let half = ((end - begin) / 2).next_multiple_of(NARROW);
        let middle = begin + half.min(end - begin - 1);
        let first = begin + self.factor(begin, middle);
        self.swap_rows(begin..first, middle..end);
        self.update(begin..first, middle..end);
        let failed = middle - first;
        for c in 0..failed.min(end - middle) {
            self.swap_columns(first + c, end - 1 - c);
        }
        let second = first + self.factor(first, end - failed);
        self.swap_rows(first..second, begin..first);
        self.swap_rows(first..second, end - failed..end);
        self.update(first..second, end - failed..end);
        second - begin
    }

    /// Right-looking elimination column by column.
    fn factor_narrow(&mut self, begin: usize, mut end: usize) -> usize {
        let (size, last) = (self.size, end);
        let mut k = begin;
        while k < end {
            let Some(row) = self.pivot_row(k) else {
                end -= 1;
                self.swap_columns(k, end);
                continue;
            };
            self.swaps.push(row);
            self.rows.swap(k, row);
            for c in begin..last {
                self.values.swap(c * size + k, c * size + row);
            }
            let (done, todo) = self.values.split_at_mut((k + 1) * size);
            let column = &mut done[k * size + k..];
            let inverse = 1.0 / column[0];
            column[1..].iter_mut().for_each(|l| *l *= inverse);
            let lower = &column[1..];
            for target in todo.chunks_exact_mut(size).take(last - k - 1) {
                let factor = target[k];
                if factor != 0.0 {
                    let below = &mut target[k + 1..];
                    below
                        .iter_mut()
                        .zip(lower)
                        .for_each(|(t, l)| *t -= factor * l);
                }
            }
            k += 1;
        }
        k - begin
    }

    /// Fully summed row with an acceptable pivot for column `k`.
    fn pivot_row(&self, k: usize) -> Option<usize> {
        let column = &self.values[k * self.size..][..self.size];
        let (mut row, mut best) = (k, 0.0);
        for (r, value) in column.iter().enumerate().take(self.summed).skip(k) {
            if value.abs() > best {
                (row, best) = (r, value.abs());
            }
        }
        let others = column[self.summed..]
            .iter()
            .fold(0.0_f64, |m, v| m.max(v.abs()));
        (best > TINY && best >= THRESHOLD * others).then_some(row)
    }

    /// Applies the row swaps of some steps to some columns.
    fn swap_rows(&mut self, steps: std::ops::Range<usize>, columns: std::ops::Range<usize>) {
        if steps.is_empty() {
            return;
        }
        let swaps = &self.swaps;
        let swap = |column: &mut [f64]| steps.clone().for_each(|k| column.swap(k, swaps[k]));
        let work = steps.len() * columns.len();
        let columns = &mut self.values[columns.start * self.size..columns.end * self.size];
        if work > PARALLEL_SWAPS {
            let columns = columns.par_chunks_exact_mut(self.size);
            columns.with_min_len(COLUMNS).for_each(swap);
        } else {
            columns.chunks_exact_mut(self.size).for_each(swap);
        }
    }

    fn swap_columns(&mut self, a: usize, b: usize) {
        if a == b {
            return;
        }
        let (low, high) = (a.min(b), a.max(b));
        self.columns.swap(low, high);
        let (left, right) = self.values.split_at_mut(high * self.size);
        left[low * self.size..][..self.size].swap_with_slice(&mut right[..self.size]);
    }

    /// Eliminates finished pivots from later columns.
    fn update(&mut self, pivots: std::ops::Range<usize>, columns: std::ops::Range<usize>) {
        let (size, count) = (self.size, pivots.len());
        if count == 0 || columns.is_empty() {
            return;
        }
        let (done, todo) = self.values.split_at_mut(columns.start * size);
        let finished = matrix(&done[pivots.start * size..], size, count);
        let lower = finished.submatrix(pivots.start, 0, count, count);
        let below = finished.submatrix(pivots.end, 0, size - pivots.end, count);
        let todo = &mut todo[..columns.len() * size];
        for_pieces(todo, size, count * size * columns.len(), |piece| {
            let width = piece.len() / size;
            let piece = MatMut::from_column_major_slice_mut(piece, size, width);
            let (_, piece) = piece.split_at_row_mut(pivots.start);
            let (mut upper, rest) = piece.split_at_row_mut(count);
            solve_unit_lower_triangular_in_place(lower, upper.rb_mut(), Par::Seq);
            if columns.len() <= COLUMNS {
                subtract_by_rows(rest, below, upper.rb());
            } else {
                matmul(rest, Accum::Add, below, upper.rb(), -1.0, Par::Seq);
            }
        });
    }
}

/// `c -= a b` where there are few columns: threads share the rows.
fn subtract_by_rows(c: MatMut<'_, f64>, a: MatRef<'_, f64>, b: MatRef<'_, f64>) {
    if c.nrows() * b.nrows() * b.ncols() < 2 * ROWS_FLOPS {
        return matmul(c, Accum::Add, a, b, -1.0, Par::Seq);
    }
    let half = (c.nrows() / 2).next_multiple_of(NARROW);
    let ((c, c_below), (a, a_below)) = (c.split_at_row_mut(half), a.split_at_row(half));
    rayon::join(
        || subtract_by_rows(c, a, b),
        || subtract_by_rows(c_below, a_below, b),
    );
}

/// Border columns: row swaps, `above := L^-1 above`, `rest -= L_below above`.
fn update_border(left: &[f64], above: &mut [f64], rest: &mut [f64], swaps: &[usize], size: usize) {
    let (summed, pivots) = (left.len().checked_div(size).unwrap_or(0), swaps.len());
    let width = size - summed;
    if width == 0 || summed == 0 || pivots == 0 {
        return;
    }
    let finished = matrix(left, size, pivots);
    let lower = finished.submatrix(0, 0, pivots, pivots);
    let delayed = finished.submatrix(pivots, 0, summed - pivots, pivots);
    let below = finished.submatrix(summed, 0, width, pivots);
    let piece = piece(width);
    let work = |(above, rest): (&mut [f64], &mut [f64])| {
        for column in above.chunks_exact_mut(summed) {
            swaps
                .iter()
                .enumerate()
                .for_each(|(k, &row)| column.swap(k, row));
        }
        let count = above.len() / summed;
        let above = MatMut::from_column_major_slice_mut(above, summed, count);
        let (mut upper, late) = above.split_at_row_mut(pivots);
        solve_unit_lower_triangular_in_place(lower, upper.rb_mut(), Par::Seq);
        if late.nrows() > 0 {
            matmul(late, Accum::Add, delayed, upper.rb(), -1.0, Par::Seq);
        }
        let rest = MatMut::from_column_major_slice_mut(rest, width, count);
        matmul(rest, Accum::Add, below, upper.rb(), -1.0, Par::Seq);
    };
    let pieces = (piece * summed, piece * width);
    if pivots * width * width > PARALLEL_FLOPS {
        above
            .par_chunks_mut(pieces.0)
            .zip(rest.par_chunks_mut(pieces.1))
            .for_each(work);
    } else {
        above
            .chunks_mut(pieces.0)
            .zip(rest.chunks_mut(pieces.1))
            .for_each(work);
    }
}

/// Calls `work` on pieces of whole columns, in parallel if there is much to do.
fn for_pieces(
    columns: &mut [f64],
    size: usize,
    flops: usize,
    work: impl Fn(&mut [f64]) + Send + Sync,
) {
    let piece = piece(columns.len() / size) * size;
    if flops > PARALLEL_FLOPS {
        columns.par_chunks_mut(piece).for_each(work);
    } else {
        columns.chunks_mut(piece).for_each(work);
    }
}

/// Columns in a piece of a product with so many columns.
fn piece(columns: usize) -> usize {
    (columns / 8).clamp(COLUMNS, 512)
}

fn matrix(values: &[f64], rows: usize, columns: usize) -> MatRef<'_, f64> {
    MatRef::from_column_major_slice(&values[..rows * columns], rows, columns)
}
