//! Nodal forces of the traction field that both sides share.
//!
//! On a segment with the normal `n`
//!
//! ```text
//! t = -P n + sum_k psi_k R(n, s_k n_k) tau_k,   P = sum_k phi_k max(0, p_k - r_k g)
//! f_c = +-integral N_c t da = +-(-F_c n + sum_k alpha_ck R(n, s_k n_k) tau_k)
//! alpha_ck = sum_d D_cd slip_kd
//! ```
//!
//! at the corners of the first facet with `+`, of the second one with `-`, and with the integrals
//! `F_c` of [`Pressed`](crate::segment::Pressed). Friction acts on the surface of its own node;
//! `psi_k` has the sign with which the first facet sees it, `s_k`, where `phi_k` is positive. Both
//! facets see the same integrals, so the sum of all forces is zero to round-off.

use nalgebra::Matrix3;
use rayon::prelude::*;
use striae_mesh::{FacetId, Vec3};

use crate::{
    configuration::Configuration,
    field::FacetForces,
    frame::Frames,
    pairing::SIGNS,
    patch::{OnSegment, Patch},
    places::{ChainedSum, Places},
    segment::Slopes,
    segment_rows::AtCorners,
    selection::Selection,
    term::{Field, Jacobian, LocalTerm, Row},
    traction::NodalTractions,
    transported::Transported,
};

/// Quantities that the common field depends on.
#[derive(Clone, Copy)]
pub struct CommonField<'a> {
    /// Configuration of the pair.
    pub configuration: &'a Configuration<'a>,
    /// Roles.
    pub selection: &'a Selection,
    /// Nodal frames.
    pub frames: &'a Frames,
    /// Friction tractions of the kept nodes.
    pub tau: &'a NodalTractions,
}

/// Momentum rows of every segment, its two facets and the forces on them. Patches go one by one,
/// as the derivatives of all of them and of all terms would take the most room of an assembly.
pub fn segment_terms(
    field: CommonField,
    patches: Vec<Patch>,
) -> Vec<(LocalTerm, [Option<FacetId>; 2], [FacetForces; 2])> {
    patches
        .into_par_iter()
        .with_min_len(4)
        .map(|patch| {
            let (term, forces) = field.term(&patch);
            (term, patch.paired.facets, forces)
        })
        .collect()
}

/// The friction of a kept node on a segment.
#[derive(Default)]
struct Traction {
    value: Vec3,
    /// Derivative by the segment's normal.
    by_n: Matrix3<f64>,
    jacobian: Jacobian,
    friction: f64,
}

impl CommonField<'_> {
    fn term(&self, patch: &Patch) -> (LocalTerm, [FacetForces; 2]) {
        let tractions: Vec<Traction> = patch
            .kept
            .iter()
            .map(|kept| self.traction(patch, kept))
            .collect();
        // `q_d = sum_k slip_kd t_k`, so that `f_c = sum_d D_cd q_d`.
        let mut q = [Vec3::zeros(); 8];
        for (kept, traction) in patch.kept.iter().zip(&tractions) {
            for d in 0..8 {
                q[d] += traction.value * kept.slips[d];
            }
        }
        let mass = &patch.paired.segment.mass;
        let n = patch.paired.segment.normal;
        let forces: [Vec3; 8] = std::array::from_fn(|c| {
            let sum: Vec3 = (0..8).map(|d| q[d] * mass[c][d]).sum();
            (sum - n * patch.pressed.force[c]) * -SIGNS[c]
        });
        let term = self.momentum(patch, &q, &tractions, &forces);
        let of_facets = [0, 1].map(|facet| {
            let mut of_facet = FacetForces::default();
            for at in 0..4 {
                let corner = 4 * facet + at;
                of_facet.force[at] = forces[corner];
                of_facet.area[at] = patch.paired.area_of(corner);
            }
            for (kept, traction) in patch.kept.iter().zip(&tractions) {
                let area = |d: usize| kept.shares[d] * patch.paired.area_of(d);
                let area: f64 = (0..8).map(area).sum();
                of_facet.friction += area * traction.friction;
            }
            of_facet.pressed = patch.pressed.area;
            let own = &patch.pressed.force[4 * facet..][..4];
            of_facet.pressure = own.iter().sum();
            of_facet
        });
        (term, of_facets)
    }

    fn traction(&self, patch: &Patch, kept: &OnSegment) -> Traction {
        let (side, node) = self.selection.kept()[kept.k as usize].place();
        let n = patch.paired.segment.normal;
        let mut traction = Traction::default();
        let tau = &self.tau[side][node];
        if let Some(frame) = &self.frames[side][node]
            && !tau.jacobian.is_empty()
        {
            let turned = Transported::new(&tau.value, &(frame.n.value * kept.sign), &n);
            traction.value = turned.value;
            traction.friction = tau.value.norm();
            if patch.paired.segment.slopes.is_none() {
                return traction;
            }
            traction.by_n = turned.by_n;
            let most = tau.jacobian.len() + frame.n.jacobian.len();
            traction.jacobian.reserve(most);
            let mut sum = ChainedSum::onto(&mut traction.jacobian);
            sum.add(&turned.by_vector, &tau.jacobian);
            sum.add(&(turned.by_from * kept.sign), &frame.n.jacobian);
        }
        traction
    }

    fn momentum(
        &self,
        patch: &Patch,
        q: &[Vec3; 8],
        tractions: &[Traction],
        forces: &[Vec3; 8],
    ) -> LocalTerm {
        let (paired, segment) = (&patch.paired, &patch.paired.segment);
        let numbering = self.configuration.pair.numbering();
        let owners: [Option<u32>; 8] = std::array::from_fn(|corner| {
            let node = paired.node(self.configuration, corner);
            node.map(|(side, node)| numbering.position(side, node))
        });
        let corners: Vec<usize> = (0..8).filter(|&c| owners[c].is_some()).collect();
        let rows: Vec<Row> = corners
            .iter()
            .flat_map(|&c| {
                let first = owners[c].unwrap_or_default();
                (0..3).map(move |axis| (first + axis as u32, Field::Momentum, -forces[c][axis]))
            })
            .collect();
        let mut block = Columns::new();
        let Some(slopes) = &segment.slopes else {
            return block.term(&rows, &corners);
        };
        for first in owners.iter().flatten() {
            block.of(*first);
        }
        // `alpha_ck` with the sign of the rows, which state `-f`.
        let share = |c: usize, shares: &[f64; 8]| -> f64 {
            let sum: f64 = (0..8).map(|d| segment.mass[c][d] * shares[d]).sum();
            SIGNS[c] * sum
        };
        let mut by_n = [Matrix3::zeros(); 8];
        for (kept, traction) in patch.kept.iter().zip(tractions) {
            let alphas: [f64; 8] = std::array::from_fn(|c| share(c, &kept.slips));
            for (by_n, alpha) in by_n.iter_mut().zip(alphas) {
                *by_n += traction.by_n * alpha;
            }
            for (first, inner) in &traction.jacobian {
                block.add_multiples(*first, &alphas, inner);
            }
        }
        self.add_by_pressures(patch, &mut block);
        let sticks = |traction: &Traction| !traction.jacobian.is_empty();
        let has_friction = tractions.iter().any(sticks);
        let components = [0, 1, 2].map(|axis| AtCorners(q.map(|q| q[axis])));
        for &c in &corners {
            let by_mass = has_friction.then(|| components.each_ref().map(|q| q.of_mass(slopes, c)));
            for (e, first) in owners.iter().enumerate() {
                let Some(first) = first else { continue };
                let mut by = self.by_position(patch, slopes, [c, e]);
                if let Some(by_mass) = &by_mass {
                    by += Matrix3::from_fn(|row, axis| SIGNS[c] * by_mass[row][e][axis]);
                    by += by_n[c] * slopes.normal[e];
                }
                block.add(*first, c, &by);
            }
        }
        block.term(&rows, &corners)
    }
}

impl CommonField<'_> {
    /// Derivative of the pressure's part of the rows of corner `c`, `-s_c F_c n`, by corner `e`.
    fn by_position(&self, patch: &Patch, slopes: &Slopes, [c, e]: [usize; 2]) -> Matrix3<f64> {
        let Some(pressed) = &patch.pressed.slopes else {
            return Matrix3::zeros();
        };
        let n = patch.paired.segment.normal;
        let by_x = Vec3::from_column_slice(&pressed.force[c][3 * e..3 * e + 3]);
        (n * by_x.transpose() + slopes.normal[e] * patch.pressed.force[c]) * -SIGNS[c]
    }

    /// Adds the derivatives of these rows by the pressures.
    fn add_by_pressures(&self, patch: &Patch, block: &mut Columns) {
        let Some(pressed) = &patch.pressed.slopes else {
            return;
        };
        let mut by_unknowns = Matrix3::zeros();
        by_unknowns.set_column(0, &patch.paired.segment.normal);
        for (kept, by_pressure) in patch.kept.iter().zip(&pressed.force_by_pressure) {
            let (side, node) = self.selection.kept()[kept.k as usize].place();
            let first = self.configuration.pair.numbering().traction(side, node);
            let factors = std::array::from_fn(|c| -SIGNS[c] * by_pressure[c]);
            block.add_multiples(first, &factors, &by_unknowns);
        }
    }
}

/// Derivatives of the forces on the eight corners by triples of unknowns.
struct Columns {
    places: Places,
    triples: Vec<u32>,
    /// By triple: entries of a matrix, column by column, of all corners.
    blocks: Vec<[[f64; 8]; 9]>,
}

impl Columns {
    fn new() -> Self {
        Self {
            places: Places::none(),
            triples: Vec::with_capacity(64),
            blocks: Vec::with_capacity(64),
        }
    }

    fn of(&mut self, first: u32) -> &mut [[f64; 8]; 9] {
        let next = self.triples.len();
        let at = self.places.find(first, next);
        if at == next {
            self.triples.push(first);
            self.blocks.push([[0.0; 8]; 9]);
        }
        &mut self.blocks[at]
    }

    /// Adds to the rows of a corner.
    fn add(&mut self, first: u32, corner: usize, inner: &Matrix3<f64>) {
        for (sums, entry) in self.of(first).iter_mut().zip(inner) {
            sums[corner] += entry;
        }
    }

    /// Adds multiples of a matrix to the rows of all corners.
    fn add_multiples(&mut self, first: u32, factors: &[f64; 8], inner: &Matrix3<f64>) {
        for (sums, entry) in self.of(first).iter_mut().zip(inner) {
            for corner in 0..8 {
                sums[corner] += factors[corner] * entry;
            }
        }
    }

    /// The rows of some corners.
    fn term(&self, rows: &[Row], corners: &[usize]) -> LocalTerm {
        let mut order: Vec<usize> = (0..self.triples.len()).collect();
        order.sort_unstable_by_key(|&at| self.triples[at]);
        let lines = 3 * corners.len();
        let mut tangent = Vec::with_capacity(3 * order.len() * lines);
        for line in 0..lines {
            let (corner, row) = (corners[line / 3], line % 3);
            for &at in &order {
                let block = &self.blocks[at];
                tangent.extend_from_slice(&[0, 1, 2].map(|axis| block[3 * axis + row][corner]));
            }
        }
        let mut columns = Vec::with_capacity(3 * order.len());
        for &at in &order {
            columns.extend(self.triples[at]..self.triples[at] + 3);
        }
        LocalTerm {
            rows: rows.iter().map(|row| row.0).collect(),
            fields: rows.iter().map(|row| row.1).collect(),
            residual: rows.iter().map(|row| row.2).collect(),
            columns,
            tangent,
        }
    }
}

/// Sums the forces on facets that are paired more than once, in the order of the facets.
pub fn by_facet(
    facets: impl Iterator<Item = (FacetId, FacetForces)>,
) -> Vec<(FacetId, FacetForces)> {
    let mut all: Vec<(FacetId, FacetForces)> = facets.collect();
    all.sort_by_key(|entry| entry.0);
    let mut sums: Vec<(FacetId, FacetForces)> = Vec::new();
    for (facet, forces) in all {
        match sums.last_mut() {
            Some((last, sum)) if *last == facet => sum.add(&forces),
            _ => sums.push((facet, forces)),
        }
    }
    sums
}
