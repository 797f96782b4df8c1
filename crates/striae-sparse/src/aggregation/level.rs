//! A level but the coarsest: matrix, smoother, interpolation.

use super::{
    MODES,
    aggregates::Aggregates,
    blocks::{Blocks, Mirror, add_product, add_transposed_product, invert},
    others::{Others, Sum},
    packed::Packed,
    prolongator::Tentative,
};
use rayon::prelude::*;
use std::ops::Range;

/// Steps of the power method.
const STEPS: usize = 12;
/// By how much its estimate of the largest eigenvalue is raised.
const SAFETY: f64 = 1.1;
/// Largest eigenvalue over the smallest one that smoothing reduces.
const RATIO: f64 = 10.0;
/// Rows of a coarse matrix that are made at a time.
const PIECE: usize = 2048;
/// Degree of the smoothing polynomial.
const DEGREE: usize = 2;

/// Data from which the next level is built.
pub(crate) struct Coarser {
    pub(crate) matrix: Blocks<MODES, MODES, f64>,
    pub(crate) near_kernel: Vec<f64>,
    /// Part that the nodes of each aggregate are of.
    pub(crate) parts: Vec<u32>,
}

/// A matrix of `N` by `N` blocks with all that a V-cycle needs.
#[derive(Debug)]
pub(crate) struct Level<const N: usize> {
    matrix: Packed<N>,
    /// Inverses of the diagonal blocks.
    inverses: Vec<f32>,
    /// Largest eigenvalue of the matrix times those.
    largest: f64,
    prolongator: Blocks<N, MODES, f32>,
    mirror: Mirror,
}

impl<const N: usize> Level<N> {
    /// A level without a coarser one, of a matrix with so many columns of blocks: one a row,
    /// and those that others have.
    pub(crate) fn new(
        matrix: &Blocks<N, N, f64>,
        columns: usize,
        (others, sum): (&mut dyn Others, Sum<'_>),
    ) -> Self {
        let inverses = inverses(matrix);
        let mut level = Self {
            matrix: Packed::of(matrix),
            inverses: inverses.iter().map(|&a| a as f32).collect(),
            largest: 1.0,
            prolongator: Blocks::default(),
            mirror: Mirror::default(),
        };
        level.largest = SAFETY * level.power_method(columns, (others, sum));
        level
    }

    /// Smooth interpolation from aggregates with columns on their nodes.
    pub(crate) fn interpolation(
        &self,
        matrix: &Blocks<N, N, f64>,
        aggregates: &Aggregates,
        tentative: &Tentative,
    ) -> Blocks<N, MODES, f64> {
        let omega = 4.0 / 3.0 / self.largest;
        tentative.smoothed(aggregates, matrix, &inverses(matrix), omega)
    }

    /// Interpolates from aggregates, each of nodes of one part.
    pub(crate) fn coarsen(
        &mut self,
        matrix: Blocks<N, N, f64>,
        near_kernel: &[f64],
        theta: f64,
        parts: &[u32],
    ) -> Coarser {
        let aggregates = Aggregates::new(&matrix, theta, parts);
        let tentative = Tentative::new::<N>(&aggregates, near_kernel);
        let prolongator = self.interpolation(&matrix, &aggregates, &tentative);
        let none = Blocks::default();
        let mut product = self.galerkin(matrix, prolongator, &none, aggregates.count);
        without_zeros(&mut product);
        Coarser {
            matrix: product,
            near_kernel: tentative.coarse,
            parts: aggregates.parts(parts),
        }
    }

    /// `P^T A P` of the rows of this level, with as many coarse blocks as are told, from its
    /// interpolation and that of the nodes that others have.
    pub(crate) fn galerkin(
        &mut self,
        matrix: Blocks<N, N, f64>,
        own: Blocks<N, MODES, f64>,
        theirs: &Blocks<N, MODES, f64>,
        coarse: usize,
    ) -> Blocks<MODES, MODES, f64> {
        self.mirror = Mirror::of(&own, coarse);
        let mut product = Blocks::<MODES, MODES, f64>::from_rows(0, coarse, |_, _| {});
        for first in (0..coarse).step_by(PIECE) {
            let piece = first..coarse.min(first + PIECE);
            product.append(self.piece_of_galerkin(&matrix, (&own, theirs), piece));
        }
        drop(matrix);
        self.prolongator = own.rounded();
        product
    }

    /// Some rows of `P^T A P`. All of `A P` would be larger than all else there is.
    fn piece_of_galerkin(
        &self,
        matrix: &Blocks<N, N, f64>,
        (own, theirs): (&Blocks<N, MODES, f64>, &Blocks<N, MODES, f64>),
        piece: Range<usize>,
    ) -> Blocks<MODES, MODES, f64> {
        let (rows, coarse) = (matrix.rows(), self.mirror.columns());
        let mut places = vec![u32::MAX; rows];
        let named = piece.clone().flat_map(|i| self.mirror.column(i));
        named.for_each(|(row, _)| places[row] = 0);
        let mut fine = Vec::new();
        for (row, place) in places
            .iter_mut()
            .enumerate()
            .filter(|(_, place)| **place == 0)
        {
            *place = fine.len() as u32;
            fine.push(row);
        }
        let image = Blocks::<N, MODES, f64>::from_rows(fine.len(), coarse, |k, sum| {
            for (j, block) in matrix.row(fine[k]) {
                let (interpolation, j) = if j < rows {
                    (own, j)
                } else {
                    (theirs, j - rows)
                };
                for (k, p) in interpolation.row(j) {
                    add_product::<N, N, MODES>(sum.block(k), 1.0, block, p);
                }
            }
        });
        Blocks::from_rows(piece.len(), coarse, |k, sum| {
            for (row, at) in self.mirror.column(piece.start + k) {
                let p = &own.values[at * N * MODES..][..N * MODES];
                for (k, a) in image.row(places[row] as usize) {
                    add_transposed_product::<MODES, N, MODES>(sum.block(k), p, a);
                }
            }
        })
    }

    /// Returns whether there is no coarser level.
    pub(crate) fn is_last(&self) -> bool {
        self.prolongator.starts.is_empty()
    }

    /// `x` from `b` by smoothing, a correction by the coarser levels, smoothing. Where others
    /// have nodes, `x` has room for them.
    pub(crate) fn cycle(
        &self,
        b: &[f32],
        x: &mut [f32],
        others: &mut dyn Others,
        coarser: &mut dyn FnMut(&[f32], &mut [f32]),
    ) {
        x.fill(0.0);
        self.smooth(b, x, others, Start::Zero);
        let mut residual = b.to_vec();
        others.fetch(x);
        self.matrix.combine(x, &mut residual, |ax, b| b - ax);
        let size = MODES * self.mirror.columns();
        let (mut restricted, mut correction) = (vec![0.0; size], vec![0.0; size]);
        self.mirror
            .multiply(&self.prolongator, &residual, &mut restricted);
        drop(residual);
        others.bring_coarse(&mut restricted);
        coarser(&restricted, &mut correction);
        others.fetch_coarse(&mut correction);
        let own = &mut x[..b.len()];
        self.prolongator.combine(&correction, own, |p, x| x + p);
        self.smooth(b, x, others, Start::Given);
    }

    /// Chebyshev iteration on the upper part of the spectrum (Saad, Iterative Methods, alg. 12.1).
    fn smooth(&self, b: &[f32], x: &mut [f32], others: &mut dyn Others, start: Start) {
        let (upper, lower) = (self.largest, self.largest / RATIO);
        let (centre, half) = (0.5 * (upper + lower), 0.5 * (upper - lower));
        let sigma = centre / half;
        let mut rho = 1.0 / sigma;
        let mut step = vec![0.0; b.len()];
        let mut residual = b.to_vec();
        for k in 0..DEGREE {
            if k > 0 || start == Start::Given {
                residual.copy_from_slice(b);
                others.fetch(x);
                self.matrix.combine(x, &mut residual, |ax, b| b - ax);
            }
            let (keep, take) = if k == 0 {
                (0.0, 1.0 / centre)
            } else {
                let before = rho;
                rho = 1.0 / (2.0 * sigma - before);
                (rho * before, 2.0 * rho / half)
            };
            self.advance(&residual, (keep as f32, take as f32), &mut step, x);
        }
    }

    /// `step := keep step + take D^-1 residual`, `x += step`.
    fn advance(&self, residual: &[f32], weights: (f32, f32), step: &mut [f32], x: &mut [f32]) {
        let (keep, take) = weights;
        x.par_chunks_exact_mut(N)
            .zip(step.par_chunks_exact_mut(N))
            .zip(residual.par_chunks_exact(N))
            .zip(self.inverses.par_chunks_exact(N * N))
            .with_min_len(512)
            .for_each(|(((x, step), residual), inverse)| {
                for r in 0..N {
                    let mut sum = 0.0;
                    for c in 0..N {
                        sum += inverse[r * N + c] * residual[c];
                    }
                    step[r] = keep * step[r] + take * sum;
                    x[r] += step[r];
                }
            });
    }

    /// Largest eigenvalue of `D^-1 A`, from below.
    fn power_method(&self, columns: usize, (others, sum): (&mut dyn Others, Sum<'_>)) -> f64 {
        let n = N * self.matrix.rows();
        let mut x: Vec<f32> = pseudo_random(n);
        x.resize(N * columns, 0.0);
        let (mut image, mut estimate) = (vec![0.0; n], 1.0);
        for _ in 0..STEPS {
            others.fetch(&mut x);
            self.matrix.combine(&x, &mut image, |ax, _| ax);
            let mut next = vec![0.0; n];
            let mut unused = vec![0.0; n];
            self.advance(&image, (0.0, 1.0), &mut next, &mut unused);
            let square = |v: &[f32]| v.iter().map(|&v| f64::from(v) * f64::from(v)).sum::<f64>();
            let length = |v: &[f32]| sum(square(v)).sqrt();
            let (before, after) = (length(&x[..n]), length(&next));
            if before == 0.0 || after == 0.0 {
                break;
            }
            estimate = after / before;
            for (x, v) in x.iter_mut().zip(next) {
                *x = (f64::from(v) / after) as f32;
            }
        }
        estimate
    }

    /// Entries that are kept.
    pub(crate) fn entries(&self) -> usize {
        self.matrix.entries() + self.prolongator.values.len() + self.inverses.len()
    }
}

/// Knowledge of the solution before smoothing.
#[derive(Clone, Copy, PartialEq)]
enum Start {
    Zero,
    Given,
}

/// Numbers between minus one and one that are always the same.
fn pseudo_random(n: usize) -> Vec<f32> {
    let mut state = 0x9E37_79B9_7F4A_7C15_u64;
    let next = || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 40) as f32 / (1_u64 << 23) as f32 - 1.0
    };
    std::iter::repeat_with(next).take(n).collect()
}

/// Gives unknowns that nothing interpolates from a unit diagonal.
fn without_zeros(matrix: &mut Blocks<MODES, MODES, f64>) {
    for i in 0..matrix.rows() {
        for at in matrix.starts[i]..matrix.starts[i + 1] {
            if matrix.columns[at] as usize == i {
                let block = &mut matrix.values[at * MODES * MODES..][..MODES * MODES];
                for k in 0..MODES {
                    let own = &mut block[k * MODES + k];
                    if *own <= 0.0 {
                        *own = 1.0;
                    }
                }
            }
        }
    }
}

/// Inverses of the diagonal blocks, by Cholesky; of the diagonal alone where that fails.
fn inverses<const N: usize>(matrix: &Blocks<N, N, f64>) -> Vec<f64> {
    let mut inverses = vec![0.0; matrix.rows() * N * N];
    inverses
        .par_chunks_exact_mut(N * N)
        .enumerate()
        .with_min_len(64)
        .for_each(|(i, target)| {
            if let Some((_, block)) = matrix.row(i).find(|&(j, _)| j == i) {
                invert::<N>(block, target);
            } else {
                (0..N).for_each(|k| target[k * N + k] = 1.0);
            }
        });
    inverses
}

#[cfg(test)]
mod tests {
    use super::{super::others::Nobody, *};

    /// Rows with blocks in some columns, of numbers that are as good as random.
    fn scattered<const C: usize>(rows: usize, columns: usize) -> Blocks<3, C, f64> {
        Blocks::from_rows(rows, columns, |i, sum| {
            for step in 0..4 {
                let block = sum.block((i / 2 + step * step) % columns).iter_mut();
                let number = |k: usize| ((i * 31 + step * 17 + k * 7) % 23) as f64 - 11.0;
                block.enumerate().for_each(|(k, value)| *value += number(k));
            }
        })
    }

    #[test]
    fn pieces_of_a_galerkin_product_are_those_of_the_whole() {
        let (rows, coarse) = (40, 22);
        let matrix = scattered::<3>(rows, rows + 5);
        let (own, theirs) = (scattered::<MODES>(rows, coarse), scattered(5, coarse));
        let mut level = Level::new(&matrix, rows + 5, (&mut Nobody, &|own| own));
        level.mirror = Mirror::of(&own, coarse);
        let piece = |range: Range<usize>| {
            let piece = level.piece_of_galerkin(&matrix, (&own, &theirs), range);
            let rows = (0..piece.rows()).map(|i| {
                let row = piece.row(i).map(|(j, block)| (j, block.to_vec()));
                row.collect::<Vec<_>>()
            });
            rows.collect::<Vec<_>>()
        };
        let pieces = (0..coarse)
            .step_by(7)
            .map(|first| first..coarse.min(first + 7));
        assert_eq!(pieces.flat_map(piece).collect::<Vec<_>>(), piece(0..coarse));
    }
}
