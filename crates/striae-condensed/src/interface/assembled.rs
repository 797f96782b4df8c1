//! Rows of the contact system, sorted by what is dense.

use super::{LANES, Panels};
use rayon::prelude::*;
use striae_sparse::{
    Real, Values,
    sparse_elimination::{Row, SparseElimination},
    triangular::{self, subtract, subtract_transposed},
};

/// Schur complement of one body.
pub(crate) struct Block<'a> {
    /// Kept unknown of each row.
    pub(crate) places: &'a [u32],
    /// Both triangles, column by column.
    pub(crate) values: Values<'a>,
}

/// Columns that are taken to double precision at a time.
const COLUMNS: usize = 16;

impl Block<'_> {
    /// Puts a row to one lane of vectors by columns.
    fn load(&self, row: u32, lane: usize, columns: &mut [[f64; LANES]]) {
        match self.values {
            Values::Single(values) => self.load_from(values, row, lane, columns),
            Values::Double(values) => self.load_from(values, row, lane, columns),
        }
    }

    fn load_from<T: Real>(
        &self,
        values: &[T],
        row: u32,
        lane: usize,
        columns: &mut [[f64; LANES]],
    ) {
        // Symmetric: the column is the row, and contiguous.
        let values = &values[row as usize * self.places.len()..];
        for (&place, value) in self.places.iter().zip(values) {
            columns[place as usize][lane] = value.double();
        }
    }

    /// `S z`, in double precision.
    fn product(&self, z: &[f64]) -> Vec<f64> {
        let n = self.places.len();
        let x: Vec<f64> = self.places.iter().map(|&k| -z[k as usize]).collect();
        let mut y = vec![0.0; n];
        match self.values {
            Values::Double(values) => subtract(&mut y, triangular::Block::new(values, n), &x),
            Values::Single(values) => {
                let chunks = y.par_chunks_mut(COLUMNS).enumerate();
                chunks.for_each(|(k, y)| {
                    let columns = &values[k * COLUMNS * n..][..y.len() * n];
                    let columns: Vec<f64> = columns.iter().copied().map(f64::from).collect();
                    subtract_transposed(y, triangular::Block::new(&columns, n), &x);
                });
            }
        }
        y
    }
}

/// Kinds of the kept unknowns.
#[derive(Debug, Default)]
pub(crate) struct Places {
    /// Kind of each kept unknown.
    pub(crate) kinds: Vec<Kind>,
}

/// Kind of a kept unknown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    /// Solved for by other means; it has no entries.
    Apart,
    /// A bulk unknown, with its Schur complement and the row there.
    Bulk {
        /// Number of the block.
        block: u32,
        /// Row in it.
        row: u32,
    },
    /// A multiplier.
    Multiplier,
}

/// All rows but those of unknowns that are solved for apart.
#[derive(Debug, Default)]
pub(crate) struct Assembled {
    kinds: Vec<Kind>,
    /// Kept unknowns whose rows are sparse.
    pub(super) short: Vec<u32>,
    rows: Vec<Row>,
    /// Kept unknowns whose rows are dense, and their sparse parts.
    pub(super) long: Vec<u32>,
    couplings: Vec<Row>,
    /// `true` for kept unknowns with a dense column.
    dense: Vec<bool>,
}

impl Assembled {
    /// Sorts the rows of all kept unknowns; those of multipliers are short up to a length.
    pub(super) fn new(places: &Places, rows: Vec<Row>, long: usize) -> Self {
        let kinds = &places.kinds;
        let mut counts = vec![0; kinds.len()];
        let entries = rows.iter().flatten();
        entries.for_each(|&(c, _)| counts[c as usize] += 1);
        let is_bulk = |kind: &Kind| matches!(kind, Kind::Bulk { .. });
        let mut assembled = Self {
            kinds: kinds.clone(),
            dense: kinds
                .iter()
                .zip(&counts)
                .map(|(kind, &count)| is_bulk(kind) || count > long)
                .collect(),
            ..Self::default()
        };
        for (k, row) in rows.into_iter().enumerate() {
            match kinds[k] {
                Kind::Apart => {}
                Kind::Multiplier if row.len() <= long => {
                    assembled.short.push(k as u32);
                    assembled.rows.push(row);
                }
                _ => {
                    assembled.long.push(k as u32);
                    assembled.couplings.push(row);
                }
            }
        }
        assembled
    }

    /// Multipliers with few entries are the readiest pivots, those with many the least ready.
    pub(super) fn ranks(&self) -> Vec<u8> {
        let rank = |(kind, dense): (&Kind, &bool)| match (kind, dense) {
            (Kind::Multiplier, false) => 0,
            (Kind::Multiplier, true) => 2,
            _ => 1,
        };
        self.kinds.iter().zip(&self.dense).map(rank).collect()
    }

    /// The short rows; they stay here for those that are deferred.
    pub(super) fn take_short(&self) -> Vec<Row> {
        self.rows.clone()
    }

    /// Short rows that could not be eliminated become dense.
    pub(super) fn defer(&mut self, deferred: &[u32]) {
        for &row in deferred {
            self.long.push(self.short[row as usize]);
            self.couplings
                .push(std::mem::take(&mut self.rows[row as usize]));
        }
        self.rows = Vec::new();
    }

    /// Columns that are left after the first step: dense and sparse ones.
    ///
    /// A pivot with a dense column makes those of its row dense.
    pub(super) fn survivors(&mut self, constraints: &SparseElimination) -> (Vec<u32>, Vec<u32>) {
        let mut left: Vec<bool> = self.kinds.iter().map(|kind| *kind != Kind::Apart).collect();
        for pivot in &constraints.pivots {
            left[pivot.column as usize] = false;
            if self.dense[pivot.column as usize] {
                for &(j, _) in constraints.upper(pivot) {
                    self.dense[j as usize] = true;
                }
            }
        }
        (0..left.len() as u32)
            .filter(|&k| left[k as usize])
            .partition(|&k| self.dense[k as usize])
    }

    /// Dense rows after the elimination of the short ones.
    pub(super) fn panels(
        &self,
        blocks: &[Block<'_>],
        constraints: &SparseElimination,
        dense: &[u32],
        sparse: &[u32],
    ) -> Panels {
        let width = dense.len();
        let count = self.long.len().div_ceil(LANES);
        let mut values = vec![0.0; count * width * LANES];
        // Without dense columns there is nothing to chunk, but sparse entries may remain.
        let mut targets: Vec<&mut [f64]> = Vec::with_capacity(count);
        let mut rest = values.as_mut_slice();
        for _ in 0..count {
            let (own, others) = rest.split_at_mut(width * LANES);
            targets.push(own);
            rest = others;
        }
        let entries: Vec<Vec<(u32, u32, f64)>> = targets
            .into_par_iter()
            .enumerate()
            .map_init(
                || vec![[0.0; LANES]; self.kinds.len()],
                |columns, (panel, target)| {
                    columns.fill([0.0; LANES]);
                    let first = panel * LANES;
                    let rows = first..(first + LANES).min(self.long.len());
                    for (lane, row) in rows.clone().enumerate() {
                        self.load(blocks, row, lane, columns);
                    }
                    constraints.combine_columns(columns);
                    for (target, &k) in target.chunks_exact_mut(LANES).zip(dense) {
                        target.copy_from_slice(&columns[k as usize]);
                    }
                    let mut entries = Vec::new();
                    for (lane, row) in rows.enumerate() {
                        for (c, &k) in sparse.iter().enumerate() {
                            let value = columns[k as usize][lane];
                            if value != 0.0 {
                                entries.push((c as u32, row as u32, value));
                            }
                        }
                    }
                    entries
                },
            )
            .collect();
        Panels {
            rows: self.long.len(),
            dense: values,
            width,
            sparse: entries.concat(),
        }
    }

    /// A dense row to one lane of vectors by columns.
    fn load(&self, blocks: &[Block<'_>], row: usize, lane: usize, columns: &mut [[f64; LANES]]) {
        if let Kind::Bulk { block, row } = self.kinds[self.long[row] as usize] {
            blocks[block as usize].load(row, lane, columns);
        }
        for &(c, a) in &self.couplings[row] {
            columns[c as usize][lane] += a;
        }
    }

    /// `b - (A + S) z` in the dense rows.
    pub(super) fn residual(&self, blocks: &[Block<'_>], rhs: &[f64], z: &[f64]) -> Vec<f64> {
        let products: Vec<Vec<f64>> = blocks.iter().map(|block| block.product(z)).collect();
        let rows = self.long.iter().zip(&self.couplings);
        rows.map(|(&k, couplings)| {
            let sparse: f64 = couplings.iter().map(|&(c, a)| a * z[c as usize]).sum();
            let dense = match self.kinds[k as usize] {
                Kind::Bulk { block, row } => products[block as usize][row as usize],
                _ => 0.0,
            };
            rhs[k as usize] - sparse - dense
        })
        .collect()
    }
}
