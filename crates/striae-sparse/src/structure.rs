//! Grouping and coupling of unknowns: the symbolic half of a sparse matrix.
//!
//! Scalar unknowns are numbered `0..unknowns`. Supervariable `I` owns the
//! contiguous unknowns `offsets[I]..offsets[I + 1]` (possibly none). Two
//! supervariables are adjacent when a clique contains both; every one is
//! adjacent to itself. The pattern is symmetric and made of dense blocks.

use crate::{
    error::StructureError,
    supervariable::{Supervariable, Tier},
};
use std::{ops::Range, sync::Arc};

/// Unknowns in supervariables and the adjacency between them; cheap to clone.
#[derive(Clone, Debug)]
pub struct Structure(Arc<Pattern>);

#[derive(Clone, Debug, PartialEq)]
struct Pattern {
    offsets: Vec<usize>,
    owner: Vec<u32>,
    tiers: Vec<Tier>,
    /// Adjacency in compressed rows, sorted, with the diagonal.
    starts: Vec<usize>,
    neighbours: Vec<u32>,
    /// First column of each neighbour inside a row of its supervariable.
    columns: Vec<u32>,
    /// First value of each supervariable's rows in a matrix.
    values: Vec<usize>,
}

impl Structure {
    /// Structure in which the supervariables of each clique are all adjacent.
    ///
    /// `offsets` has one entry more than there are supervariables. All tiers are zero.
    pub fn from_cliques<C: AsRef<[Supervariable]>>(
        offsets: Vec<usize>,
        cliques: &[C],
    ) -> Result<Self, StructureError> {
        check_offsets(&offsets)?;
        let count = offsets.len() - 1;
        let (starts, neighbours) = adjacency(count, cliques, None)?;
        Ok(Self::from_adjacency(offsets, starts, neighbours))
    }

    /// Structure with a given symmetric adjacency in compressed sorted rows, with the diagonal.
    pub fn from_adjacency(offsets: Vec<usize>, starts: Vec<usize>, neighbours: Vec<u32>) -> Self {
        let tiers = vec![Tier(0); offsets.len() - 1];
        Self(Arc::new(Pattern::new(offsets, tiers, starts, neighbours)))
    }

    /// Copy of the structure with other ordering tiers, one per supervariable.
    pub fn with_tiers(&self, tiers: Vec<Tier>) -> Result<Self, StructureError> {
        let expected = self.supervariables();
        if tiers.len() != expected {
            return Err(StructureError::Tiers {
                found: tiers.len(),
                expected,
            });
        }
        Ok(Self(Arc::new(Pattern {
            tiers,
            ..(*self.0).clone()
        })))
    }

    /// Copy of the structure with additional cliques.
    pub fn grown<C: AsRef<[Supervariable]>>(&self, cliques: &[C]) -> Result<Self, StructureError> {
        let p = &*self.0;
        let (starts, neighbours) = adjacency(self.supervariables(), cliques, Some(p))?;
        let (offsets, tiers) = (p.offsets.clone(), p.tiers.clone());
        Ok(Self(Arc::new(Pattern::new(
            offsets, tiers, starts, neighbours,
        ))))
    }

    /// Number of scalar unknowns.
    pub fn unknowns(&self) -> usize {
        self.0.owner.len()
    }

    /// Number of supervariables.
    pub fn supervariables(&self) -> usize {
        self.0.tiers.len()
    }

    /// Number of entries of a matrix of this structure.
    pub fn entries(&self) -> usize {
        self.0.values.last().copied().unwrap_or(0)
    }

    /// Unknowns of a supervariable.
    pub fn unknowns_of(&self, supervariable: Supervariable) -> Range<usize> {
        self.0.offsets[supervariable.0]..self.0.offsets[supervariable.0 + 1]
    }

    /// Supervariable that owns an unknown.
    pub fn owner(&self, unknown: usize) -> Supervariable {
        Supervariable(self.0.owner[unknown] as usize)
    }

    /// Ordering tier of a supervariable.
    pub fn tier(&self, supervariable: Supervariable) -> Tier {
        self.0.tiers[supervariable.0]
    }

    /// Ordering tiers of all supervariables.
    pub fn tiers(&self) -> &[Tier] {
        &self.0.tiers
    }

    /// Supervariables adjacent to one, itself among them, in rising order.
    pub fn neighbours(
        &self,
        supervariable: Supervariable,
    ) -> impl ExactSizeIterator<Item = Supervariable> + '_ {
        let range = self.edges(supervariable.0);
        self.0.neighbours[range]
            .iter()
            .map(|&j| Supervariable(j as usize))
    }

    /// Returns whether two handles refer to one structure.
    pub fn same_as(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0) || self.0 == other.0
    }

    /// Positions in the adjacency of the neighbours of supervariable `i`.
    pub fn edges(&self, i: usize) -> Range<usize> {
        self.0.starts[i]..self.0.starts[i + 1]
    }

    /// Number of edges, each counted at both ends.
    pub fn edges_total(&self) -> usize {
        self.0.neighbours.len()
    }

    /// Supervariable at the far end of an edge.
    pub fn target(&self, edge: usize) -> usize {
        self.0.neighbours[edge] as usize
    }

    /// First column of an edge's block inside a row.
    pub fn column(&self, edge: usize) -> usize {
        self.0.columns[edge] as usize
    }

    /// Edge from `i` to `j`.
    pub fn edge(&self, i: usize, j: usize) -> Option<usize> {
        let range = self.edges(i);
        let found = self.0.neighbours[range.clone()]
            .binary_search(&(j as u32))
            .ok()?;
        Some(range.start + found)
    }

    /// Neighbours of supervariable `i`, ascending.
    pub fn adjacent(&self, i: usize) -> &[u32] {
        &self.0.neighbours[self.edges(i)]
    }

    /// Unknowns of supervariable `i`.
    pub fn group(&self, i: usize) -> Range<usize> {
        self.0.offsets[i]..self.0.offsets[i + 1]
    }

    /// Number of entries in each row of supervariable `i`.
    pub fn row_length(&self, i: usize) -> usize {
        match self.group(i).len() {
            0 => 0,
            rows => (self.0.values[i + 1] - self.0.values[i]) / rows,
        }
    }

    /// Positions of the values of a row of supervariable `i`, `local` rows into it.
    pub fn row(&self, i: usize, local: usize) -> Range<usize> {
        let length = self.row_length(i);
        let start = self.0.values[i] + local * length;
        start..start + length
    }

    /// Columns of the entries of the rows of supervariable `i`, in storage order.
    pub fn row_columns(&self, i: usize) -> impl Iterator<Item = usize> + '_ {
        self.column_groups(i).flatten()
    }

    /// Column ranges grouped by the supervariables they belong to.
    pub fn column_groups(&self, i: usize) -> impl Iterator<Item = Range<usize>> + '_ {
        self.edges(i).map(|edge| self.group(self.target(edge)))
    }

    /// Range of the values of all rows of supervariable `i`.
    pub fn rows(&self, i: usize) -> Range<usize> {
        let start = self.0.values[i];
        start..start + self.group(i).len() * self.row_length(i)
    }
}

impl Pattern {
    fn new(
        offsets: Vec<usize>,
        tiers: Vec<Tier>,
        starts: Vec<usize>,
        neighbours: Vec<u32>,
    ) -> Self {
        let size = |i: usize| offsets[i + 1] - offsets[i];
        let mut owner = Vec::with_capacity(offsets[tiers.len()]);
        let mut columns = Vec::with_capacity(neighbours.len());
        let mut values = Vec::with_capacity(offsets.len());
        values.push(0);
        for i in 0..tiers.len() {
            owner.resize(offsets[i + 1], i as u32);
            let mut column = 0;
            for &j in &neighbours[starts[i]..starts[i + 1]] {
                columns.push(column as u32);
                column += size(j as usize);
            }
            values.push(values[i] + size(i) * column);
        }
        Self {
            offsets,
            owner,
            tiers,
            starts,
            neighbours,
            columns,
            values,
        }
    }
}

fn check_offsets(offsets: &[usize]) -> Result<(), StructureError> {
    if offsets.first() != Some(&0) {
        let offset = offsets.first().copied().unwrap_or(usize::MAX);
        return Err(StructureError::Offsets {
            index: 0,
            offset,
            previous: 0,
        });
    }
    for (index, pair) in offsets.windows(2).enumerate() {
        if pair[1] < pair[0] {
            return Err(StructureError::Offsets {
                index: index + 1,
                offset: pair[1],
                previous: pair[0],
            });
        }
    }
    Ok(())
}

/// Sorted adjacency lists with the diagonal, from cliques and an older pattern.
fn adjacency<C: AsRef<[Supervariable]>>(
    count: usize,
    cliques: &[C],
    older: Option<&Pattern>,
) -> Result<(Vec<usize>, Vec<u32>), StructureError> {
    let (incidence_starts, incidence) = incidence(count, cliques)?;
    let mut starts = vec![0];
    let mut neighbours = Vec::new();
    let mut mark = vec![u32::MAX; count];
    for i in 0..count {
        let begin = neighbours.len();
        let mut note = |j: u32| {
            if mark[j as usize] != i as u32 {
                mark[j as usize] = i as u32;
                neighbours.push(j);
            }
        };
        note(i as u32);
        if let Some(p) = older {
            p.neighbours[p.starts[i]..p.starts[i + 1]]
                .iter()
                .for_each(|&j| note(j));
        }
        for &clique in &incidence[incidence_starts[i]..incidence_starts[i + 1]] {
            cliques[clique as usize]
                .as_ref()
                .iter()
                .for_each(|s| note(s.0 as u32));
        }
        neighbours[begin..].sort_unstable();
        starts.push(neighbours.len());
    }
    Ok((starts, neighbours))
}

/// Cliques of each supervariable, in compressed rows.
fn incidence<C: AsRef<[Supervariable]>>(
    count: usize,
    cliques: &[C],
) -> Result<(Vec<usize>, Vec<u32>), StructureError> {
    let mut starts = vec![0; count + 1];
    for (clique, members) in cliques.iter().enumerate() {
        for &supervariable in members.as_ref() {
            if supervariable.0 >= count {
                return Err(StructureError::UnknownSupervariable {
                    clique,
                    supervariable,
                    count,
                });
            }
            starts[supervariable.0 + 1] += 1;
        }
    }
    for i in 0..count {
        starts[i + 1] += starts[i];
    }
    let mut next = starts.clone();
    let mut incidence = vec![0; starts[count]];
    for (clique, members) in cliques.iter().enumerate() {
        for s in members.as_ref() {
            incidence[next[s.0]] = clique as u32;
            next[s.0] += 1;
        }
    }
    Ok((starts, incidence))
}
