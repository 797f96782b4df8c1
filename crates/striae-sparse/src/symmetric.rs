//! Partial Cholesky factorisation of a dense front, lower triangle.
//!
//! The front is `m x m` with `p` pivots, kept as `left` (`m x p`) and `rest`,
//! the contribution on the other unknowns, both column-major. Recursive in the
//! columns; products are cut into pieces that depend on the sizes alone, so
//! that threads do not change the result.

use crate::real::Real;
use faer::{
    Accum, Par,
    linalg::matmul::matmul,
    mat::{MatMut, MatRef},
};
use rayon::prelude::*;

/// Columns that are eliminated one by one.
const NARROW: usize = 8;
/// Columns in a piece of a product.
const PIECE: usize = 96;
/// Work below which threads are not worth their overhead.
const PARALLEL_FLOPS: usize = 4_000_000;

/// Eliminates all pivots; returns position and value of the first bad one.
///
/// A bad pivot is replaced by one, so the factors are of no use then.
pub fn eliminate<T: Real>(left: &mut [T], rest: &mut [T], size: usize) -> Option<(usize, f64)> {
    let pivots = left.len().checked_div(size).unwrap_or(0);
    let failure = factor(left, size, 0, pivots);
    let width = size - pivots;
    if width > 0 && pivots > 0 {
        let below = matrix(left, size, pivots).get(pivots.., ..);
        products(rest, width, pivots, |first, piece| {
            let columns = piece.len() / width;
            let piece = MatMut::from_column_major_slice_mut(piece, width, columns);
            let (_, target) = piece.split_at_row_mut(first);
            let right = below.get(first..first + columns, ..).transpose();
            matmul(
                target,
                Accum::Add,
                below.get(first.., ..),
                right,
                T::of(-1.0),
                Par::Seq,
            );
        });
    }
    failure
}

/// Factors columns `begin..end`, which have seen all earlier pivots.
fn factor<T: Real>(left: &mut [T], size: usize, begin: usize, end: usize) -> Option<(usize, f64)> {
    if end - begin <= NARROW {
        return factor_narrow(left, size, begin, end);
    }
    let middle = begin
        + ((end - begin) / 2)
            .next_multiple_of(NARROW)
            .min(end - begin - 1);
    let first = factor(left, size, begin, middle);
    let (done, todo) = left.split_at_mut(middle * size);
    let done = matrix(&done[begin * size..], size, middle - begin);
    let todo = &mut todo[..(end - middle) * size];
    products(todo, size, middle - begin, |offset, piece| {
        let (columns, row) = (piece.len() / size, middle + offset);
        let piece = MatMut::from_column_major_slice_mut(piece, size, columns);
        let (_, target) = piece.split_at_row_mut(row);
        let right = done.get(row..row + columns, ..).transpose();
        matmul(
            target,
            Accum::Add,
            done.get(row.., ..),
            right,
            T::of(-1.0),
            Par::Seq,
        );
    });
    let second = factor(left, size, middle, end);
    first.or(second)
}

/// Right-looking elimination column by column.
fn factor_narrow<T: Real>(
    left: &mut [T],
    size: usize,
    begin: usize,
    end: usize,
) -> Option<(usize, f64)> {
    let mut failure = None;
    for k in begin..end {
        let (done, todo) = left.split_at_mut((k + 1) * size);
        let column = &mut done[k * size + k..];
        let mut pivot = column[0];
        let value = pivot.double();
        if value.is_nan() || value <= T::TINY {
            failure = failure.or(Some((k, value)));
            pivot = T::of(1.0);
        }
        column[0] = pivot.root();
        let inverse = T::of(1.0) / column[0];
        column[1..].iter_mut().for_each(|l| *l *= inverse);
        for (j, target) in todo.chunks_exact_mut(size).take(end - k - 1).enumerate() {
            let lower = &column[j + 1..];
            let factor = lower[0];
            let below = &mut target[k + 1 + j..];
            below
                .iter_mut()
                .zip(lower)
                .for_each(|(t, l)| *t -= factor * *l);
        }
    }
    failure
}

/// Calls `work` with the first column of each piece and the piece.
fn products<T: Real>(
    columns: &mut [T],
    size: usize,
    depth: usize,
    work: impl Fn(usize, &mut [T]) + Send + Sync,
) {
    let flops = columns.len() * depth;
    let numbered = |(k, piece): (usize, &mut [T])| work(k * PIECE, piece);
    if flops > PARALLEL_FLOPS {
        columns
            .par_chunks_mut(PIECE * size)
            .enumerate()
            .for_each(numbered);
    } else {
        columns
            .chunks_mut(PIECE * size)
            .enumerate()
            .for_each(numbered);
    }
}

fn matrix<T: Real>(values: &[T], rows: usize, columns: usize) -> MatRef<'_, T> {
    MatRef::from_column_major_slice(&values[..rows * columns], rows, columns)
}
