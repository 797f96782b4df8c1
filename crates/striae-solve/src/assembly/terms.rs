//! Contact terms in the system.

use striae_contact::{configuration::Configuration, term::LocalTerm, unknown::Unknown};
use striae_linalg::{OutsidePattern, Supervariable};

use super::{System, ties::Slot};

/// Where a triple of unknowns of a pair is in the system.
#[derive(Clone, Copy, Debug)]
pub(super) struct Triple {
    /// The first of its unknowns.
    first: usize,
    owner: Supervariable,
    /// The node whose position it is.
    position: Option<usize>,
}

impl System<'_> {
    /// Looks up where the unknowns of a pair are.
    pub(super) fn find_triples(
        &mut self,
        pair: usize,
        configuration: &Configuration,
        patches: usize,
    ) {
        let problem = self.context.problem;
        let numbering = configuration.pair.numbering();
        let triple = |at: u32| {
            let unknown = numbering.unknown(3 * at);
            let (first, owner) = self.layout.global(problem, pair, unknown)?;
            let position = match unknown {
                Unknown::Position { side, node, .. } => problem.surface_node(pair, side, node),
                Unknown::Traction { .. } | Unknown::Balance { .. } => None,
            };
            Some(Triple {
                first,
                owner,
                position,
            })
        };
        let count = numbering.balance(patches) / 3;
        let triples = (0..count).map(triple).collect();
        self.triples.resize(pair, Vec::new());
        self.triples.push(triples);
    }

    fn triple(&self, pair: usize, unknown: u32) -> &Triple {
        let triple = &self.triples[pair][unknown as usize / 3];
        triple.as_ref().expect("terms refer to active unknowns")
    }

    /// Adds a contact term; remembers its clique where it has no place.
    pub(super) fn add_term(&mut self, pair: usize, term: &LocalTerm) {
        let slot = |unknown: &u32| {
            let (triple, axis) = (self.triple(pair, *unknown), *unknown as usize % 3);
            Slot {
                unknown: triple.first + axis,
                position: triple.position.map(|node| (node, axis)),
            }
        };
        let rows: Vec<Slot> = term.rows.iter().map(slot).collect();
        let columns: Vec<Slot> = term.columns.iter().map(slot).collect();
        for (row, residual) in rows.iter().zip(&term.residual) {
            self.residual[row.unknown] += residual;
        }
        if !self.is_known(pair, term) || self.add_rows(&rows, &columns, &term.tangent).is_err() {
            let unknowns = term.rows.iter().chain(&term.columns);
            let mut clique: Vec<_> = unknowns.map(|u| self.triple(pair, *u).owner).collect();
            clique.sort_unstable();
            clique.dedup();
            self.outside.push(clique);
        }
    }

    /// Whether the supervariables of a term are among those that are kept.
    fn is_known(&self, pair: usize, term: &LocalTerm) -> bool {
        let structure = self.matrix.structure();
        let mut unknowns = term.rows.iter().chain(term.columns.iter().step_by(3));
        unknowns.all(|unknown| structure.is_kept(self.triple(pair, *unknown).owner))
    }

    /// Adds rows of a block, leaving out prescribed ones.
    pub(super) fn add_rows(
        &mut self,
        rows: &[Slot],
        columns: &[Slot],
        block: &[f64],
    ) -> Result<(), OutsidePattern> {
        if !rows.iter().any(|row| self.is_fixed(row)) {
            return self.scatter(rows, columns, block);
        }
        let kept: Vec<usize> = (0..rows.len())
            .filter(|&at| !self.is_fixed(&rows[at]))
            .collect();
        let rows: Vec<Slot> = kept.iter().map(|&at| rows[at]).collect();
        let block: Vec<f64> = kept
            .iter()
            .flat_map(|at| &block[at * columns.len()..(at + 1) * columns.len()])
            .copied()
            .collect();
        self.scatter(&rows, columns, &block)
    }

    fn is_fixed(&self, slot: &Slot) -> bool {
        slot.position
            .is_some_and(|(node, axis)| self.context.fixed[3 * node + axis])
    }
}
