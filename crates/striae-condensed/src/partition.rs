//! Division of a structure into bodies and their interface.
//!
//! The *bulk* consists of the couplings of elements: the leading unknowns of every supervariable
//! and the edges between them. Ties may couple more ([`Partition::tied`]), and so may contact
//! ([`Partition::grown`]): their supervariables are the *interface*, and they are *kept* when the
//! rest of the bulk is condensed, as are those with other unknowns (multipliers). Bodies and ties
//! share a pattern; contact has a part of the [`Tangent`](crate::Tangent) of its own.

use crate::{growth::Growth, tangent::Tangent};
use std::{ops::Deref, ops::Range, sync::Arc};
use striae_sparse::{CompressedRows, PlacedBlock, Structure, StructureError, Supervariable};
use thiserror::Error;

/// A structure with its bulk and its interface; cheap to clone.
#[derive(Clone, Debug)]
pub struct Partition {
    /// Pattern of the bodies.
    structure: Structure,
    /// Structure including the couplings of contact.
    whole: Structure,
    parts: Arc<Parts>,
    numbering: Option<Arc<Numbering>>,
}

#[derive(Clone, Debug, PartialEq)]
struct Parts {
    /// Leading unknowns of each supervariable that belong to the bulk.
    bulk: Vec<u32>,
    /// `true` for each edge that belongs to the bulk.
    bulk_edges: Vec<bool>,
    /// `true` for each supervariable that belongs to the interface.
    kept: Vec<bool>,
    /// Point of each supervariable, if they are known.
    points: Option<Arc<[[f64; 3]]>>,
}

/// Numbers in the whole system of the unknowns of a part.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Numbering {
    /// Unknowns of the whole system.
    pub count: usize,
    /// Unknowns owned by this rank; the ranges of all ranks follow one another.
    pub own: Range<usize>,
    /// Number in the whole system of every unknown of the part.
    pub whole: Vec<usize>,
}

/// A list that does not fit its structure.
#[derive(Clone, Copy, Debug, Error, PartialEq, Eq)]
pub enum PartitionError {
    /// The list of bulk unknowns has the wrong length.
    #[error("{found} numbers of bulk unknowns for {expected} supervariables")]
    Bulk {
        /// Length of the list.
        found: usize,
        /// Number of supervariables.
        expected: usize,
    },
    /// The list of points has the wrong length.
    #[error("{found} points for {expected} supervariables")]
    Points {
        /// Length of the list.
        found: usize,
        /// Number of supervariables.
        expected: usize,
    },
}

impl Deref for Partition {
    type Target = Structure;

    fn deref(&self) -> &Structure {
        &self.structure
    }
}

impl From<&Structure> for Partition {
    /// A structure that is all bulk, with nothing kept.
    fn from(structure: &Structure) -> Self {
        let all = 0..structure.supervariables();
        let size = |i: usize| structure.group(i).len() as u32;
        Self {
            parts: Arc::new(Parts {
                bulk: all.clone().map(size).collect(),
                bulk_edges: vec![true; structure.edges_total()],
                kept: vec![false; all.len()],
                points: None,
            }),
            structure: structure.clone(),
            whole: structure.clone(),
            numbering: None,
        }
    }
}

impl Partition {
    /// The partition of a structure that is coupled by the bulk alone. So many leading
    /// unknowns of each supervariable belong to it; those with others are kept.
    ///
    /// # Errors
    /// When there is not one number a supervariable.
    pub fn new(structure: &Structure, bulk: &[usize]) -> Result<Self, PartitionError> {
        let expected = structure.supervariables();
        if bulk.len() != expected {
            return Err(PartitionError::Bulk {
                found: bulk.len(),
                expected,
            });
        }
        let mut partition = Self::from(structure);
        let parts = Arc::make_mut(&mut partition.parts);
        for (i, &count) in bulk.iter().enumerate() {
            let size = structure.group(i).len();
            parts.bulk[i] = count.min(size) as u32;
            parts.kept[i] = count < size;
        }
        Ok(partition)
    }

    /// Copy with a point for every supervariable, at which rigid translations and rotations of the
    /// bulk are evaluated (its three unknowns are components along the axes). The iterative solver
    /// needs these.
    ///
    /// # Errors
    /// If there is not exactly one point per supervariable.
    pub fn with_points(mut self, points: Vec<[f64; 3]>) -> Result<Self, PartitionError> {
        let expected = self.supervariables();
        if points.len() != expected {
            return Err(PartitionError::Points {
                found: points.len(),
                expected,
            });
        }
        Arc::make_mut(&mut self.parts).points = Some(points.into());
        Ok(self)
    }

    /// Copy that is part of a system which several ranks put together, with the numbers that its
    /// unknowns have there.
    pub fn numbered(self, numbering: Numbering) -> Self {
        Self {
            numbering: Some(Arc::new(numbering)),
            ..self
        }
    }

    /// Copy with cliques coupled by ties: these join the pattern of the bodies, not the bulk, and
    /// their supervariables are kept.
    ///
    /// # Errors
    /// If a clique names a supervariable that does not exist.
    pub fn tied(&self, ties: &Growth) -> Result<Self, StructureError> {
        let structure = self.structure.grown(ties.cliques())?;
        let mut parts = (*self.parts).clone();
        parts.bulk_edges.clear();
        for i in 0..structure.supervariables() {
            parts.bulk_edges.extend(structure.edges(i).map(|edge| {
                let older = self.edge(i, structure.target(edge));
                older.is_some_and(|older| self.is_bulk_edge(older))
            }));
        }
        parts.keep(ties);
        Ok(Self {
            structure,
            whole: self.whole.grown(ties.cliques())?,
            parts: Arc::new(parts),
            numbering: self.numbering.clone(),
        })
    }

    /// Copy with cliques coupled by contact, whose supervariables are kept.
    ///
    /// # Errors
    /// If a clique names a supervariable that does not exist.
    pub fn grown(&self, growth: &Growth) -> Result<Self, StructureError> {
        let mut parts = (*self.parts).clone();
        let whole = self.whole.grown(growth.cliques())?;
        parts.keep(growth);
        Ok(Self {
            structure: self.structure.clone(),
            whole,
            parts: Arc::new(parts),
            numbering: self.numbering.clone(),
        })
    }

    /// The sum of blocks of contact, which couple kept supervariables.
    ///
    /// # Errors
    /// By what the partition is to [grow](Self::grown) before it has a place for all blocks.
    pub fn gathered(&self, blocks: &[PlacedBlock]) -> Result<CompressedRows, Growth> {
        let is_kept = |unknown: usize| self.is_kept(self.owner(unknown));
        let is_known = |block: &PlacedBlock| {
            let mut rows = block.rows.iter().map(|row| row.0);
            let mut columns = block.columns.iter().map(|run| run.start);
            rows.all(is_kept) && columns.all(is_kept)
        };
        let unknown = (0..blocks.len()).filter(|&at| !is_known(&blocks[at]));
        let mut outside: Vec<usize> = unknown.collect();
        let gathered = CompressedRows::gathered(&self.whole, blocks);
        match gathered {
            Ok(rows) if outside.is_empty() => return Ok(rows),
            Ok(_) => {}
            Err(others) => outside.extend(others),
        }
        outside.sort_unstable();
        outside.dedup();
        Err(outside.iter().map(|&at| self.clique(&blocks[at])).collect())
    }

    /// Supervariables that a block couples.
    fn clique(&self, block: &PlacedBlock) -> Vec<Supervariable> {
        let rows = block.rows.iter().map(|row| row.0);
        let unknowns = rows.chain(block.columns.iter().map(|run| run.start));
        let mut clique: Vec<Supervariable> = unknowns.map(|unknown| self.owner(unknown)).collect();
        clique.sort_unstable();
        clique.dedup();
        clique
    }

    /// Pattern of the bodies.
    pub fn structure(&self) -> &Structure {
        &self.structure
    }

    /// Structure including the couplings of contact.
    pub fn whole(&self) -> &Structure {
        &self.whole
    }

    /// Returns whether a supervariable belongs to the interface.
    pub fn is_kept(&self, supervariable: Supervariable) -> bool {
        self.parts.kept[supervariable.0]
    }

    /// Supervariables that belong to the interface.
    pub fn kept(&self) -> impl Iterator<Item = Supervariable> + '_ {
        let all = (0..self.supervariables()).map(Supervariable);
        all.filter(|&supervariable| self.is_kept(supervariable))
    }

    /// Copy with all supervariables kept.
    pub(crate) fn with_all_kept(mut self) -> Self {
        Arc::make_mut(&mut self.parts).kept.fill(true);
        self
    }

    /// Returns whether a matrix has this pattern.
    pub(crate) fn fits(&self, tangent: &Tangent) -> bool {
        self.structure.same_as(tangent.bodies.structure())
            && tangent.contact.unknowns() == self.unknowns()
    }

    /// Returns whether bodies and kept unknowns are those of another partition.
    pub(crate) fn condenses_like(&self, other: &Self) -> bool {
        self.structure.same_as(&other.structure) && self.parts == other.parts
    }

    /// Unknowns of supervariable `i` that belong to the bulk.
    pub fn bulk_group(&self, i: usize) -> Range<usize> {
        let start = self.group(i).start;
        start..start + self.parts.bulk[i] as usize
    }

    /// The unknowns of supervariable `i` that are no bulk.
    pub fn multiplier_group(&self, i: usize) -> Range<usize> {
        self.bulk_group(i).end..self.group(i).end
    }

    /// Returns whether an edge belongs to the bulk.
    pub fn is_bulk_edge(&self, edge: usize) -> bool {
        self.parts.bulk_edges[edge]
    }

    /// Connected parts of the bulk, members rising; supervariables without bulk unknowns are in none.
    pub fn bodies(&self) -> Vec<Vec<u32>> {
        let mut seen = vec![false; self.supervariables()];
        let mut parts = Vec::new();
        for first in 0..seen.len() {
            if seen[first] || self.bulk_group(first).is_empty() {
                continue;
            }
            seen[first] = true;
            let mut members = vec![first as u32];
            let mut next = 0;
            while let Some(&i) = members.get(next) {
                next += 1;
                for edge in self.edges(i as usize) {
                    let j = self.target(edge);
                    if self.is_bulk_edge(edge) && !seen[j] {
                        seen[j] = true;
                        members.push(j as u32);
                    }
                }
            }
            members.sort_unstable();
            parts.push(members);
        }
        parts
    }

    /// Numbers of the unknowns in the system of all ranks; `None` if nothing is known of any.
    pub fn numbering(&self) -> Option<&Numbering> {
        self.numbering.as_deref()
    }

    /// Points of all supervariables.
    pub fn points(&self) -> Option<&[[f64; 3]]> {
        self.parts.points.as_deref()
    }
}

impl Parts {
    /// The supervariables of cliques are kept.
    fn keep(&mut self, cliques: &Growth) {
        for s in cliques.cliques().iter().flatten() {
            self.kept[s.0] = true;
        }
    }
}
