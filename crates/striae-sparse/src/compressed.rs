//! Matrices in compressed rows, gathered from dense blocks on all threads.
//!
//! Rows are sorted by the supervariables that own them. All that belongs to one owner is
//! summed by one thread, in the order of the blocks, so that threads do not change a bit.
//! The rows of an owner are as long as those of a pattern while they are summed; entries
//! that are not zero are what remains.

use crate::{matrix::edges_to, products::RowSums, structure::Structure};
use rayon::prelude::*;
use std::{borrow::Cow, ops::Range};

/// Owners of rows for one thread at a time.
const OWNERS: usize = 4;
/// Rows of a product for one thread at a time.
const ROWS: usize = 512;

/// A dense block and its place in a matrix.
#[derive(Clone, Debug)]
pub struct PlacedBlock<'a> {
    /// Unknowns of the rows that are added, each with its row in the block.
    pub rows: Vec<(usize, usize)>,
    /// Unknowns of the columns, in runs that belong to one supervariable each.
    pub columns: Vec<Range<usize>>,
    /// Values, row by row.
    pub values: Cow<'a, [f64]>,
}

impl PlacedBlock<'_> {
    /// `y += A x`.
    ///
    /// # Panics
    /// When the block is outside the vectors.
    pub fn add_product(&self, x: &[f64], y: &mut [f64]) {
        let own: Vec<f64> = self
            .columns
            .iter()
            .flat_map(|run| &x[run.clone()])
            .copied()
            .collect();
        for &(unknown, row) in &self.rows {
            let values = self.values[row * own.len()..].iter();
            y[unknown] += values.zip(&own).map(|(a, x)| a * x).sum::<f64>();
        }
    }
}

/// A square matrix whose rows list the entries that are not zero.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CompressedRows {
    /// Starts of the entries of each row, and the end of the last ones.
    starts: Vec<usize>,
    columns: Vec<u32>,
    values: Vec<f64>,
}

impl CompressedRows {
    /// The zero matrix of so many unknowns.
    pub fn zero(unknowns: usize) -> Self {
        Self {
            starts: vec![0; unknowns + 1],
            ..Self::default()
        }
    }

    /// A matrix of so many unknowns from its entries, `(row, column, value)`, in rising order
    /// of rows and columns.
    ///
    /// # Panics
    /// When they are in another order, or outside the matrix.
    pub fn from_entries(unknowns: usize, entries: &[(u32, u32, f64)]) -> Self {
        let places = entries.iter().map(|&(row, column, _)| (row, column));
        assert!(places.is_sorted_by(|a, b| a < b), "entries in rising order");
        let mut starts = vec![0; unknowns + 1];
        for &(row, column, _) in entries {
            assert!((column as usize) < unknowns, "a column outside the matrix");
            starts[row as usize + 1] += 1;
        }
        for row in 0..unknowns {
            starts[row + 1] += starts[row];
        }
        Self {
            starts,
            columns: entries.iter().map(|entry| entry.1).collect(),
            values: entries.iter().map(|entry| entry.2).collect(),
        }
    }

    /// The sum of dense blocks on the pattern of a structure.
    ///
    /// # Errors
    /// The numbers of the blocks with an entry outside the pattern, rising.
    ///
    /// # Panics
    /// When a block has no values for one of its rows.
    pub fn gathered(structure: &Structure, blocks: &[PlacedBlock]) -> Result<Self, Vec<usize>> {
        let columns = blocks.par_iter().with_min_len(OWNERS);
        let columns: Vec<Columns> = columns
            .map(|block| Columns::new(structure, &block.columns))
            .collect();
        let parts = parts(structure, blocks);
        let owners: Vec<&[Part]> = parts.chunk_by(|a, b| a.owner == b.owner).collect();
        let given = (structure, blocks, columns.as_slice());
        let gathered = owners.par_iter().with_min_len(OWNERS);
        let gathered: Vec<Result<Rows, Vec<usize>>> = gathered
            .map_init(Buffers::default, |buffers, parts| {
                Rows::summed(given, parts, buffers)
            })
            .collect();
        let failed = gathered.iter().filter_map(|rows| rows.as_ref().err());
        let mut outside: Vec<usize> = failed.flatten().copied().collect();
        if !outside.is_empty() {
            outside.sort_unstable();
            outside.dedup();
            return Err(outside);
        }
        let gathered: Vec<Rows> = gathered.into_iter().flatten().collect();
        let count = gathered.iter().map(|rows| rows.values.len()).sum();
        let mut sum = Self {
            starts: Vec::with_capacity(structure.unknowns() + 1),
            columns: Vec::with_capacity(count),
            values: Vec::with_capacity(count),
        };
        for (parts, rows) in owners.iter().zip(gathered) {
            let first = structure.group(parts[0].owner).start;
            sum.starts.resize(first + 1, sum.values.len());
            let before = sum.values.len();
            sum.starts.extend(rows.ends.iter().map(|end| before + end));
            sum.columns.extend(rows.columns);
            sum.values.extend(rows.values);
        }
        sum.starts
            .resize(structure.unknowns() + 1, sum.values.len());
        Ok(sum)
    }

    /// Number of rows.
    pub fn unknowns(&self) -> usize {
        self.starts.len().saturating_sub(1)
    }

    /// Returns whether all entries are zero.
    pub fn is_zero(&self) -> bool {
        self.values.is_empty()
    }

    /// Entries of a row with their columns, in rising order of the columns.
    pub fn row(&self, row: usize) -> impl Iterator<Item = (usize, f64)> + '_ {
        let range = self.starts[row]..self.starts[row + 1];
        let columns = self.columns[range.clone()].iter();
        columns
            .map(|&column| column as usize)
            .zip(self.values[range].iter().copied())
    }

    /// An entry.
    pub fn get(&self, row: usize, column: usize) -> f64 {
        let range = self.starts[row]..self.starts[row + 1];
        let found = self.columns[range.clone()].binary_search(&(column as u32));
        found.map_or(0.0, |at| self.values[range.start + at])
    }

    /// `y += A x`.
    ///
    /// # Panics
    /// When a vector does not have one entry per unknown.
    pub fn add_product(&self, x: &[f64], y: &mut [f64]) {
        assert_eq!((x.len(), y.len()), (self.unknowns(), self.unknowns()));
        if self.is_zero() {
            return;
        }
        let rows = y.par_iter_mut().enumerate().with_min_len(ROWS);
        rows.for_each(|(row, y)| *y += self.row(row).map(|(c, a)| a * x[c]).sum::<f64>());
    }

    /// Adds what the rows add to the sums of a product.
    pub fn add_row_sums(&self, x: &[f64], units: &[f64], sums: &mut [RowSums]) {
        let rows = sums.par_iter_mut().enumerate().with_min_len(ROWS);
        rows.for_each(|(row, sums)| {
            for (c, a) in self.row(row) {
                sums.add(a, x[c], units[c]);
            }
        });
    }
}

/// Runs of columns of a block.
struct Columns {
    /// Supervariables in rising order, and the run of each.
    ascending: Vec<(usize, usize)>,
    /// First columns of the runs within their supervariables.
    within: Vec<usize>,
}

impl Columns {
    fn new(structure: &Structure, runs: &[Range<usize>]) -> Self {
        let owner = |run: &Range<usize>| structure.owner(run.start).0;
        let owners = runs.iter().map(owner).enumerate();
        let mut ascending: Vec<(usize, usize)> = owners.map(|(at, owner)| (owner, at)).collect();
        ascending.sort_unstable();
        let within = |run: &Range<usize>| run.start - structure.group(owner(run)).start;
        Self {
            ascending,
            within: runs.iter().map(within).collect(),
        }
    }
}

/// Rows of a block that belong to one supervariable.
struct Part {
    owner: usize,
    block: usize,
    begin: usize,
    end: usize,
}

/// Rows of all blocks by owner, then by block.
fn parts(structure: &Structure, blocks: &[PlacedBlock]) -> Vec<Part> {
    let mut parts: Vec<Part> = Vec::new();
    for (block, placed) in blocks.iter().enumerate() {
        let first = parts.len();
        for (at, &(unknown, _)) in placed.rows.iter().enumerate() {
            let owner = structure.owner(unknown).0;
            match parts[first..].last_mut() {
                Some(part) if part.owner == owner => part.end = at + 1,
                _ => parts.push(Part {
                    owner,
                    block,
                    begin: at,
                    end: at + 1,
                }),
            }
        }
    }
    parts.sort_by_key(|part| part.owner);
    parts
}

/// Buffers in which one thread sums.
#[derive(Default)]
struct Buffers {
    /// Rows of an owner as the pattern has them.
    values: Vec<f64>,
    /// Edges of the runs of columns, then their first columns.
    places: Vec<usize>,
}

/// The rows of one supervariable.
struct Rows {
    /// Ends of the entries of each row.
    ends: Vec<usize>,
    columns: Vec<u32>,
    values: Vec<f64>,
}

impl Rows {
    /// The sum of all parts of an owner; of those outside the pattern the blocks.
    fn summed(
        (structure, blocks, columns): (&Structure, &[PlacedBlock], &[Columns]),
        parts: &[Part],
        buffers: &mut Buffers,
    ) -> Result<Self, Vec<usize>> {
        let owner = parts[0].owner;
        buffers.values.clear();
        buffers.values.resize(structure.rows(owner).len(), 0.0);
        let outside = parts.iter().filter(|part| {
            let (block, columns) = (&blocks[part.block], &columns[part.block]);
            !part.add(structure, (block, columns), buffers)
        });
        let outside: Vec<usize> = outside.map(|part| part.block).collect();
        match outside.is_empty() {
            true => Ok(Self::compressed(structure, owner, &buffers.values)),
            false => Err(outside),
        }
    }

    /// The entries that are not zero.
    fn compressed(structure: &Structure, owner: usize, values: &[f64]) -> Self {
        let count = values.iter().filter(|a| **a != 0.0).count();
        let mut rows = Self {
            ends: Vec::with_capacity(structure.group(owner).len()),
            columns: Vec::with_capacity(count),
            values: Vec::with_capacity(count),
        };
        for values in values.chunks_exact(structure.row_length(owner)) {
            let entries = structure.row_columns(owner).zip(values);
            for (column, &a) in entries.filter(|(_, a)| **a != 0.0) {
                rows.columns.push(column as u32);
                rows.values.push(a);
            }
            rows.ends.push(rows.values.len());
        }
        rows
    }
}

impl Part {
    /// Adds the rows to those of their owner; whether all of their entries have a place.
    fn add(
        &self,
        structure: &Structure,
        (block, columns): (&PlacedBlock, &Columns),
        buffers: &mut Buffers,
    ) -> bool {
        let Buffers { values, places } = buffers;
        places.resize(columns.within.len(), 0);
        if edges_to(structure, self.owner, &columns.ascending, places).is_err() {
            return false;
        }
        for (place, within) in places.iter_mut().zip(&columns.within) {
            *place = structure.column(*place) + within;
        }
        let first = structure.group(self.owner).start;
        let length = structure.row_length(self.owner);
        let width: usize = block.columns.iter().map(|run| run.len()).sum();
        for &(unknown, row) in &block.rows[self.begin..self.end] {
            let target = &mut values[(unknown - first) * length..][..length];
            let mut rest = &block.values[row * width..][..width];
            for (place, run) in places.iter().zip(&block.columns) {
                let (own, others) = rest.split_at(run.len());
                rest = others;
                add(&mut target[*place..][..run.len()], own);
            }
        }
        true
    }
}

/// `target += by`; most runs are triples.
fn add(target: &mut [f64], by: &[f64]) {
    if let ([x, y, z], [by_x, by_y, by_z]) = (&mut *target, by) {
        *x += by_x;
        *y += by_y;
        *z += by_z;
    } else {
        let entries = target.iter_mut().zip(by);
        entries.for_each(|(entry, value)| *entry += value);
    }
}
