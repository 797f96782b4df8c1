//! A level of a matrix whose rows several parts hold; the next one is someone else's.

use super::{
    LOOSER, MODES, STRONG,
    aggregates::Aggregates,
    blocks::Blocks,
    level::Level,
    others::{Others, Sum},
    prolongator::Tentative,
};

pub use super::aggregates::NONE;

/// Aggregates of nodes, and columns on them that reproduce the near-kernel.
#[derive(Clone, Debug, PartialEq)]
pub struct Coarsening {
    /// Aggregate of every node, [`NONE`] where smoothing alone does.
    pub aggregates: Vec<u32>,
    /// Number of aggregates.
    pub count: usize,
    /// Orthonormal columns on every aggregate, `N` rows by six a node.
    pub columns: Vec<f64>,
    /// The near-kernel in terms of those, six rows by six an aggregate. Rows of columns that
    /// depend on others are zero, and so are those columns.
    pub near_kernel: Vec<f64>,
    /// Part that the nodes of each aggregate are of.
    pub parts: Vec<u32>,
}

impl Coarsening {
    /// Of some rows of a symmetric positive definite matrix with a near-kernel of `N` rows by
    /// six a node, so many levels below the finest. Columns of others' nodes come after as
    /// many as there are rows, and are in no aggregate; each aggregate is of one part.
    pub fn new<const N: usize>(
        matrix: &Blocks<N, N, f64>,
        near_kernel: &[f64],
        depth: usize,
        parts: &[u32],
    ) -> Self {
        let strong = STRONG * LOOSER.powi(depth as i32);
        let aggregates = Aggregates::new(matrix, strong, parts);
        let tentative = Tentative::new::<N>(&aggregates, near_kernel);
        Self {
            parts: aggregates.parts(parts),
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

/// Some rows of a level of `N` unknowns a node.
#[derive(Debug)]
pub struct SharedLevel<const N: usize>(Level<N>);

impl<const N: usize> SharedLevel<N> {
    /// From rows with so many columns of blocks: one a row, then those that others have.
    pub fn new(
        matrix: &Blocks<N, N, f64>,
        columns: usize,
        others: (&mut dyn Others, Sum<'_>),
    ) -> Self {
        Self(Level::new(matrix, columns, others))
    }

    /// Smooth interpolation at the nodes of the rows, from aggregates and columns at the
    /// nodes of all columns of blocks. Numbers of aggregates are below `count`.
    pub fn interpolation(
        &self,
        matrix: &Blocks<N, N, f64>,
        (aggregates, columns): (Vec<u32>, Vec<f64>),
        count: usize,
    ) -> Blocks<N, MODES, f64> {
        let aggregates = Aggregates {
            of: aggregates,
            count,
        };
        let tentative = Tentative {
            values: columns,
            coarse: Vec::new(),
        };
        self.0.interpolation(matrix, &aggregates, &tentative)
    }

    /// Contribution of these rows to the matrix of the next level, from the interpolation at their
    /// nodes and at those that others hold. Numbers of aggregates are below `count`.
    pub fn coarsen(
        &mut self,
        matrix: Blocks<N, N, f64>,
        (own, theirs): (Blocks<N, MODES, f64>, &Blocks<N, MODES, f64>),
        count: usize,
    ) -> Blocks<MODES, MODES, f64> {
        self.0.galerkin(matrix, own, theirs, count)
    }

    /// `x` from `b` by smoothing, a correction by the coarser levels, smoothing. Vectors that
    /// `coarser` is given and fills in have others' places after the own ones.
    pub fn cycle(
        &self,
        b: &[f32],
        x: &mut [f32],
        others: &mut dyn Others,
        coarser: &mut dyn FnMut(&[f32], &mut [f32]),
    ) {
        self.0.cycle(b, x, others, coarser);
    }
}
