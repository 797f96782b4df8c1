//! Many dense blocks added at once, on all threads.
//!
//! Rows are sorted by the supervariables that own them. All that belongs to one owner is
//! added by one thread, in the order of the blocks, so that threads do not change a bit.

use super::{SparseMatrix, edges_to};
use crate::structure::Structure;
use rayon::prelude::*;

/// Owners of rows for one thread at a time.
const OWNERS: usize = 4;

/// A dense block and its place in the matrix.
#[derive(Clone, Debug)]
pub struct PlacedBlock<'a> {
    /// Unknowns of the rows that are added, each with its row in the block.
    pub rows: Vec<(usize, usize)>,
    /// First unknowns of the columns, which come in triples of one supervariable each.
    pub triples: Vec<usize>,
    /// Values, row by row.
    pub values: &'a [f64],
}

/// Triples of columns of a block.
struct Columns {
    /// Supervariables in rising order, and the triple of each.
    ascending: Vec<(usize, usize)>,
    /// First columns of the triples within their supervariables.
    within: Vec<usize>,
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
            .map(|block| Columns::new(&structure, &block.triples))
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
                let mut places = Vec::new();
                let failed = parts.iter().filter(|part| {
                    let (block, columns) = (&blocks[part.block], &columns[part.block]);
                    !part.add(&structure, (block, columns), values, &mut places)
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
    fn new(structure: &Structure, triples: &[usize]) -> Self {
        let owner = |first: &usize| structure.owner(*first).0;
        let owners = triples.iter().map(owner).enumerate();
        let mut ascending: Vec<(usize, usize)> = owners.map(|(at, owner)| (owner, at)).collect();
        ascending.sort_unstable();
        let start = |first: &usize| structure.group(owner(first)).start;
        Self {
            ascending,
            within: triples.iter().map(|first| first - start(first)).collect(),
        }
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
        places: &mut Vec<usize>,
    ) -> bool {
        places.resize(columns.within.len(), 0);
        if edges_to(structure, self.owner, &columns.ascending, places).is_err() {
            return false;
        }
        for (place, within) in places.iter_mut().zip(&columns.within) {
            *place = structure.column(*place) + within;
        }
        let first = structure.group(self.owner).start;
        let (length, width) = (structure.row_length(self.owner), 3 * places.len());
        for &(unknown, row) in &block.rows[self.begin..self.end] {
            let target = &mut values[(unknown - first) * length..][..length];
            let (triples, _) = block.values[row * width..][..width].as_chunks::<3>();
            for (place, by) in places.iter().zip(triples) {
                let entries = target[*place..*place + 3].iter_mut();
                entries.zip(by).for_each(|(entry, value)| *entry += value);
            }
        }
        true
    }
}
