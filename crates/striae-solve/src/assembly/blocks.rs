//! All terms of a pair in the system.
//!
//! If nothing is tied, no node has axes of its own and no moving body reacts to contact, a term is a
//! dense block whose rows and columns are unknowns of the system. All other terms are made into
//! blocks one by one, with ties eliminated. The contribution of contact to the tangent is the sum of all blocks.

use rayon::prelude::*;
use striae_condensed::{Growth, Partition};
use striae_contact::{evaluation::Evaluation, segment::Derivatives, side::Side, term::LocalTerm};
use striae_sparse::{CompressedRows, PlacedBlock};
use striae_surface::node::SurfaceNode;

use super::{Setting, System, terms::Answer};
use crate::{layout::united, share::shared_out};
use striae_model::node::GlobalNode;

/// Terms for one thread at a time.
const TERMS: usize = 16;

impl System<'_> {
    /// Adds the terms of a pair; those that already are blocks to the residual only.
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
    }

    /// Puts contact into its part of the tangent; returns by what its pattern had to grow.
    /// Collective.
    pub(super) fn gather(
        &mut self,
        contacts: &[Evaluation],
        partition: &mut Partition,
        target: &mut CompressedRows,
    ) -> Growth {
        let blocks = self.all_blocks(contacts);
        let (rows, growth) = match partition.gathered(&blocks) {
            Ok(rows) => (rows, Growth::default()),
            Err(growth) => (CompressedRows::default(), growth),
        };
        let growth = united(self.context.problem, self.layout, growth);
        if growth.is_empty() {
            *target = rows;
            return growth;
        }
        let own = "contact couples supervariables of the partition";
        *partition = partition.grown(&growth).expect(own);
        *target = partition.gathered(&blocks).expect(own);
        growth
    }

    /// Couplings of contact.
    pub(super) fn all_blocks<'t>(&mut self, contacts: &'t [Evaluation]) -> Vec<PlacedBlock<'t>> {
        let mut blocks: Vec<PlacedBlock> = std::mem::take(&mut self.blocks);
        for (pair, evaluation) in contacts.iter().enumerate() {
            if self.is_plain(pair) {
                let terms = evaluation.terms.par_iter().with_min_len(TERMS);
                blocks.par_extend(terms.map(|term| self.placed(pair, term)));
            }
        }
        blocks
    }

    /// Returns whether the unknowns of a pair's terms are unknowns of the system.
    fn is_plain(&self, pair: usize) -> bool {
        let rigid = self.context.problem.pairs[pair].rigid;
        let moves = rigid.is_some_and(|rigid| self.moving[rigid].is_some());
        let is_bound = || self.triples[pair].iter().flatten().any(|t| t.is_bound);
        self.ties.is_empty() && !moves && self.opposite_body(pair).is_none() && !is_bound()
    }

    /// Finds which rows of contact this rank adds to the tangent: where unknowns are those of the
    /// system as they are, those of [its nodes](shared_out), of all other pairs those that it owns.
    pub(super) fn share_out_contact(&mut self, setting: &Setting) {
        let (problem, pairs) = (self.context.problem, setting.selections.len());
        self.added = vec![None; pairs];
        if problem.share.is_alone() || self.derivatives == Derivatives::None {
            return;
        }
        let (mut nodes, mut places) = (Vec::new(), Vec::new());
        for (pair, selection) in setting.selections.iter().enumerate() {
            if !self.is_plain(pair) {
                continue;
            }
            let owned = |side: Side| {
                let all = SurfaceNode::all(selection.nodes(side));
                let nodes = all.map(|node| problem.surface_node(pair, side, node));
                let is_owned = |node: GlobalNode| problem.share.owns(node);
                nodes.map(|node| node.is_none_or(is_owned)).collect()
            };
            self.added[pair] = Some(Side::BOTH.map(owned));
            for side in Side::BOTH {
                let all = SurfaceNode::all(selection.nodes(side));
                let bears = |node: &SurfaceNode| {
                    selection.carries(side, *node) || selection.is_kept(side, *node)
                };
                for node in all.filter(bears) {
                    if let Some(global) = problem.surface_node(pair, side, node) {
                        nodes.push((pair, side, node));
                        places.push(setting.state.positions[global]);
                    }
                }
            }
        }
        let team = problem.share.team();
        let ranks = shared_out(&places, team.size());
        for ((pair, side, node), rank) in nodes.into_iter().zip(ranks) {
            if let Some(added) = &mut self.added[pair] {
                added[side][node.index()] = rank as usize == team.rank();
            }
        }
    }

    /// Returns whether this rank adds a row of contact to the tangent.
    fn adds(&self, pair: usize, row: u32) -> bool {
        match self.added.get(pair) {
            Some(Some(added)) => {
                let (side, node) = self.triple(pair, row).place;
                added[side][node.index()]
            }
            _ => self.owns(self.unknown(pair, row)),
        }
    }

    /// Places of a term, without prescribed rows and those that other ranks add.
    fn placed<'t>(&self, pair: usize, term: &'t LocalTerm) -> PlacedBlock<'t> {
        let is_free = |&(_, row): &(usize, &u32)| {
            let axis = *row as usize % 3;
            let node = self.triple(pair, *row).position;
            node.is_none_or(|node| !self.context.fixed[node.component(axis)])
        };
        let rows = term.rows.iter().enumerate();
        let rows = rows
            .filter(|(_, row)| self.adds(pair, **row))
            .filter(is_free);
        let columns = term.columns.iter().step_by(3);
        PlacedBlock {
            rows: rows
                .map(|(at, row)| (self.unknown(pair, *row), at))
                .collect(),
            columns: columns
                .map(|column| self.unknown(pair, *column))
                .map(|first| first..first + 3)
                .collect(),
            values: term.tangent.as_slice().into(),
        }
    }

    fn unknown(&self, pair: usize, of_pair: u32) -> usize {
        self.triple(pair, of_pair).first + of_pair as usize % 3
    }
}
