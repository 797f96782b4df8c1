//! Square matrices of blocks in single precision, laid out for fast products.
//!
//! Blocks are stored by columns, each filled up with zeros to a multiple of four
//! numbers, which a processor multiplies at a time.

use super::blocks::Blocks;
use rayon::prelude::*;

/// Numbers that are multiplied at a time.
const LANES: usize = 4;
/// Rows of the largest blocks, filled up.
const LONGEST: usize = 8;
/// Fewest rows of a product that are worth a thread.
const FEWEST: usize = 128;

/// A matrix of `N` by `N` blocks, up to 8 by 8.
#[derive(Clone, Debug, Default)]
pub(crate) struct Packed<const N: usize> {
    starts: Vec<usize>,
    columns: Vec<u32>,
    values: Vec<f32>,
}

impl<const N: usize> Packed<N> {
    /// Length of a column of a block.
    const HEIGHT: usize = N.div_ceil(LANES) * LANES;

    /// Packs the values, rounded to single precision.
    pub(crate) fn of(matrix: &Blocks<N, N, f64>) -> Self {
        let size = N * Self::HEIGHT;
        let mut values = vec![0.0; matrix.count() * size];
        values
            .par_chunks_exact_mut(size)
            .zip(matrix.values.par_chunks_exact(N * N))
            .with_min_len(1024)
            .for_each(|(target, block)| {
                for r in 0..N {
                    for c in 0..N {
                        target[c * Self::HEIGHT + r] = block[r * N + c] as f32;
                    }
                }
            });
        Self {
            starts: matrix.starts.clone(),
            columns: matrix.columns.clone(),
            values,
        }
    }

    /// Number of rows of blocks.
    pub(crate) fn rows(&self) -> usize {
        self.starts.len() - 1
    }

    /// Entries that are kept.
    pub(crate) fn entries(&self) -> usize {
        self.values.len()
    }

    /// `y = f(A x, y)` in every component.
    pub(crate) fn combine(&self, x: &[f32], y: &mut [f32], f: impl Fn(f32, f32) -> f32 + Sync) {
        y.par_chunks_exact_mut(N)
            .with_min_len(FEWEST)
            .enumerate()
            .for_each(|(i, y)| {
                let product = self.row_product(i, x);
                for r in 0..N {
                    y[r] = f(product[r], y[r]);
                }
            });
    }

    /// A row of blocks times a vector.
    fn row_product(&self, i: usize, x: &[f32]) -> [f32; LONGEST] {
        let range = self.starts[i]..self.starts[i + 1];
        let size = N * Self::HEIGHT;
        let blocks = self.values[range.start * size..range.end * size].chunks_exact(size);
        let mut sum = [0.0; LONGEST];
        for (&j, block) in self.columns[range].iter().zip(blocks) {
            let x = &x[j as usize * N..][..N];
            for c in 0..N {
                let column = &block[c * Self::HEIGHT..][..Self::HEIGHT];
                for r in 0..Self::HEIGHT {
                    sum[r] += column[r] * x[c];
                }
            }
        }
        sum
    }
}
