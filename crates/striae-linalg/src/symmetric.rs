//! Partial Cholesky factorisation of a dense front, lower triangle.
//!
//! The front is `m x m` with `p` pivots, kept as `left` (`m x p`) and `rest`,
//! the contribution on the other unknowns, both column-major. Recursive in the
//! columns; products are cut into pieces that depend on the sizes alone, so
//! that threads do not change the result.

use faer::{
    Accum, Par,
    linalg::matmul::matmul,
    mat::{MatMut, MatRef},
};
use rayon::prelude::*;

/// Pivot of a matrix with unit diagonal that counts as not positive.
const TINY: f64 = 1e-13;
/// Columns that are eliminated one by one.
const NARROW: usize = 8;
/// Columns in a piece of a product.
const PIECE: usize = 96;
/// Work below which threads are not worth their overhead.
const PARALLEL_FLOPS: usize = 4_000_000;

/// Eliminates all pivots; returns position and value of the first bad one.
///
/// A bad pivot is replaced by one, so the factors are of no use then.
pub(crate) fn eliminate(left: &mut [f64], rest: &mut [f64], size: usize) -> Option<(usize, f64)> {
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
                -1.0,
                Par::Seq,
            );
        });
    }
    failure
}

/// Factors columns `begin..end`, which have seen all earlier pivots.
fn factor(left: &mut [f64], size: usize, begin: usize, end: usize) -> Option<(usize, f64)> {
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
            -1.0,
            Par::Seq,
        );
    });
    let second = factor(left, size, middle, end);
    first.or(second)
}

/// Right-looking elimination column by column.
fn factor_narrow(left: &mut [f64], size: usize, begin: usize, end: usize) -> Option<(usize, f64)> {
    let mut failure = None;
    for k in begin..end {
        let (done, todo) = left.split_at_mut((k + 1) * size);
        let column = &mut done[k * size + k..];
        let mut pivot = column[0];
        if pivot.is_nan() || pivot <= TINY {
            failure = failure.or(Some((k, pivot)));
            pivot = 1.0;
        }
        column[0] = pivot.sqrt();
        let inverse = 1.0 / column[0];
        column[1..].iter_mut().for_each(|l| *l *= inverse);
        for (j, target) in todo.chunks_exact_mut(size).take(end - k - 1).enumerate() {
            let lower = &column[j + 1..];
            let factor = lower[0];
            let below = &mut target[k + 1 + j..];
            below
                .iter_mut()
                .zip(lower)
                .for_each(|(t, l)| *t -= factor * l);
        }
    }
    failure
}

/// Calls `work` with the first column of each piece and the piece.
fn products(
    columns: &mut [f64],
    size: usize,
    depth: usize,
    work: impl Fn(usize, &mut [f64]) + Send + Sync,
) {
    let flops = columns.len() * depth;
    let numbered = |(k, piece): (usize, &mut [f64])| work(k * PIECE, piece);
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

fn matrix(values: &[f64], rows: usize, columns: usize) -> MatRef<'_, f64> {
    MatRef::from_column_major_slice(&values[..rows * columns], rows, columns)
}
