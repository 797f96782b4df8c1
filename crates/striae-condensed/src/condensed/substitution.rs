//! Substitution with the factors of the condensed solver.

use super::{Condensed, Numeric, contact::ContactSystem};
use crate::{interface::Purpose, tangent::Tangent};
use rayon::prelude::*;
use striae_sparse::{Equilibration, Factors, Supervariable};

/// Factors together with the matrix, whose columns of known unknowns are needed.
pub(super) struct Substitution<'a> {
    pub(super) condensed: &'a Condensed,
    pub(super) numeric: &'a Numeric,
    pub(super) tangent: &'a Tangent,
    pub(super) purpose: Purpose,
}

impl Factors for Substitution<'_> {
    fn solve_in_place(&self, x: &mut [f64]) {
        self.eliminate_known(x);
        let Condensed { bodies, kept, .. } = self.condensed;
        let kept = &kept.unknowns;
        let mut condensed: Vec<Vec<f64>> = bodies
            .par_iter()
            .map(|body| {
                let rhs: Vec<f64> = body.unknowns.iter().map(|&u| x[u as usize]).collect();
                let factored = "the bodies were factored with the interface";
                body.schur.condense(&rhs).expect(factored)
            })
            .collect();
        let mut rhs: Vec<f64> = kept.iter().map(|&u| x[u as usize]).collect();
        let solved: Vec<f64> = rhs.clone();
        for ((body, places), y) in bodies.iter().zip(&self.condensed.blocks).zip(&condensed) {
            for (&k, &u) in places.iter().zip(body.schur.kept_unknowns()) {
                rhs[k as usize] = y[u];
            }
        }
        let contact = &self.numeric.contact;
        let ContactSystem {
            known, untouched, ..
        } = contact;
        let eliminated = untouched.iter().flatten();
        eliminated.clone().for_each(|own| own.condense(&mut rhs));
        let mut z = contact.solve(&self.condensed.blocks(untouched), &rhs, self.purpose);
        for own in eliminated {
            let places = own.eliminated().iter();
            places.for_each(|&k| z[k as usize] = rhs[k as usize]);
            own.expand(&mut z);
        }
        for (k, &u) in kept.iter().enumerate() {
            if known[u as usize] {
                z[k] = solved[k];
            }
            x[u as usize] = z[k];
        }
        let blocks = bodies.iter().zip(&self.condensed.blocks);
        for ((body, places), y) in blocks.zip(&mut condensed) {
            for (&k, &u) in places.iter().zip(body.schur.kept_unknowns()) {
                y[u] = z[k as usize];
            }
        }
        let expanded: Vec<Vec<f64>> = bodies
            .par_iter()
            .zip(condensed)
            .map(|(body, y)| {
                body.schur
                    .expand(y)
                    .expect("a condensed vector of the body")
            })
            .collect();
        for (body, y) in bodies.iter().zip(expanded) {
            for (&u, value) in body.unknowns.iter().zip(y) {
                x[u as usize] = value;
            }
        }
    }
}

impl Substitution<'_> {
    /// Solves for the known unknowns and takes them to the right-hand side.
    fn eliminate_known(&self, x: &mut [f64]) {
        let bodies = &self.tangent.bodies;
        let structure = bodies.structure();
        let Equilibration { rows, columns } = &self.numeric.scaling;
        let known = &self.numeric.contact.known;
        let mut is_zero = true;
        for i in 0..structure.supervariables() {
            for (local, u) in structure.group(i).enumerate() {
                if !known[u] {
                    continue;
                }
                x[u] /= self.tangent.diagonal(u) * rows[u] * columns[u];
                if x[u] == 0.0 {
                    continue;
                }
                is_zero = false;
                for j in structure.neighbours(Supervariable(i)) {
                    let Some(edge) = structure.edge(j.0, i) else {
                        continue;
                    };
                    for (a, row) in structure.group(j.0).enumerate() {
                        let at = structure.row(j.0, a).start + structure.column(edge) + local;
                        if row != u {
                            x[row] -= bodies.values()[at] * rows[row] * columns[u] * x[u];
                        }
                    }
                }
            }
        }
        if !is_zero {
            self.take_known(known, x);
        }
    }

    /// Takes what contact has in the columns of known unknowns to the right-hand side.
    fn take_known(&self, known: &[bool], x: &mut [f64]) {
        let Equilibration { rows, columns } = &self.numeric.scaling;
        for &unknown in &self.condensed.kept.unknowns {
            let row = unknown as usize;
            for (column, a) in self.tangent.contact.row(row) {
                if known[column] && column != row {
                    x[row] -= a * rows[row] * columns[column] * x[column];
                }
            }
        }
    }
}
