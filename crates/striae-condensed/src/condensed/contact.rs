//! The contact system of the condensed solver, from the matrix to its factors.

use super::{
    Condensed, Numeric,
    untouched::{self, Touched, Untouched},
};
use crate::{
    interface::{self, Block, Compliant, Flexibility, Interface, Kind, Places, Purpose, Trial},
    report::{Factored, Method},
};
use rayon::prelude::*;
use striae_sparse::{Equilibration, Precision, SolveError, sparse_elimination::Row};

/// Rows that a thread scales at a time.
const ROWS: usize = 64;
/// Smallest pivots of a regular contact system, on an interior of either precision.
const SINGULAR: f64 = 1e-12;
const SINGULAR_SINGLE: f64 = 1e-5;
/// Smallest pivots of the scaled stiffness of a body that is not held by contact alone.
const UNSUPPORTED: f64 = 1e-8;
const UNSUPPORTED_SINGLE: f64 = 1e-4;

/// Factors of the contact system.
#[derive(Debug, Default)]
pub(super) struct ContactSystem {
    /// Unknowns whose rows have nothing but a diagonal.
    pub(super) known: Vec<bool>,
    /// Kept unknowns that contact has touched since others were eliminated.
    touched: Vec<bool>,
    /// The others, body by body.
    pub(super) untouched: Vec<Option<Untouched>>,
    /// Flexibilities of the bodies at what contact touches, if all bodies have one.
    flexibility: Option<Flexibility>,
    solver: Solver,
    /// Bulk unknowns that its multipliers leave free.
    pub(super) freedom: usize,
}

/// Solver of the contact system.
#[derive(Debug)]
enum Solver {
    /// With the flexibilities of the bodies.
    Compliant(Box<Compliant>),
    /// By elimination, where a body has no flexibility.
    Eliminated(Box<Interface>),
}

impl Default for Solver {
    fn default() -> Self {
        Self::Eliminated(Box::default())
    }
}

impl ContactSystem {
    /// Order of the dense matrix.
    pub(super) fn dense_order(&self) -> usize {
        match &self.solver {
            Solver::Compliant(compliant) => compliant.dense_order(),
            Solver::Eliminated(interface) => interface.dense_order(),
        }
    }

    fn entries(&self) -> usize {
        match &self.solver {
            Solver::Compliant(compliant) => compliant.entries(),
            Solver::Eliminated(interface) => interface.entries(),
        }
    }

    /// Solves for all kept unknowns.
    pub(super) fn solve(&self, blocks: &[Block<'_>], rhs: &[f64], purpose: Purpose) -> Vec<f64> {
        match (&self.solver, &self.flexibility) {
            (Solver::Compliant(compliant), Some(flexibility)) => {
                compliant.solve((blocks, flexibility), rhs, purpose)
            }
            (Solver::Compliant(_), None) => unreachable!("it was factored with flexibilities"),
            (Solver::Eliminated(interface), _) => interface.solve(blocks, rhs),
        }
    }
}

impl Condensed {
    /// Factors the contact system, with what there was in an older one; `rows` are the entries
    /// between kept unknowns.
    pub(super) fn factor_contact(
        &mut self,
        mut rows: Vec<Row>,
        scaling: Equilibration,
        (prescribed, precision): (Vec<bool>, Precision),
        older: ContactSystem,
    ) -> Result<Factored, SolveError> {
        let known = self.known(&rows, &prescribed);
        let mut kinds = self.kinds(&known);
        self.scale(&mut rows, &scaling, &known);
        let (smallest, unsupported) = match precision {
            Precision::Single => (SINGULAR_SINGLE, UNSUPPORTED_SINGLE),
            Precision::Double => (SINGULAR, UNSUPPORTED),
        };
        let trial = match &older.solver {
            Solver::Compliant(_) => Trial::Waived,
            Solver::Eliminated(_) => Trial::Due,
        };
        let (touched, untouched, kept) = self.untouched((&kinds, &rows), smallest, older);
        for own in untouched.iter().flatten() {
            own.set_apart(&mut kinds, &mut rows);
        }
        let freedom = interface::freedom(&kinds, &rows);
        let places = Places { kinds };
        let blocks = self.blocks(&untouched);
        let flexibility =
            kept.or_else(|| Flexibility::new(&blocks, (&places.kinds, &rows), unsupported));
        let solver = match &flexibility {
            Some(flexibility) => {
                Compliant::factor(&places, rows, (&blocks, flexibility), (smallest, trial))
                    .map(|compliant| Solver::Compliant(Box::new(compliant)))
            }
            None => Err(rows),
        };
        let solver = match solver {
            Ok(solver) => solver,
            Err(rows) => {
                let interface = Interface::factor(&places, rows, &blocks, smallest)?;
                Solver::Eliminated(Box::new(interface))
            }
        };
        let bodies = self.costs(precision).map(|a| a.factor_entries);
        let eliminated = untouched.iter().flatten().map(Untouched::entries);
        let others = bodies.chain(eliminated).sum::<usize>();
        let contact = ContactSystem {
            known,
            touched,
            untouched,
            flexibility,
            solver,
            freedom,
        };
        let report = Factored {
            factor_entries: contact.entries() + others,
            dense_order: contact.dense_order(),
            method: Method::Condensed,
            ..Factored::default()
        };
        self.numeric = Some(Numeric {
            scaling,
            prescribed,
            precision,
            contact,
        });
        Ok(report)
    }

    /// Unknowns that contact touches, and the elimination of the others: the existing one, unless
    /// contact touches more than it did then.
    fn untouched(
        &self,
        (kinds, rows): (&[Kind], &[Row]),
        smallest: f64,
        older: ContactSystem,
    ) -> (Vec<bool>, Vec<Option<Untouched>>, Option<Flexibility>) {
        let Touched { touched, is_more } = untouched::touched(kinds, rows, older.touched);
        if !is_more {
            return (touched, older.untouched, older.flexibility);
        }
        let blocks = self.complements();
        let blocks = blocks.iter();
        let eliminated = blocks.map(|block| Untouched::new(block, rows, &touched, smallest));
        let eliminated = eliminated.collect();
        (touched, eliminated, None)
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

    /// Remaining blocks, after the elimination of unknowns that contact does not touch.
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
        let mut kinds = vec![Kind::Multiplier; self.kept.unknowns.len()];
        for (block, places) in self.blocks.iter().enumerate() {
            for (row, &k) in places.iter().enumerate() {
                let (block, row) = (block as u32, row as u32);
                kinds[k as usize] = Kind::Bulk { block, row };
            }
        }
        for (kind, &unknown) in kinds.iter_mut().zip(&self.kept.unknowns) {
            if known[unknown as usize] {
                *kind = Kind::Apart;
            }
        }
        kinds
    }

    /// Prescribed unknowns, and kept multipliers whose rows have no entry but the diagonal.
    fn known(&self, rows: &[Row], prescribed: &[bool]) -> Vec<bool> {
        let mut known = prescribed.to_vec();
        let rows = (0..).zip(rows).zip(&self.kept.is_multiplier);
        for ((k, row), _) in rows.filter(|(_, is_multiplier)| **is_multiplier) {
            known[self.kept.unknowns[k as usize] as usize] = matches!(row[..], [(c, _)] if c == k);
        }
        known
    }

    /// Scales entries between kept unknowns and leaves out those with known ones.
    fn scale(&self, rows: &mut [Row], scaling: &Equilibration, known: &[bool]) {
        let unknowns = &self.kept.unknowns;
        let rows = rows.par_iter_mut().zip(unknowns).with_min_len(ROWS);
        rows.for_each(|(row, &unknown)| {
            if known[unknown as usize] {
                row.clear();
            }
            let factor = scaling.rows[unknown as usize];
            row.retain_mut(|(k, a)| {
                let column = unknowns[*k as usize] as usize;
                *a = *a * factor * scaling.columns[column];
                !known[column]
            });
        });
    }
}
