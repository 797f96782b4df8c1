//! Residual, tangent and results of contact in an iteration.

use std::sync::Arc;

use striae_mesh::Vec3;

use super::{contact::Contact, numbers::Numbers, triplets::Triplets};
use crate::{
    evaluation::Evaluation,
    side::Side,
    term::{Field, LocalTerm},
    unknowns::{NodeResult, Tractions},
};

/// Contact at given positions and tractions.
#[derive(Clone, Debug)]
pub struct Evaluated {
    /// Residual of all rows: minus the contact forces, then the rows of the kept nodes.
    pub residual: Vec<f64>,
    /// Rows of the entries of the tangent, ascending; each place has one entry.
    pub rows: Vec<usize>,
    /// Columns of the entries, ascending in each row.
    pub columns: Vec<usize>,
    /// Values of the entries.
    pub values: Vec<f64>,
    /// Largest residual of a row of a kept node over its scale: the facet size for gaps and slips,
    /// the largest pressure for tractions.
    pub norm: f64,
    /// Number of the evaluation in its increment, from 0.
    pub number: usize,
    pub(super) contact: Contact,
    /// Identity of the increment.
    pub(super) made_by: Arc<()>,
    pub(super) x: Vec<Vec3>,
    pub(super) tractions: Vec<Tractions>,
    /// Of every pair, without terms.
    pub(super) pairs: Vec<Evaluation>,
}

impl Evaluated {
    pub(super) fn new(
        contact: Contact,
        (made_by, number): (&Arc<()>, usize),
        numbers: &Numbers,
        x: Vec<Vec3>,
        tractions: Vec<Tractions>,
    ) -> Self {
        Self {
            residual: vec![0.0; numbers.all()],
            rows: Vec::new(),
            columns: Vec::new(),
            values: Vec::new(),
            norm: 0.0,
            number,
            contact,
            made_by: Arc::clone(made_by),
            x,
            tractions,
            pairs: Vec::new(),
        }
    }

    /// Takes up what the pairs contribute.
    pub(super) fn with(mut self, numbers: &Numbers, mut pairs: Vec<Evaluation>) -> Self {
        let terms: Vec<Vec<LocalTerm>> = pairs
            .iter_mut()
            .map(|evaluation| std::mem::take(&mut evaluation.terms))
            .collect();
        for (pair, terms) in terms.iter().enumerate() {
            let of_pair = &self.contact.members()[pair].pair;
            let stress = of_pair.stress_scale(&pairs[pair].nodes);
            for term in terms {
                self.add_residual(term, stress, |unknown| numbers.number(pair, unknown));
            }
        }
        let Triplets {
            rows,
            columns,
            values,
        } = Triplets::of(&terms, numbers);
        Self {
            rows,
            columns,
            values,
            pairs,
            ..self
        }
    }

    fn add_residual(&mut self, term: &LocalTerm, stress: f64, number: impl Fn(u32) -> usize) {
        let rows = term.rows.iter().zip(&term.fields).zip(&term.residual);
        for ((&row, field), residual) in rows {
            self.residual[number(row)] += residual;
            let scale = match field {
                Field::Momentum => continue,
                Field::Gap(size) | Field::Stick(size) => *size,
                Field::Traction => stress,
            };
            let part = residual.abs() / scale;
            // A part that is not a number must not be lost in the comparison.
            self.norm = if part > self.norm || part.is_nan() {
                part
            } else {
                self.norm
            };
        }
    }

    /// The surfaces.
    pub fn contact(&self) -> &Contact {
        &self.contact
    }

    /// Positions at which contact was evaluated.
    pub fn positions(&self) -> &[Vec3] {
        &self.x
    }

    /// Contact force on a node of the mesh.
    pub fn force(&self, node: usize) -> Vec3 {
        -Vec3::from_column_slice(&self.residual[3 * node..3 * node + 3])
    }

    /// Results at the nodes of a side of a pair, in the order of [`Contact::nodes`].
    pub fn nodes(&self, pair: usize, side: Side) -> &[NodeResult] {
        &self.pairs[pair].nodes[side]
    }

    /// Contact force on a side of a pair, and its moment about the origin.
    pub fn resultant(&self, pair: usize, side: Side) -> [Vec3; 2] {
        let of_pair = &self.contact.members()[pair].pair;
        let own = match of_pair.is_deformable(side) {
            true => side,
            false => side.opposite(),
        };
        let mut sums = [Vec3::zeros(); 2];
        let nodes = self.contact.nodes(pair, own);
        let surface = self.contact.surface(pair, own);
        for (facet, forces) in &self.pairs[pair].facets[own] {
            let corners = surface.map(|surface| surface.facets()[facet.index()]);
            for (corner, force) in corners.iter().flatten().zip(&forces.force) {
                sums[0] += force;
                sums[1] += self.x[nodes[corner.index()].index()].cross(force);
            }
        }
        match own == side {
            true => sums,
            // A rigid side bears the opposite of what the other one does.
            false => sums.map(|sum| -sum),
        }
    }

    /// Work that friction dissipates in the increment, of a pair.
    pub fn dissipated(&self, pair: usize) -> f64 {
        self.pairs[pair].dissipated
    }
}
