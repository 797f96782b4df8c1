//! The contact system on a condensed bulk: `(A_kk + S) z = b`, solved exactly.
//!
//! The kept unknowns are bulk unknowns `x` and multipliers `m`. `S` couples the
//! bulk unknowns of one body densely; all else is sparse. With the rows of the
//! multipliers first, the system is
//!
//! ```text
//! [ G_x    G_m ] [x]
//! [ K + S   C  ] [m]
//! ```
//!
//! Three steps: the rows of `G` are eliminated sparsely, so that a node that
//! sticks or touches loses its own position and a prescribed traction itself;
//! the multipliers that are left are sparse columns of `C`, which are
//! eliminated against rows of momentum, in the same way transposed; a dense LU
//! of the order of one side's unknowns remains. Threads do not change a bit.

mod assembled;
mod compliant;
mod flexibility;
mod freedom;

use assembled::Assembled;
pub(crate) use assembled::{Block, Kind, Places};
pub(crate) use compliant::{Compliant, Purpose, Trial};
pub(crate) use flexibility::Flexibility;
pub(crate) use freedom::freedom;
use rayon::prelude::*;
use std::ops::Range;
use striae_sparse::{
    SolveError,
    dense::{self, Leftover},
    sparse_elimination::{Row, SparseElimination},
    triangular::{self, Diagonal, solve_lower, solve_upper},
};

/// Entries above which a row or a column of the multipliers counts as dense.
const LONG: usize = 512;
/// Entries of a row of `C^T` above which it is left to the dense part.
const LONGEST: usize = 2048;
/// Dense rows that are worked on at a time.
const LANES: usize = 16;

/// A factored contact system.
#[derive(Debug, Default)]
pub(crate) struct Interface {
    assembled: Assembled,
    /// Elimination of the rows `G`: rows as in `assembled.short`, columns are kept unknowns.
    constraints: SparseElimination,
    /// Elimination of the columns `C`: rows as in `columns`, columns are dense rows.
    tractions: SparseElimination,
    /// Kept unknowns that are multipliers with a sparse column after the first step.
    columns: Vec<u32>,
    rest: Dense,
}

/// Dense part that is left after sparse elimination.
#[derive(Debug, Default)]
struct Dense {
    /// Dense rows, as numbered in `assembled`.
    rows: Vec<u32>,
    /// Kept unknowns.
    columns: Vec<u32>,
    lu: Vec<f64>,
    /// Rows and columns in the order of the pivots.
    row_order: Vec<u32>,
    column_order: Vec<u32>,
}

impl Interface {
    /// Factors the system of the kept unknowns, whose dense part is singular where a
    /// pivot is below the given one.
    pub(crate) fn factor(
        places: &Places,
        rows: Vec<Row>,
        blocks: &[Block<'_>],
        smallest: f64,
    ) -> Result<Self, SolveError> {
        let mut assembled = Assembled::new(places, rows, LONG);
        let ranks = assembled.ranks();
        let constraints = SparseElimination::new(assembled.take_short(), &ranks, LONG);
        assembled.defer(&constraints.deferred);
        let (dense, columns) = assembled.survivors(&constraints);
        let panels = assembled.panels(blocks, &constraints, &dense, &columns);
        let ranks = vec![0; assembled.long.len()];
        let transposed = panels.transposed(columns.len());
        let tractions = SparseElimination::new(transposed.clone(), &ranks, LONGEST);
        let rest = Dense::new(
            &panels,
            &tractions,
            transposed,
            (&dense, &columns),
            smallest,
        )?;
        Ok(Self {
            assembled,
            constraints,
            tractions,
            columns,
            rest,
        })
    }

    /// Order of the dense matrix.
    pub(crate) fn dense_order(&self) -> usize {
        self.rest.columns.len()
    }

    /// Entries of all factors.
    pub(crate) fn entries(&self) -> usize {
        self.rest.lu.len() + self.constraints.entries() + self.tractions.entries()
    }

    /// Solves for all kept unknowns.
    pub(crate) fn solve(&self, blocks: &[Block<'_>], rhs: &[f64]) -> Vec<f64> {
        let assembled = &self.assembled;
        let mut short: Vec<f64> = assembled.short.iter().map(|&k| rhs[k as usize]).collect();
        self.constraints.forward(&mut short);
        let mut z = vec![0.0; rhs.len()];
        self.constraints.backward(&short, &mut z);
        let mut combined = self.combined(blocks, rhs, &z);
        let known: Vec<f64> = self.rest.solve(&combined);
        for (&column, value) in self.rest.columns.iter().zip(&known) {
            z[column as usize] = *value;
        }
        self.constraints.backward(&short, &mut z);
        combined = self.combined(blocks, rhs, &z);
        let mut multipliers = vec![0.0; self.columns.len()];
        self.tractions
            .backward_transposed(&combined, &mut multipliers);
        for pivot in &self.tractions.pivots {
            let place = self.columns[pivot.row as usize];
            z[place as usize] = multipliers[pivot.row as usize];
        }
        self.constraints.backward(&short, &mut z);
        z
    }

    /// Residual of the dense rows with the columns of `C` eliminated.
    fn combined(&self, blocks: &[Block<'_>], rhs: &[f64], z: &[f64]) -> Vec<f64> {
        let residual = self.assembled.residual(blocks, rhs, z);
        let mut columns: Vec<[f64; 1]> = residual.into_iter().map(|r| [r]).collect();
        self.tractions.combine_columns(&mut columns);
        columns.into_iter().map(|[r]| r).collect()
    }
}

/// Dense rows after the first step, in panels of [`LANES`].
pub(crate) struct Panels {
    /// Number of rows.
    rows: usize,
    /// Values of the dense columns, panel by panel, lanes contiguous.
    dense: Vec<f64>,
    /// Number of dense columns.
    width: usize,
    /// Entries `(column, row, value)` of the sparse columns, by rising row.
    sparse: Vec<(u32, u32, f64)>,
}

impl Panels {
    /// Rows of `C^T`.
    fn transposed(&self, count: usize) -> Vec<Row> {
        let mut rows = vec![Row::new(); count];
        for &(column, row, value) in &self.sparse {
            rows[column as usize].push((row, value));
        }
        rows
    }

    /// Values of some dense columns in all rows, each to a lane of vectors.
    fn columns(&self, columns: Range<usize>, target: &mut [[f64; LANES]]) {
        let panels = self.dense.chunks_exact((self.width * LANES).max(1));
        for (panel, rows) in panels.zip(target.chunks_mut(LANES)) {
            let columns = panel[columns.start * LANES..columns.end * LANES].chunks_exact(LANES);
            for (lane, values) in columns.enumerate() {
                let rows = rows.iter_mut().zip(values);
                rows.for_each(|(row, value)| row[lane] = *value);
            }
        }
    }
}

impl Dense {
    /// Eliminates the sparse columns from the dense ones and factors the rest.
    fn new(
        panels: &Panels,
        tractions: &SparseElimination,
        transposed: Vec<Row>,
        (dense, sparse): (&[u32], &[u32]),
        smallest: f64,
    ) -> Result<Self, SolveError> {
        let mut pivotal = vec![false; panels.rows];
        tractions
            .pivots
            .iter()
            .for_each(|pivot| pivotal[pivot.column as usize] = true);
        let rows: Vec<u32> = (0..panels.rows as u32)
            .filter(|&row| !pivotal[row as usize])
            .collect();
        let deferred = tractions.deferred.iter();
        let columns: Vec<u32> = dense
            .iter()
            .copied()
            .chain(deferred.map(|&c| sparse[c as usize]))
            .collect();
        let order = rows.len();
        if columns.len() != order {
            return Err(SolveError::NotFactored);
        }
        let mut lu = vec![0.0; order * order];
        lu.par_chunks_mut((order * LANES).max(1))
            .enumerate()
            .for_each(|(k, target)| {
                let mut vectors = vec![[0.0; LANES]; panels.rows];
                let first = k * LANES;
                let count = target.len() / order;
                let end = first + count;
                panels.columns(first.min(dense.len())..end.min(dense.len()), &mut vectors);
                for c in dense.len().max(first)..end {
                    let row = &transposed[tractions.deferred[c - dense.len()] as usize];
                    row.iter()
                        .for_each(|&(r, a)| vectors[r as usize][c - first] = a);
                }
                tractions.combine_columns(&mut vectors);
                for (at, rows) in rows.chunks(LANES).enumerate() {
                    for (lane, column) in target.chunks_exact_mut(order).enumerate() {
                        let column = column[at * LANES..].iter_mut().zip(rows);
                        column.for_each(|(value, &row)| *value = vectors[row as usize][lane]);
                    }
                }
            });
        Self::factored(rows, columns, lu, smallest)
    }

    fn factored(
        rows: Vec<u32>,
        columns: Vec<u32>,
        mut lu: Vec<f64>,
        smallest: f64,
    ) -> Result<Self, SolveError> {
        let mut row_order: Vec<u32> = (0..rows.len() as u32).collect();
        let mut column_order = row_order.clone();
        let done = dense::eliminate(
            &mut lu,
            &mut [],
            &mut [],
            &mut row_order,
            &mut column_order,
            Leftover::Replace,
        );
        let suspicious = done.smallest.is_nan() || done.smallest < smallest;
        if done.replaced > 0 || !rows.is_empty() && suspicious {
            let (unknown, equation) = (0, 0);
            return Err(SolveError::Singular { unknown, equation });
        }
        Ok(Self {
            rows,
            columns,
            lu,
            row_order,
            column_order,
        })
    }

    /// Values of the dense columns, from the dense rows of a right-hand side.
    fn solve(&self, rhs: &[f64]) -> Vec<f64> {
        let n = self.rows.len();
        let value = |&k: &u32| rhs[self.rows[k as usize] as usize];
        let mut y: Vec<f64> = self.row_order.iter().map(value).collect();
        let lu = triangular::Block::new(&self.lu, n);
        solve_lower(lu, Diagonal::Unit, &mut y, n);
        solve_upper(lu, &mut y);
        let mut x = vec![0.0; n];
        for (&k, value) in self.column_order.iter().zip(&y) {
            x[k as usize] = *value;
        }
        x
    }
}
