//! Blocks between the members of many cliques, added by the owners of their rows.
//!
//! Cliques of one size, say the elements of a kind, come in batches. All that a batch adds
//! to the rows of one supervariable is added by one thread, in the order of the cliques, so
//! that sums are those of a plain loop over the cliques, whatever the number of threads.
//! Where the blocks belong is found once for a pattern.

use super::{SparseMatrix, edges_to};
use crate::{structure::Structure, supervariable::Supervariable};
use rayon::prelude::*;
use std::ops::Range;

/// Members of cliques for one thread at a time.
const MEMBERS: usize = 128;
/// Marker of a block outside the pattern.
const NOWHERE: u32 = u32::MAX;

/// Positions of the blocks between the members of cliques in the matrices of a structure.
#[derive(Clone, Debug)]
pub struct CliquePlaces {
    /// Members of each clique.
    size: usize,
    /// Cliques of a batch.
    batch: usize,
    /// Supervariables, clique by clique.
    members: Vec<u32>,
    /// In the rows of a member, the first column of every member of its clique.
    columns: Vec<u32>,
    /// Places among the members: batch by batch, by supervariable, by clique.
    order: Vec<u32>,
}

/// A member of a clique.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Member {
    /// Number of the clique.
    pub clique: usize,
    /// Place in the clique.
    pub slot: usize,
    /// Supervariable at this position.
    pub supervariable: Supervariable,
}

/// The rows of a member of a clique in a matrix.
pub struct MemberRows<'a> {
    values: &'a mut [f64],
    length: usize,
    columns: &'a [u32],
}

impl MemberRows<'_> {
    /// Sets all entries to zero.
    pub fn clear(&mut self) {
        self.values.fill(0.0);
    }

    /// Adds to the leading columns of all members of the clique in a row, counted within the
    /// member.
    pub fn add<const W: usize>(&mut self, row: usize, blocks: &[[f64; W]]) {
        let values = &mut self.values[row * self.length..][..self.length];
        for (&column, block) in self.columns.iter().zip(blocks) {
            let entries = values[column as usize..][..W].iter_mut();
            entries.zip(block).for_each(|(entry, by)| *entry += by);
        }
    }
}

impl CliquePlaces {
    /// Places of cliques with so many `members` each, `batch` of them at a time.
    ///
    /// # Panics
    /// When a batch is empty, or members are missing.
    pub fn new(structure: &Structure, size: usize, batch: usize, members: Vec<u32>) -> Self {
        assert!(batch > 0 && size > 0, "size of a batch of cliques");
        assert!(members.len().is_multiple_of(size), "members of cliques");
        let mut order: Vec<u32> = (0..members.len() as u32).collect();
        for batch in order.chunks_mut(batch * size) {
            batch.sort_by_key(|&at| members[at as usize]);
        }
        let mut places = Self {
            size,
            batch,
            columns: Vec::new(),
            members,
            order,
        };
        places.find(structure);
        places
    }

    /// Finds the places again, for another structure of these supervariables.
    pub fn find(&mut self, structure: &Structure) {
        let size = self.size;
        self.columns.resize(self.members.len() * size, NOWHERE);
        let cliques = self.columns.par_chunks_mut(size * size);
        let members = self.members.par_chunks(size);
        cliques
            .zip(members)
            .with_min_len(64)
            .for_each(|(columns, members)| find_columns(structure, members, columns));
    }

    /// Number of cliques.
    pub fn count(&self) -> usize {
        self.members.len() / self.size
    }

    /// Cliques of all batches.
    pub fn batches(&self) -> impl ExactSizeIterator<Item = Range<usize>> + use<> {
        let (batch, count) = (self.batch, self.count());
        let firsts = (0..count).step_by(batch);
        firsts.map(move |first| first..(first + batch).min(count))
    }

    /// Returns whether all blocks of a clique are inside the pattern.
    pub fn has_place(&self, clique: usize) -> bool {
        self.columns[clique * self.size * self.size] != NOWHERE
    }
}

/// First columns of the members of a clique in the rows of each; none of them where one is
/// missing.
fn find_columns(structure: &Structure, members: &[u32], columns: &mut [u32]) {
    let size = members.len();
    let slots = members.iter().enumerate();
    let mut ascending: Vec<(usize, usize)> = slots.map(|(k, &i)| (i as usize, k)).collect();
    ascending.sort_unstable();
    let mut edges = vec![0; size];
    for (&member, columns) in members.iter().zip(columns.chunks_mut(size)) {
        if edges_to(structure, member as usize, &ascending, &mut edges).is_err() {
            columns[0] = NOWHERE;
            break;
        }
        for (column, edge) in columns.iter_mut().zip(&edges) {
            *column = structure.column(*edge) as u32;
        }
    }
    if columns.chunks(size).any(|row| row[0] == NOWHERE) {
        columns.fill(NOWHERE);
    }
}

impl SparseMatrix {
    /// Adds a batch of cliques: `add` is called for every member with its rows and with what
    /// is summed for its supervariable, one of `sums`.
    ///
    /// # Panics
    /// When a clique of the batch has no place, or there are too few sums.
    pub fn add_batch<T: Send>(
        &mut self,
        places: &CliquePlaces,
        batch: usize,
        sums: &mut [T],
        add: impl Fn(Member, MemberRows, &mut T) + Sync,
    ) {
        let length = places.batch * places.size;
        let end = ((batch + 1) * length).min(places.order.len());
        let share = Share {
            order: &places.order[batch * length..end],
            values: &mut self.values,
            passed: 0,
            sums,
            first: 0,
        };
        share.add(&self.structure, places, &add);
    }

    /// Sets the rows of some supervariables to zero.
    pub fn clear_rows(&mut self, of: impl Iterator<Item = Supervariable>) {
        for supervariable in of {
            self.values[self.structure.rows(supervariable.0)].fill(0.0);
        }
    }

    /// The rows of the member at a slot of a clique that has a place.
    ///
    /// # Panics
    /// When it has none.
    pub fn rows_of_member<'a>(
        &'a mut self,
        places: &'a CliquePlaces,
        (clique, slot): (usize, usize),
    ) -> MemberRows<'a> {
        let at = clique * places.size + slot;
        let owner = places.members[at] as usize;
        let values = &mut self.values[self.structure.rows(owner)];
        places.rows_in(values, self.structure.row_length(owner), at)
    }
}

/// Part of a batch that one thread adds.
struct Share<'a, T> {
    order: &'a [u32],
    /// Values of the matrix from `passed` on.
    values: &'a mut [f64],
    passed: usize,
    /// Sums from that of supervariable `first` on.
    sums: &'a mut [T],
    first: usize,
}

impl<T: Send> Share<'_, T> {
    fn add(
        self,
        structure: &Structure,
        places: &CliquePlaces,
        add: &(impl Fn(Member, MemberRows, &mut T) + Sync),
    ) {
        let owner = |at: &u32| places.members[*at as usize] as usize;
        let Self {
            order,
            values,
            passed,
            sums,
            first,
        } = self;
        let middle = order.get(order.len() / 2).map_or(0, owner);
        let half = order.partition_point(|at| owner(at) < middle);
        if order.len() <= MEMBERS || half == 0 {
            for at in order {
                let owner = owner(at);
                let rows = structure.rows(owner);
                let rows = &mut values[rows.start - passed..rows.end - passed];
                let at = *at as usize;
                let member = Member {
                    clique: at / places.size,
                    slot: at % places.size,
                    supervariable: Supervariable(owner),
                };
                let rows = places.rows_in(rows, structure.row_length(owner), at);
                add(member, rows, &mut sums[owner - first]);
            }
            return;
        }
        let start = structure.rows(middle).start;
        let (values, others) = values.split_at_mut(start - passed);
        let (sums, sums_of_others) = sums.split_at_mut(middle - first);
        let (order, rest) = order.split_at(half);
        let lower = Share {
            order,
            values,
            passed,
            sums,
            first,
        };
        let upper = Share {
            order: rest,
            values: others,
            passed: start,
            sums: sums_of_others,
            first: middle,
        };
        rayon::join(
            || lower.add(structure, places, add),
            || upper.add(structure, places, add),
        );
    }
}

impl CliquePlaces {
    fn rows_in<'a>(&'a self, values: &'a mut [f64], length: usize, at: usize) -> MemberRows<'a> {
        MemberRows {
            values,
            length,
            columns: &self.columns[at * self.size..(at + 1) * self.size],
        }
    }
}
