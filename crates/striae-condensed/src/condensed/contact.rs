//! The contact system of the condensed solver, from the matrix to its factors.

use super::{
    Condensed, Numeric,
    untouched::{self, Touched, Untouched},
};
use crate::{
    interface::{self, Block, Compliant, Flexibility, Interface, Kind, Places, Purpose, Trial},
    partition::Partition,
    report::{Factored, Method},
};
use rayon::prelude::*;
use striae_sparse::{
    Equilibration, Precision, SolveError, SparseMatrix, Supervariable, sparse_elimination::Row,
};

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

/// How the contact system is solved.
#[derive(Debug)]
enum Solver {
    /// With the flexibilities of the bodies.
    Compliant(Compliant),
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
    /// Factors the contact system, with what there was in an older one.
    pub(super) fn factor_contact(
        &mut self,
        matrix: &SparseMatrix,
        scaling: Equilibration,
        (prescribed, precision): (Vec<bool>, Precision),
        older: ContactSystem,
    ) -> Result<Factored, SolveError> {
        let known = known(&self.partition, matrix, &prescribed);
        let mut kinds = self.kinds(&known);
        let mut rows = self.rows(matrix, &scaling, &known);
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
                    .map(Solver::Compliant)
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

    /// What contact touches, and the elimination of what it does not: the one there is,
    /// unless contact touches more than then.
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
        let structure = &self.partition;
        let row = |&u: &u32| {
            let u = u as usize;
            if known[u] {
                return Row::new();
            }
            let owner = structure.owner(u).0;
            let values = &matrix.values()[structure.row(owner, u - structure.group(owner).start)];
            let factor = scaling.rows[u];
            let mut row = Row::with_capacity(values.len());
            for edge in structure.edges(owner) {
                let target = structure.target(edge);
                if !structure.is_kept(Supervariable(target)) {
                    continue;
                }
                let values = &values[structure.column(edge)..];
                for (v, &a) in structure.group(target).zip(values) {
                    if a != 0.0 && !known[v] {
                        row.push((self.place[v], a * factor * scaling.columns[v]));
                    }
                }
            }
            row
        };
        self.kept.par_iter().map(row).collect()
    }
}

/// Prescribed unknowns, and kept multipliers whose rows have no entry but the diagonal.
fn known(partition: &Partition, matrix: &SparseMatrix, prescribed: &[bool]) -> Vec<bool> {
    let mut known = prescribed.to_vec();
    for i in partition.kept().map(|Supervariable(i)| i) {
        for u in partition.multiplier_group(i) {
            known[u] = matrix.row(u).all(|(v, a)| (u == v) == (a != 0.0));
        }
    }
    known
}
