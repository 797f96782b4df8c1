//! Many dense blocks added at once, on all threads.
//!
//! Rows are sorted by the supervariables that own them. All that belongs to one owner is
//! added by one thread, in the order of the blocks, so that threads do not change a bit.

use super::{Run, SparseMatrix, add_runs, edges_to, runs};
use crate::structure::Structure;
use rayon::prelude::*;

/// Owners of rows for one thread at a time.
const OWNERS: usize = 4;

/// A dense block and its place in the matrix.
#[derive(Clone, Debug)]
pub struct PlacedBlock<'a> {
    /// Unknowns of the rows that are added, each with its row in the block.
    pub rows: Vec<(usize, usize)>,
    /// Unknowns of all columns.
    pub columns: Vec<usize>,
    /// Values, row by row.
    pub values: &'a [f64],
}

/// Columns of a block, in runs of one supervariable each.
struct Columns {
    runs: Vec<Run>,
    /// Supervariables in rising order, and the run of each.
    ascending: Vec<(usize, usize)>,
}

/// Rows of a block that belong to one supervariable.
struct Part {
    owner: usize,
    block: usize,
    begin: usize,
    end: usize,
}

impl SparseMatrix {
    /// Adds dense blocks, see [`add`](Self::add).
    ///
    /// # Errors
    /// The numbers of the blocks with an entry outside the pattern, rising; what the matrix
    /// holds is of no use then.
    ///
    /// # Panics
    /// When a block has no values for one of its rows.
    pub fn add_all(&mut self, blocks: &[PlacedBlock]) -> Result<(), Vec<usize>> {
        let structure = self.structure.clone();
        let columns = blocks.par_iter().with_min_len(OWNERS);
        let columns: Vec<Columns> = columns
            .map(|block| Columns::new(&structure, &block.columns))
            .collect();
        let parts = parts(&structure, blocks);
        let mut owners = Vec::new();
        let (mut rest, mut passed) = (self.values.as_mut_slice(), 0);
        for parts in parts.chunk_by(|a, b| a.owner == b.owner) {
            let range = structure.rows(parts[0].owner);
            let (_, from) = rest.split_at_mut(range.start - passed);
            let (own, others) = from.split_at_mut(range.len());
            (rest, passed) = (others, range.end);
            owners.push((parts, own));
        }
        let outside = owners
            .into_par_iter()
            .with_min_len(OWNERS)
            .map(|(parts, values)| {
                let failed = parts.iter().filter(|part| {
                    let (block, columns) = (&blocks[part.block], &columns[part.block]);
                    !part.add(&structure, (block, columns), values)
                });
                failed.map(|part| part.block).collect::<Vec<usize>>()
            });
        let mut outside: Vec<usize> = outside.collect::<Vec<_>>().concat();
        if outside.is_empty() {
            return Ok(());
        }
        outside.sort_unstable();
        outside.dedup();
        Err(outside)
    }
}

impl Columns {
    fn new(structure: &Structure, unknowns: &[usize]) -> Self {
        let runs = runs(structure, unknowns);
        let owners = runs.iter().enumerate().map(|(at, run)| (run.owner, at));
        let mut ascending: Vec<(usize, usize)> = owners.collect();
        ascending.sort_unstable();
        Self { runs, ascending }
    }
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

impl Part {
    /// Adds the rows to those of their owner; whether all of their entries have a place.
    fn add(
        &self,
        structure: &Structure,
        (block, columns): (&PlacedBlock, &Columns),
        values: &mut [f64],
    ) -> bool {
        let mut places = vec![0; columns.runs.len()];
        if edges_to(structure, self.owner, &columns.ascending, &mut places).is_err() {
            return false;
        }
        for (run, place) in columns.runs.iter().zip(&mut places) {
            *place = structure.column(*place) + block.columns[run.begin] - run.first;
        }
        let first = structure.group(self.owner).start;
        let (length, width) = (structure.row_length(self.owner), block.columns.len());
        for &(unknown, row) in &block.rows[self.begin..self.end] {
            let target = &mut values[(unknown - first) * length..][..length];
            let dense = &block.values[row * width..][..width];
            add_runs(target, dense, &block.columns, &columns.runs, &places);
        }
        true
    }
}
