//! Aggregates of a finest level whose coarser ones are someone else's.

use super::{MODES, STRONG, aggregates::Aggregates, blocks::Blocks, prolongator::Tentative};

pub use super::aggregates::NONE;

/// Aggregates of nodes, and columns on them that reproduce the near-kernel.
#[derive(Clone, Debug, PartialEq)]
pub struct Coarsening {
    /// Aggregate of every node, [`NONE`] where smoothing alone does.
    pub aggregates: Vec<u32>,
    /// How many there are.
    pub count: usize,
    /// Orthonormal columns on every aggregate, three rows by six a node.
    pub columns: Vec<f64>,
    /// The near-kernel in terms of those, six rows by six an aggregate. Rows of columns that
    /// depend on others are zero, and so are those columns.
    pub near_kernel: Vec<f64>,
}

impl Coarsening {
    /// Of a symmetric positive definite matrix with a near-kernel of 3 rows by six a node.
    pub fn new(matrix: &Blocks<3, 3, f64>, near_kernel: &[f64]) -> Self {
        let aggregates = Aggregates::new(matrix, STRONG, |_, _| true);
        let tentative = Tentative::new::<3>(&aggregates, near_kernel);
        Self {
            aggregates: aggregates.of,
            count: aggregates.count,
            columns: tentative.values,
            near_kernel: tentative.coarse,
        }
    }

    /// Unknowns of the coarser level that nothing interpolates from.
    pub fn empty(&self) -> impl Iterator<Item = usize> + '_ {
        let rows = self.near_kernel.chunks_exact(MODES).enumerate();
        rows.filter(|(row, values)| values[row % MODES] == 0.0)
            .map(|(row, _)| row)
    }
}
