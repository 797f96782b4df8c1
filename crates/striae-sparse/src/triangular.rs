//! Products and triangular solutions with one vector, which read a factor once.
//!
//! Blocks are column-major. Four columns are taken at a time and sums go to
//! several accumulators, so that loops become vector instructions and memory
//! sets the pace. Every entry of a result is summed in an order that depends on
//! the sizes alone: threads, which share rows or columns of large blocks among
//! them, do not change a bit.

use crate::real::Real;
use pulp::{Simd, WithSimd};
use rayon::prelude::*;

/// Entries of a block below which threads are not worth their overhead.
const PARALLEL: usize = 1 << 16;
/// Rows or columns of a block for one thread at a time.
const ROWS: usize = 512;
const COLUMNS: usize = 16;
/// Columns of a triangle between two products with all that is below or above.
const PANEL: usize = 128;
/// Columns of a triangle that are solved one by one.
const NARROW: usize = 8;
/// Columns of a product at a time.
const WIDTH: usize = 4;

/// Columns of a column-major matrix, from some row on.
#[derive(Clone, Copy)]
pub struct Block<'a, T = f64> {
    values: &'a [T],
    stride: usize,
}

/// Diagonal of a triangular matrix.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Diagonal {
    /// The stored values.
    Stored,
    /// Ones.
    Unit,
}

impl<'a, T: Real> Block<'a, T> {
    /// A matrix whose columns begin so many values after each other.
    pub fn new(values: &'a [T], stride: usize) -> Self {
        Self { values, stride }
    }

    /// The block that begins at an entry.
    pub fn at(self, row: usize, column: usize) -> Self {
        let begin = (column * self.stride + row).min(self.values.len());
        Self {
            values: &self.values[begin..],
            stride: self.stride,
        }
    }

    /// First rows of a column.
    fn column(self, column: usize, rows: usize) -> &'a [T] {
        &self.values[column * self.stride..][..rows]
    }

    /// `b` over an entry of the diagonal.
    fn divide(self, k: usize, diagonal: Diagonal, b: T) -> T {
        match diagonal {
            Diagonal::Stored => b / self.values[k * self.stride + k],
            Diagonal::Unit => b,
        }
    }
}

/// `y -= A x`.
pub fn subtract<T: Real>(y: &mut [T], a: Block<'_, T>, x: &[T]) {
    if y.len() * x.len() < PARALLEL {
        subtract_rows(y, a, x);
    } else {
        let chunks = y.par_chunks_mut(ROWS).enumerate();
        chunks.for_each(|(k, y)| subtract_rows(y, a.at(k * ROWS, 0), x));
    }
}

/// `y -= A^T x`.
pub fn subtract_transposed<T: Real>(y: &mut [T], a: Block<'_, T>, x: &[T]) {
    if y.len() * x.len() < PARALLEL {
        subtract_columns(y, a, x);
    } else {
        let chunks = y.par_chunks_mut(COLUMNS).enumerate();
        chunks.for_each(|(k, y)| subtract_columns(y, a.at(0, k * COLUMNS), x));
    }
}

/// `x := L^-1 x` with a lower triangle, and `rest -= B x` with the rows `B` below it.
pub fn solve_lower<T: Real>(l: Block<'_, T>, diagonal: Diagonal, x: &mut [T], pivots: usize) {
    for panel in (0..pivots).step_by(PANEL) {
        let end = (panel + PANEL).min(pivots);
        let (own, below) = x[panel..].split_at_mut(end - panel);
        let triangle = l.at(panel, panel);
        for k in (0..own.len()).step_by(NARROW) {
            let next = (k + NARROW).min(own.len());
            let (narrow, others) = own[k..].split_at_mut(next - k);
            let block = triangle.at(k, k);
            for j in 0..narrow.len() {
                let value = block.divide(j, diagonal, narrow[j]);
                narrow[j] = value;
                let column = &block.column(j, narrow.len())[j + 1..];
                let targets = narrow[j + 1..].iter_mut().zip(column);
                targets.for_each(|(x, l)| *x -= *l * value);
            }
            subtract(others, triangle.at(next, k), narrow);
        }
        subtract(below, l.at(end, panel), own);
    }
}

/// The pivots of `x := L^-T (x - B^T rest)` with a lower triangle and the rows `B` below it.
pub fn solve_lower_transposed<T: Real>(
    l: Block<'_, T>,
    diagonal: Diagonal,
    x: &mut [T],
    pivots: usize,
) {
    for panel in (0..pivots).step_by(PANEL).rev() {
        let end = (panel + PANEL).min(pivots);
        let (own, below) = x[panel..].split_at_mut(end - panel);
        subtract_transposed(own, l.at(end, panel), below);
        let triangle = l.at(panel, panel);
        for k in (0..own.len()).step_by(NARROW).rev() {
            let next = (k + NARROW).min(own.len());
            let (narrow, others) = own[k..].split_at_mut(next - k);
            subtract_transposed(narrow, triangle.at(next, k), others);
            let block = triangle.at(k, k);
            for j in (0..narrow.len()).rev() {
                let column = &block.column(j, narrow.len())[j + 1..];
                let known = inner_product(column, &narrow[j + 1..]);
                narrow[j] = block.divide(j, diagonal, narrow[j] - known);
            }
        }
    }
}

/// `x := U^-1 x` with an upper triangle.
pub fn solve_upper<T: Real>(u: Block<'_, T>, x: &mut [T]) {
    for panel in (0..x.len()).step_by(PANEL).rev() {
        let end = (panel + PANEL).min(x.len());
        let (above, own) = x[..end].split_at_mut(panel);
        let triangle = u.at(panel, panel);
        for k in (0..own.len()).step_by(NARROW).rev() {
            let next = (k + NARROW).min(own.len());
            let (others, narrow) = own[..next].split_at_mut(k);
            let block = triangle.at(k, k);
            for j in (0..narrow.len()).rev() {
                let value = block.divide(j, Diagonal::Stored, narrow[j]);
                narrow[j] = value;
                let targets = narrow[..j].iter_mut().zip(block.column(j, j));
                targets.for_each(|(x, u)| *x -= *u * value);
            }
            subtract(others, triangle.at(0, k), narrow);
        }
        subtract(above, u.at(0, panel), own);
    }
}

/// `x := U^-T x` with an upper triangle.
pub(crate) fn solve_upper_transposed<T: Real>(u: Block<'_, T>, x: &mut [T]) {
    for panel in (0..x.len()).step_by(PANEL) {
        let end = (panel + PANEL).min(x.len());
        let (above, own) = x[..end].split_at_mut(panel);
        subtract_transposed(own, u.at(0, panel), above);
        let triangle = u.at(panel, panel);
        for k in (0..own.len()).step_by(NARROW) {
            let next = (k + NARROW).min(own.len());
            let (others, narrow) = own[..next].split_at_mut(k);
            subtract_transposed(narrow, triangle.at(0, k), others);
            let block = triangle.at(k, k);
            for j in 0..narrow.len() {
                let known = inner_product(block.column(j, j), &narrow[..j]);
                narrow[j] = block.divide(j, Diagonal::Stored, narrow[j] - known);
            }
        }
    }
}

fn subtract_rows<T: Real>(y: &mut [T], a: Block<'_, T>, x: &[T]) {
    if !y.is_empty() && !x.is_empty() {
        pulp::Arch::new().dispatch(Combination { y, a, x });
    }
}

fn subtract_columns<T: Real>(y: &mut [T], a: Block<'_, T>, x: &[T]) {
    if !y.is_empty() && !x.is_empty() {
        pulp::Arch::new().dispatch(InnerProducts { y, a, x });
    }
}

/// `y -= A x` by columns.
struct Combination<'a, T> {
    y: &'a mut [T],
    a: Block<'a, T>,
    x: &'a [T],
}

impl<T: Real> WithSimd for Combination<'_, T> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self { y, a, x } = self;
        let rows = y.len();
        let zero = T::default();
        let (y, y_end) = T::lanes_mut::<S>(y);
        let (fours, others) = x.as_chunks::<WIDTH>();
        for (k, x) in fours.iter().enumerate() {
            let columns = |j: usize| T::lanes::<S>(a.column(k * WIDTH + j, rows));
            let ((a0, e0), (a1, e1)) = (columns(0), columns(1));
            let ((a2, e2), (a3, e3)) = (columns(2), columns(3));
            let [x0, x1, x2, x3] = x.map(|x| T::splat(simd, zero - x));
            let count = y.len();
            let (a0, a1, a2, a3) = (&a0[..count], &a1[..count], &a2[..count], &a3[..count]);
            for i in 0..count {
                let first =
                    T::multiply_add(simd, a1[i], x1, T::multiply_add(simd, a0[i], x0, y[i]));
                let second = T::multiply_add(simd, a3[i], x3, T::product(simd, a2[i], x2));
                y[i] = T::plus(simd, first, second);
            }
            for (i, y) in y_end.iter_mut().enumerate() {
                let products = e0[i] * x[0] + e1[i] * x[1];
                *y -= products + (e2[i] * x[2] + e3[i] * x[3]);
            }
        }
        for (k, x) in others.iter().enumerate() {
            let (a, end) = T::lanes::<S>(a.column(fours.len() * WIDTH + k, rows));
            let factor = T::splat(simd, zero - *x);
            for (y, a) in y.iter_mut().zip(a) {
                *y = T::multiply_add(simd, *a, factor, *y);
            }
            y_end.iter_mut().zip(end).for_each(|(y, a)| *y -= *a * *x);
        }
    }
}

/// `y -= A^T x` by columns.
struct InnerProducts<'a, T> {
    y: &'a mut [T],
    a: Block<'a, T>,
    x: &'a [T],
}

impl<T: Real> WithSimd for InnerProducts<'_, T> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self { y, a, x } = self;
        let rows = x.len();
        let (x, x_end) = T::lanes::<S>(x);
        let (fours, others) = y.as_chunks_mut::<WIDTH>();
        let done = fours.len() * WIDTH;
        for (k, y) in fours.iter_mut().enumerate() {
            let columns = |j: usize| T::lanes::<S>(a.column(k * WIDTH + j, rows));
            let ((a0, e0), (a1, e1)) = (columns(0), columns(1));
            let ((a2, e2), (a3, e3)) = (columns(2), columns(3));
            let count = x.len();
            let (a0, a1, a2, a3) = (&a0[..count], &a1[..count], &a2[..count], &a3[..count]);
            let zero = T::splat(simd, T::default());
            let (mut s0, mut s1, mut s2, mut s3) = (zero, zero, zero, zero);
            let (mut t0, mut t1, mut t2, mut t3) = (zero, zero, zero, zero);
            let even = count & !1;
            for i in (0..even).step_by(2) {
                s0 = T::multiply_add(simd, a0[i], x[i], s0);
                s1 = T::multiply_add(simd, a1[i], x[i], s1);
                s2 = T::multiply_add(simd, a2[i], x[i], s2);
                s3 = T::multiply_add(simd, a3[i], x[i], s3);
                t0 = T::multiply_add(simd, a0[i + 1], x[i + 1], t0);
                t1 = T::multiply_add(simd, a1[i + 1], x[i + 1], t1);
                t2 = T::multiply_add(simd, a2[i + 1], x[i + 1], t2);
                t3 = T::multiply_add(simd, a3[i + 1], x[i + 1], t3);
            }
            if even < count {
                s0 = T::multiply_add(simd, a0[even], x[even], s0);
                s1 = T::multiply_add(simd, a1[even], x[even], s1);
                s2 = T::multiply_add(simd, a2[even], x[even], s2);
                s3 = T::multiply_add(simd, a3[even], x[even], s3);
            }
            let sums = [(s0, t0), (s1, t1), (s2, t2), (s3, t3)];
            let ends = [e0, e1, e2, e3];
            for ((y, (s, t)), end) in y.iter_mut().zip(sums).zip(ends) {
                *y -= T::total(simd, T::plus(simd, s, t)) + inner_product(end, x_end);
            }
        }
        for (k, y) in others.iter_mut().enumerate() {
            let (a, end) = T::lanes::<S>(a.column(done + k, rows));
            let mut sum = T::splat(simd, T::default());
            for (a, x) in a.iter().zip(x) {
                sum = T::multiply_add(simd, *a, *x, sum);
            }
            *y -= T::total(simd, sum) + inner_product(end, x_end);
        }
    }
}

#[inline(always)]
fn inner_product<T: Real>(a: &[T], x: &[T]) -> T {
    a.iter().zip(x).map(|(a, x)| *a * *x).sum()
}
