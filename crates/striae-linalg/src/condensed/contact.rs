//! The contact system of the condensed solver, from the matrix to its factors.

use super::{
    Condensed, NONE, Numeric,
    untouched::{self, Untouched},
};
use crate::{
    equilibration::Equilibration,
    error::SolveError,
    interface::{Block, Interface, Kind, Places},
    matrix::SparseMatrix,
    real::Precision,
    solver::{FactorReport, Method},
    sparse_elimination::Row,
    structure::Supervariable,
};
use rayon::prelude::*;

/// Smallest pivots of a regular contact system, on an interior of either precision.
const SINGULAR: f64 = 1e-12;
const SINGULAR_SINGLE: f64 = 1e-5;

/// Factors of the contact system.
#[derive(Debug, Default)]
pub(super) struct ContactSystem {
    /// Unknowns whose rows have nothing but a diagonal.
    pub(super) known: Vec<bool>,
    /// Kept unknowns that contact has touched since others were eliminated.
    touched: Vec<bool>,
    /// The others, body by body.
    pub(super) untouched: Vec<Option<Untouched>>,
    pub(super) interface: Interface,
}

impl Condensed {
    /// Factors the contact system, with what there was in an older one.
    pub(super) fn factor_contact(
        &mut self,
        matrix: &SparseMatrix,
        scaling: Equilibration,
        (prescribed, precision): (Vec<bool>, Precision),
        older: ContactSystem,
    ) -> Result<FactorReport, SolveError> {
        let known = known(matrix, &prescribed);
        let mut kinds = self.kinds(&known);
        let mut rows = self.rows(matrix, &scaling, &known);
        let smallest = match precision {
            Precision::Single => SINGULAR_SINGLE,
            Precision::Double => SINGULAR,
        };
        let (touched, untouched) = self.untouched((&kinds, &rows), smallest, older);
        for own in untouched.iter().flatten() {
            own.set_apart(&mut kinds, &mut rows);
        }
        let places = Places { kinds };
        let interface = Interface::factor(&places, rows, &self.blocks(&untouched), smallest)?;
        let bodies = self.analyses(precision).map(|a| a.factor_entries);
        let eliminated = untouched.iter().flatten().map(Untouched::entries);
        let report = FactorReport {
            factor_entries: interface.entries() + bodies.chain(eliminated).sum::<usize>(),
            dense_order: interface.dense_order(),
            method: Method::Condensed,
            ..FactorReport::default()
        };
        self.numeric = Some(Numeric {
            scaling,
            prescribed,
            precision,
            contact: ContactSystem {
                known,
                touched,
                untouched,
                interface,
            },
        });
        Ok(report)
    }

    /// What contact touches, and the elimination of what it does not: the one there is,
    /// unless contact touches more than then.
    fn untouched(
        &self,
        (kinds, rows): (&[Kind], &[Row]),
        smallest: f64,
        older: ContactSystem,
    ) -> (Vec<bool>, Vec<Option<Untouched>>) {
        let mut touched = untouched::touched(kinds, rows);
        let before = older.touched;
        let is_more = |(&now, &before): (&bool, &bool)| now && !before;
        if !before.is_empty() && !touched.iter().zip(&before).any(is_more) {
            return (before, older.untouched);
        }
        let sum = touched.iter_mut().zip(&before);
        sum.for_each(|(now, before)| *now |= before);
        let blocks = self.complements();
        let blocks = blocks.iter();
        let eliminated = blocks.map(|block| Untouched::new(block, rows, &touched, smallest));
        let eliminated = eliminated.collect();
        (touched, eliminated)
    }

    /// Schur complements of all bodies.
    fn complements(&self) -> Vec<Block<'_>> {
        let blocks = self.blocks.iter().zip(&self.bodies);
        blocks
            .map(|(places, body)| Block {
                places,
                values: body.schur.complement_values(),
            })
            .collect()
    }

    /// What is left of them.
    pub(super) fn blocks<'a>(&'a self, untouched: &'a [Option<Untouched>]) -> Vec<Block<'a>> {
        let left = |(whole, own): (Block<'a>, &'a Option<Untouched>)| match own {
            Some(own) => own.block(),
            None => whole,
        };
        self.complements()
            .into_iter()
            .zip(untouched)
            .map(left)
            .collect()
    }

    /// Kinds of the kept unknowns.
    fn kinds(&self, known: &[bool]) -> Vec<Kind> {
        let mut kinds = vec![Kind::Multiplier; self.kept.len()];
        for (block, places) in self.blocks.iter().enumerate() {
            for (row, &k) in places.iter().enumerate() {
                let (block, row) = (block as u32, row as u32);
                kinds[k as usize] = Kind::Bulk { block, row };
            }
        }
        for (kind, &unknown) in kinds.iter_mut().zip(&self.kept) {
            if known[unknown as usize] {
                *kind = Kind::Apart;
            }
        }
        kinds
    }

    /// Scaled entries between the kept unknowns, but for known ones.
    fn rows(&self, matrix: &SparseMatrix, scaling: &Equilibration, known: &[bool]) -> Vec<Row> {
        let row = |&u: &u32| {
            let u = u as usize;
            if known[u] {
                return Row::new();
            }
            matrix
                .row(u)
                .filter(|&(v, a)| a != 0.0 && self.place[v] != NONE && !known[v])
                .map(|(v, a)| (self.place[v], a * scaling.rows[u] * scaling.columns[v]))
                .collect()
        };
        self.kept.par_iter().map(row).collect()
    }
}

/// Prescribed unknowns, and kept multipliers whose rows have no entry but the diagonal.
fn known(matrix: &SparseMatrix, prescribed: &[bool]) -> Vec<bool> {
    let structure = matrix.structure();
    let mut known = prescribed.to_vec();
    for i in structure.kept().map(|Supervariable(i)| i) {
        for u in structure.bulk_group(i).end..structure.group(i).end {
            known[u] = matrix.row(u).all(|(v, a)| (u == v) == (a != 0.0));
        }
    }
    known
}
