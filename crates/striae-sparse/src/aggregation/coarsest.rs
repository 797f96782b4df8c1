//! The coarsest level: dense Cholesky factors.

use super::blocks::Blocks;
use faer::{Mat, Par, linalg::triangular_solve as triangular, mat::MatMut};

/// Shares of the diagonal that are added until the matrix is definite.
const SHIFTS: [f64; 4] = [0.0, 1e-10, 1e-6, 1e-2];

/// Factors of the coarsest matrix.
#[derive(Debug)]
pub(crate) struct Coarsest {
    lower: Mat<f64>,
}

impl Coarsest {
    /// Factors; `None` when the matrix is far from definite.
    pub(crate) fn new<const N: usize>(matrix: &Blocks<N, N, f64>) -> Option<Self> {
        let n = matrix.rows() * N;
        let mut dense = Mat::<f64>::zeros(n, n);
        for i in 0..matrix.rows() {
            for (j, block) in matrix.row(i) {
                for r in 0..N {
                    for c in 0..N {
                        dense[(i * N + r, j * N + c)] = block[r * N + c];
                    }
                }
            }
        }
        for shift in SHIFTS {
            let mut shifted = dense.clone();
            (0..n).for_each(|k| shifted[(k, k)] *= 1.0 + shift);
            if let Ok(factors) = shifted.llt(faer::Side::Lower) {
                let lower = factors.L().to_owned();
                return Some(Self { lower });
            }
        }
        None
    }

    /// `x = A^-1 b`.
    pub(crate) fn solve(&self, b: &[f32], x: &mut [f32]) {
        let mut y: Vec<f64> = b.iter().map(|&b| f64::from(b)).collect();
        let n = y.len();
        let mut v = MatMut::from_column_major_slice_mut(&mut y, n, 1);
        triangular::solve_lower_triangular_in_place(self.lower.as_ref(), v.as_mut(), Par::Seq);
        let upper = self.lower.transpose();
        triangular::solve_upper_triangular_in_place(upper, v.as_mut(), Par::Seq);
        x.iter_mut().zip(&y).for_each(|(x, &y)| *x = y as f32);
    }

    /// Entries of the factors.
    pub(crate) fn entries(&self) -> usize {
        self.lower.nrows() * self.lower.ncols()
    }
}
