//! Smoothed aggregation: a preconditioner for matrices of elasticity.
//!
//! Every level interpolates from aggregates of nodes with six unknowns each, which
//! reproduce the near-kernel (rigid motions) exactly but for the
//! smoothing (Vanek, Mandel & Brezina, doi:10.1007/BF02238511, with the variants of
//! Adams, doi:10.1002/nme.568): Galerkin products `P^T A P`, Chebyshev polynomials
//! of the block diagonal for smoothing before and after, Cholesky on the coarsest
//! level. One V-cycle is a symmetric positive definite operator. Levels are made in
//! double precision and used in single precision: all that is asked of them is to
//! be near the inverse.

mod aggregates;
pub mod blocks;
mod coarsest;
mod level;
mod others;
mod packed;
mod prolongator;
mod shared;

pub use others::{Others, Sum};
pub use shared::{Coarsening, NONE, SharedLevel};

use blocks::Blocks;
use coarsest::Coarsest;
use level::Level;
use others::Nobody;

/// Columns of the near-kernel: rigid motions.
pub const MODES: usize = 6;
/// Unknowns of the coarsest level at most.
pub const COARSEST: usize = 1200;
/// Levels at most.
const LEVELS: usize = 12;
/// A level that has more than this share of the nodes of the finer one is not worth its work.
pub const SLOW: f64 = 0.7;
/// Coupling above which nodes of the finest level may be in one aggregate.
const STRONG: f64 = 0.06;
/// Ratio of the threshold of a level to that of the next finer one.
const LOOSER: f64 = 0.5;

/// Levels of a symmetric positive definite matrix of 3 by 3 blocks.
#[derive(Debug)]
pub struct Hierarchy {
    finest: Level<3>,
    coarser: Vec<Level<MODES>>,
    coarsest: Coarsest,
}

impl Hierarchy {
    /// Levels of a matrix with a near-kernel of 3 rows by six a node. An aggregate, of any
    /// level, has nodes of one part, so that parts keep motions of their own, however coarse.
    pub fn new(matrix: Blocks<3, 3, f64>, near_kernel: &[f64], parts: &[u32]) -> Option<Self> {
        let mut finest = Level::new(&matrix, matrix.rows(), (&mut Nobody, &|own| own));
        let (mut coarser, mut theta) = (Vec::new(), STRONG);
        if matrix.rows() * 3 <= COARSEST {
            let coarsest = Coarsest::new(&matrix)?;
            return Some(Self {
                finest,
                coarser,
                coarsest,
            });
        }
        let mut next = finest.coarsen(matrix, near_kernel, theta, parts);
        while next.matrix.rows() * MODES > COARSEST && coarser.len() < LEVELS {
            theta *= LOOSER;
            let before = next.matrix.rows();
            let mut level = Level::new(&next.matrix, before, (&mut Nobody, &|own| own));
            next = level.coarsen(next.matrix, &next.near_kernel, theta, &next.parts);
            coarser.push(level);
            if next.matrix.rows() as f64 > SLOW * before as f64 {
                break;
            }
        }
        let coarsest = Coarsest::new(&next.matrix)?;
        Some(Self {
            finest,
            coarser,
            coarsest,
        })
    }

    /// `x = M^-1 b` by one V-cycle.
    pub fn apply(&self, b: &[f32], x: &mut [f32]) {
        if self.finest.is_last() {
            self.coarsest.solve(b, x);
        } else {
            let mut coarser = |b: &[f32], x: &mut [f32]| self.descend(0, b, x);
            self.finest.cycle(b, x, &mut Nobody, &mut coarser);
        }
    }

    fn descend(&self, depth: usize, b: &[f32], x: &mut [f32]) {
        match self.coarser.get(depth) {
            Some(level) => {
                let mut coarser = |b: &[f32], x: &mut [f32]| self.descend(depth + 1, b, x);
                level.cycle(b, x, &mut Nobody, &mut coarser);
            }
            None => self.coarsest.solve(b, x),
        }
    }

    /// Entries that are kept, of half the usual size each.
    pub fn entries(&self) -> usize {
        let coarser: usize = self.coarser.iter().map(Level::entries).sum();
        self.finest.entries() + coarser + 2 * self.coarsest.entries()
    }

    /// Number of levels.
    #[cfg(test)]
    pub fn levels(&self) -> usize {
        2 + self.coarser.len()
    }
}

#[cfg(test)]
mod tests;
