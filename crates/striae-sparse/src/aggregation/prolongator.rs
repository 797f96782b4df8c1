//! Interpolation from aggregates that keeps the near-kernel.
//!
//! The near-kernel `B` (six columns) is made orthonormal on every aggregate,
//! `B = P_0 B_coarse`; one damped step of block Jacobi on its columns makes it
//! smooth, `P = (I - omega D^-1 A) P_0`. A column that depends on others on an
//! aggregate is zero there, in `P_0` and in `B_coarse`.

use super::{
    MODES,
    aggregates::{Aggregates, NONE},
    blocks::{Blocks, add_product},
};
use rayon::prelude::*;

/// Share of a column that has to be left by those before it.
const DEPENDENT: f64 = 1e-6;

/// Orthonormal columns on every node, `N` rows by six, and the coarse near-kernel.
pub(crate) struct Tentative {
    pub(crate) values: Vec<f64>,
    pub(crate) coarse: Vec<f64>,
}

impl Tentative {
    /// From the near-kernel, `N` rows by six a node.
    pub(crate) fn new<const N: usize>(aggregates: &Aggregates, near_kernel: &[f64]) -> Self {
        let size = N * MODES;
        let members = aggregates.members();
        let parts: Vec<(Vec<f64>, [f64; MODES * MODES])> = members
            .par_iter()
            .with_min_len(16)
            .map(|nodes| {
                let own = nodes
                    .iter()
                    .map(|&i| &near_kernel[i as usize * size..][..size]);
                let mut columns = own.collect::<Vec<_>>().concat();
                let r = orthonormalised(&mut columns);
                (columns, r)
            })
            .collect();
        let mut tentative = Self {
            values: vec![0.0; near_kernel.len()],
            coarse: Vec::with_capacity(aggregates.count * MODES * MODES),
        };
        for (nodes, (columns, r)) in members.iter().zip(&parts) {
            for (&i, own) in nodes.iter().zip(columns.chunks_exact(size)) {
                tentative.values[i as usize * size..][..size].copy_from_slice(own);
            }
            tentative.coarse.extend(r);
        }
        tentative
    }

    /// One step of block Jacobi on the columns; `inverses` are those of the diagonal blocks.
    pub(crate) fn smoothed<const N: usize>(
        &self,
        aggregates: &Aggregates,
        matrix: &Blocks<N, N, f64>,
        inverses: &[f64],
        omega: f64,
    ) -> Blocks<N, MODES, f64> {
        let size = N * MODES;
        Blocks::from_rows(matrix.rows(), aggregates.count, |i, sum| {
            let inverse = &inverses[i * N * N..][..N * N];
            for (j, block) in matrix.row(i) {
                let aggregate = aggregates.of[j];
                if aggregate != NONE {
                    let mut scaled = [0.0; 36];
                    add_product::<N, N, N>(&mut scaled, -omega, inverse, block);
                    let own = &self.values[j * size..][..size];
                    let target = sum.block(aggregate as usize);
                    add_product::<N, N, MODES>(target, 1.0, &scaled, own);
                }
            }
            if aggregates.of[i] != NONE {
                let target = sum.block(aggregates.of[i] as usize).iter_mut();
                let own = &self.values[i * size..][..size];
                target.zip(own).for_each(|(t, v)| *t += v);
            }
        })
    }
}

/// Makes six columns, given by rows, orthonormal and returns the triangular factor, by rows.
fn orthonormalised(columns: &mut [f64]) -> [f64; MODES * MODES] {
    let rows = columns.len() / MODES;
    let mut r = [0.0; MODES * MODES];
    let dot = |columns: &[f64], a: usize, b: usize| {
        let terms = (0..rows).map(|row| columns[row * MODES + a] * columns[row * MODES + b]);
        terms.sum::<f64>()
    };
    for c in 0..MODES {
        let before = dot(columns, c, c).sqrt();
        for _ in 0..2 {
            for k in 0..c {
                let h = dot(columns, k, c);
                for row in 0..rows {
                    columns[row * MODES + c] -= h * columns[row * MODES + k];
                }
                r[k * MODES + c] += h;
            }
        }
        let length = dot(columns, c, c).sqrt();
        let is_independent = length > DEPENDENT * before;
        for row in 0..rows {
            let value = &mut columns[row * MODES + c];
            *value = if is_independent { *value / length } else { 0.0 };
        }
        if is_independent {
            r[c * MODES + c] = length;
        }
    }
    r
}
