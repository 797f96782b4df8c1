//! All terms of a pair in the system.
//!
//! Where nothing is tied and no body that moves answers contact, a term is a dense block
//! whose rows and columns are unknowns as they are, and blocks are added on all threads.
//! All other terms are added one by one.

use rayon::prelude::*;
use striae_contact::{segment::Derivatives, term::LocalTerm};
use striae_sparse::PlacedBlock;

use super::{System, terms::Answer};

/// Terms for one thread at a time.
const TERMS: usize = 16;

impl System<'_> {
    /// Adds the terms of a pair; remembers the cliques of those that have no place.
    pub(super) fn add_terms(&mut self, pair: usize, terms: &[LocalTerm]) {
        if !self.is_plain(pair) {
            for term in terms {
                self.add_term(pair, term, Answer::Opposite);
            }
            return;
        }
        for term in terms {
            for (row, residual) in term.rows.iter().zip(&term.residual) {
                let unknown = self.unknown(pair, *row);
                self.residual[unknown] += residual;
            }
        }
        if self.derivatives == Derivatives::None {
            return;
        }
        let (known, unknown): (Vec<&LocalTerm>, Vec<_>) =
            terms.iter().partition(|term| self.is_known(pair, term));
        let blocks = known.par_iter().with_min_len(TERMS);
        let blocks: Vec<PlacedBlock> = blocks.map(|term| self.placed(pair, term)).collect();
        let added = self.matrix.add_all(&blocks);
        let outside = added.err().unwrap_or_default();
        let outside = outside.iter().map(|&at| known[at]).chain(unknown);
        let cliques: Vec<_> = outside.map(|term| self.clique_of(pair, term)).collect();
        self.growth.extend(cliques);
    }

    /// Whether the unknowns of a pair's terms are unknowns of the system as they are.
    fn is_plain(&self, pair: usize) -> bool {
        let rigid = self.context.problem.pairs[pair].rigid;
        let moves = rigid.is_some_and(|rigid| self.moving[rigid].is_some());
        let follows = || self.triples[pair].iter().flatten().any(|t| t.follows);
        self.ties.is_empty() && !moves && self.opposite_body(pair).is_none() && !follows()
    }

    /// Where a term belongs, leaving out prescribed rows.
    fn placed<'t>(&self, pair: usize, term: &'t LocalTerm) -> PlacedBlock<'t> {
        let is_free = |&(_, row): &(usize, &u32)| {
            let axis = *row as usize % 3;
            let node = self.triple(pair, *row).position;
            node.is_none_or(|node| !self.context.fixed[node.component(axis)])
        };
        let rows = term.rows.iter().enumerate().filter(is_free);
        let columns = term.columns.iter().step_by(3);
        PlacedBlock {
            rows: rows
                .map(|(at, row)| (self.unknown(pair, *row), at))
                .collect(),
            triples: columns.map(|column| self.unknown(pair, *column)).collect(),
            values: &term.tangent,
        }
    }

    fn unknown(&self, pair: usize, of_pair: u32) -> usize {
        self.triple(pair, of_pair).first + of_pair as usize % 3
    }
}
