//! Values on the fixed pattern of a [`Structure`], by rows.
//!
//! The rows of one supervariable have the same columns, so a row is addressed
//! by its supervariable and needs no column indices of its own.

mod cliques;

pub use cliques::{CliquePlaces, Member, MemberRows};

use crate::{error::OutsidePattern, structure::Structure, supervariable::Supervariable};
use rayon::prelude::*;

/// Values that a thread sets to zero at a time.
const PIECE: usize = 1 << 16;

/// A square matrix on the pattern of a [`Structure`].
#[derive(Clone, Debug)]
pub struct SparseMatrix {
    structure: Structure,
    values: Vec<f64>,
}

impl SparseMatrix {
    /// The zero matrix.
    pub fn zero(structure: &Structure) -> Self {
        Self {
            structure: structure.clone(),
            values: vec![0.0; structure.entries()],
        }
    }

    /// The pattern.
    pub fn structure(&self) -> &Structure {
        &self.structure
    }

    /// Sets all values to zero.
    pub fn clear(&mut self) {
        let pieces = self.values.par_chunks_mut(PIECE);
        pieces.for_each(|piece| piece.fill(0.0));
    }

    /// Adds a dense block, `block[r * columns.len() + c]` to entry `(rows[r], columns[c])`.
    ///
    /// Nothing is added when one of the entries is outside the pattern.
    /// Repeated rows or columns add up.
    ///
    /// # Panics
    /// When the block does not have `rows.len() * columns.len()` values.
    pub fn add(
        &mut self,
        rows: &[usize],
        columns: &[usize],
        block: &[f64],
    ) -> Result<(), OutsidePattern> {
        assert_eq!(
            block.len(),
            rows.len() * columns.len(),
            "size of a dense block"
        );
        let row_runs = runs(&self.structure, rows);
        let column_runs = runs(&self.structure, columns);
        let mut edges = self.edges(rows, columns, &row_runs, &column_runs)?;
        for (row_run, edges) in row_runs
            .iter()
            .zip(edges.chunks_mut(column_runs.len().max(1)))
        {
            for (run, edge) in column_runs.iter().zip(edges.iter_mut()) {
                *edge = self.structure.column(*edge) + columns[run.begin] - run.first;
            }
            for r in row_run.begin..row_run.end {
                let local = rows[r] - row_run.first;
                let row = &mut self.values[self.structure.row(row_run.owner, local)];
                let dense = &block[r * columns.len()..][..columns.len()];
                add_runs(row, dense, columns, &column_runs, edges);
            }
        }
        Ok(())
    }

    /// Adds a dense row-major block that couples all unknowns of two supervariables.
    ///
    /// # Panics
    /// When the block does not have the size of the two supervariables.
    pub fn add_block(
        &mut self,
        row: Supervariable,
        column: Supervariable,
        block: &[f64],
    ) -> Result<(), OutsidePattern> {
        let (rows, columns) = (self.structure.group(row.0), self.structure.group(column.0));
        assert_eq!(
            block.len(),
            rows.len() * columns.len(),
            "size of a dense block"
        );
        let outside = OutsidePattern {
            row: rows.start,
            column: columns.start,
        };
        let edge = self.structure.edge(row.0, column.0).ok_or(outside)?;
        let first = self.structure.column(edge);
        for (local, dense) in block.chunks_exact(columns.len().max(1)).enumerate() {
            let range = self.structure.row(row.0, local);
            for (value, d) in self.values[range][first..].iter_mut().zip(dense) {
                *value += d;
            }
        }
        Ok(())
    }

    /// Adds to an entry of the diagonal, which every pattern has.
    pub fn add_to_diagonal(&mut self, unknown: usize, value: f64) {
        if let Some(at) = position(&self.structure, unknown, unknown) {
            self.values[at] += value;
        }
    }

    /// An entry, `None` outside the pattern.
    pub fn get(&self, row: usize, column: usize) -> Option<f64> {
        position(&self.structure, row, column).map(|p| self.values[p])
    }

    /// Entries of a row with their columns, in rising order of the columns.
    pub fn row(&self, row: usize) -> impl Iterator<Item = (usize, f64)> + '_ {
        let i = self.structure.owner(row).0;
        let range = self.structure.row(i, row - self.structure.group(i).start);
        self.structure
            .row_columns(i)
            .zip(self.values[range].iter().copied())
    }

    /// `A x` in row `row`.
    pub fn row_product(&self, row: usize, x: &[f64]) -> f64 {
        let structure = &self.structure;
        let i = structure.owner(row).0;
        let values = &self.values[structure.row(i, row - structure.group(i).start)];
        let mut sum = 0.0;
        for edge in structure.edges(i) {
            let group = structure.group(structure.target(edge));
            let block = &values[structure.column(edge)..];
            for (a, x) in block.iter().zip(&x[group]) {
                sum += a * x;
            }
        }
        sum
    }

    /// The transposed matrix, on the same pattern.
    pub fn transpose(&self) -> Self {
        let mut transposed = Self::zero(&self.structure);
        let structure = &self.structure;
        for i in 0..structure.supervariables() {
            for edge in structure.edges(i) {
                let j = structure.target(edge);
                // The pattern is symmetric, so the mirrored edge exists.
                let Some(mirror) = structure.edge(j, i) else {
                    continue;
                };
                for a in 0..structure.group(i).len() {
                    let from = structure.row(i, a).start + structure.column(edge);
                    for b in 0..structure.group(j).len() {
                        let to = structure.row(j, b).start + structure.column(mirror) + a;
                        transposed.values[to] = self.values[from + b];
                    }
                }
            }
        }
        transposed
    }

    /// Largest magnitude in each row.
    pub fn row_maxima(&self) -> Vec<f64> {
        self.scaled_maxima(|_, _| 1.0).0
    }

    /// Largest magnitude in each column.
    pub fn column_maxima(&self) -> Vec<f64> {
        self.scaled_maxima(|_, _| 1.0).1
    }

    /// Largest row sum of magnitudes.
    pub fn infinity_norm(&self) -> f64 {
        let rows = 0..self.structure.unknowns();
        rows.map(|row| self.row(row).map(|(_, a)| a.abs()).sum::<f64>())
            .fold(0.0, f64::max)
    }

    /// Multiplies row `i` by `rows[i]` and column `j` by `columns[j]`.
    pub fn scale(&mut self, rows: &[f64], columns: &[f64]) {
        for i in 0..self.structure.supervariables() {
            for (local, row) in self.structure.group(i).enumerate() {
                let range = self.structure.row(i, local);
                for (value, column) in self.values[range]
                    .iter_mut()
                    .zip(self.structure.row_columns(i))
                {
                    *value *= rows[row] * columns[column];
                }
            }
        }
    }

    /// Largest magnitudes by row and by column of the entries times `scale(row, column)`.
    pub fn scaled_maxima(&self, scale: impl Fn(usize, usize) -> f64) -> (Vec<f64>, Vec<f64>) {
        let n = self.structure.unknowns();
        let (mut rows, mut columns) = (vec![0.0_f64; n], vec![0.0_f64; n]);
        for row in 0..n {
            for (column, a) in self.row(row) {
                let size = a.abs() * scale(row, column);
                rows[row] = rows[row].max(size);
                columns[column] = columns[column].max(size);
            }
        }
        (rows, columns)
    }

    /// All values, row by row.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// All values, row by row.
    pub fn values_mut(&mut self) -> &mut [f64] {
        &mut self.values
    }

    /// Edges between all runs of rows and columns.
    fn edges(
        &self,
        rows: &[usize],
        columns: &[usize],
        row_runs: &[Run],
        column_runs: &[Run],
    ) -> Result<Vec<usize>, OutsidePattern> {
        let width = column_runs.len();
        let mut ascending: Vec<(usize, usize)> = column_runs
            .iter()
            .enumerate()
            .map(|(slot, run)| (run.owner, slot))
            .collect();
        ascending.sort_unstable();
        let mut edges = vec![0; row_runs.len() * width];
        for (run, edges) in row_runs.iter().zip(edges.chunks_mut(width.max(1))) {
            let found = edges_to(&self.structure, run.owner, &ascending, edges);
            found.map_err(|slot| OutsidePattern {
                row: rows[run.begin],
                column: columns[column_runs[slot].begin],
            })?;
        }
        Ok(edges)
    }
}

/// Consecutive unknowns of a list that belong to one supervariable.
struct Run {
    owner: usize,
    begin: usize,
    end: usize,
    /// First unknown of the supervariable.
    first: usize,
    /// `true` if the unknowns have consecutive numbers.
    is_consecutive: bool,
}

/// Adds the values of all runs of columns to a row that has the first of each run at `places`.
fn add_runs(row: &mut [f64], dense: &[f64], columns: &[usize], runs: &[Run], places: &[usize]) {
    for (run, &place) in runs.iter().zip(places) {
        let dense = &dense[run.begin..run.end];
        if !run.is_consecutive {
            for (column, d) in columns[run.begin..run.end].iter().zip(dense) {
                row[place + column - columns[run.begin]] += d;
            }
            continue;
        }
        let values = &mut row[place..place + dense.len()];
        // Most supervariables are triples.
        if let ([x, y, z], [by_x, by_y, by_z]) = (&mut *values, dense) {
            *x += by_x;
            *y += by_y;
            *z += by_z;
        } else {
            let values = values.iter_mut().zip(dense);
            values.for_each(|(value, d)| *value += d);
        }
    }
}

fn runs(structure: &Structure, unknowns: &[usize]) -> Vec<Run> {
    let mut runs: Vec<Run> = Vec::with_capacity(unknowns.len() / 3 + 1);
    for (k, &unknown) in unknowns.iter().enumerate() {
        let owner = structure.owner(unknown).0;
        match runs.last_mut() {
            Some(run) if run.owner == owner => {
                run.is_consecutive &= unknown == unknowns[k - 1] + 1;
                run.end = k + 1;
            }
            _ => runs.push(Run {
                owner,
                begin: k,
                end: k + 1,
                first: structure.group(owner).start,
                is_consecutive: true,
            }),
        }
    }
    runs
}

/// Edges from `i` to others, given in ascending order with the slots of `edges` where
/// theirs belong; the slot of one that is no neighbour as the error.
pub(crate) fn edges_to(
    structure: &Structure,
    i: usize,
    ascending: &[(usize, usize)],
    edges: &mut [usize],
) -> Result<(), usize> {
    let neighbours = structure.adjacent(i);
    // Step by step through short lists, by bisection through long ones.
    let is_short = neighbours.len() <= 8 * ascending.len();
    let mut at = 0;
    for &(j, slot) in ascending {
        let rest = &neighbours[at..];
        at += if is_short {
            let before = rest.iter().take_while(|other| (**other as usize) < j);
            before.count()
        } else {
            rest.partition_point(|other| (*other as usize) < j)
        };
        if neighbours.get(at).is_none_or(|other| *other as usize != j) {
            return Err(slot);
        }
        edges[slot] = structure.edges(i).start + at;
    }
    Ok(())
}

fn position(structure: &Structure, row: usize, column: usize) -> Option<usize> {
    let (i, j) = (structure.owner(row).0, structure.owner(column).0);
    let edge = structure.edge(i, j)?;
    let start = structure.row(i, row - structure.group(i).start).start;
    Some(start + structure.column(edge) + column - structure.group(j).start)
}
