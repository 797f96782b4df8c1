//! Nodal forces of the traction field on one facet.
//!
//! Each side integrates its own smooth field, Jones & Papadopoulos (2006),
//! eqs. (40) and (55):
//!
//! ```text
//! f_J = integral N_J t da,   t = -p_h n + tau_h,
//! p_h = sum N_I p_I,         tau_h = sum N_I R(n, n_I) tau_I
//! ```
//!
//! with `n` the facet's normal or, against a rigid surface, the normal
//! interpolated from the nodal frames. Whole facets take 2x2 Gauss points, cut
//! ones the points of [`crate::clip`].

use nalgebra::Vector3;
use num_dual::DualSVec64;
use striae_mesh::{FacetId, Vec3};
use striae_surface::{
    facet::{Shape, area_vector},
    scalar::{Real, combination, constant3, cross, norm, normalised, scaled},
    topology::distinct_corners,
    transport::transported,
};

use crate::{
    clip::{QuadraturePoint, covered_points},
    facet_coverage::FacetCoverage,
    quadrature::GAUSS_2,
    term::{Field, Lanes, LocalTerm, Source, gradient, variable, variables3},
    transfer::Fields,
};

/// Forces of the contact tractions on the corners of a facet.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FacetForces {
    /// Force on each corner.
    pub force: [Vec3; 4],
    /// Area that belongs to each corner, `integral N_J da`.
    pub area: [f64; 4],
    /// `integral p da`.
    pub pressure: f64,
    /// `integral |tau| da`.
    pub friction: f64,
}

/// Combinations of force and moment that the rows of a patch stand for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BalanceRows {
    /// First balance unknown of the patch.
    pub first: u32,
    /// Patch centre.
    pub centre: Vec3,
    /// Patch radius.
    pub radius: f64,
    /// Weights of `(F, M/l)` in every active row.
    pub modes: nalgebra::Matrix6<f64>,
    /// Number of active rows.
    pub active: usize,
}

/// Terms of one facet: momentum rows of its corners and balance rows of its patch.
pub fn facet_terms(
    fields: &Fields,
    side: usize,
    facet: FacetId,
    balance: Option<&BalanceRows>,
) -> (Vec<LocalTerm>, FacetForces) {
    match fields.configuration.facet_coverage(side, facet) {
        FacetCoverage::Bare => (Vec::new(), FacetForces::default()),
        FacetCoverage::Whole => {
            let points = GAUSS_2.iter().flat_map(|&(xi, w_xi)| {
                GAUSS_2.iter().map(move |&(eta, w_eta)| QuadraturePoint {
                    xi: DualSVec64::<40>::from_re(xi),
                    eta: DualSVec64::from_re(eta),
                    weight: DualSVec64::from_re(w_xi * w_eta),
                })
            });
            let points: Vec<_> = points.collect();
            let kernel = Kernel::<40>::new(fields, side, facet, None);
            let (term, forces) = kernel.term(&points, balance);
            (vec![term], forces)
        }
        FacetCoverage::Cut(covers) => {
            let mut sum = FacetForces::default();
            let mut terms = Vec::with_capacity(covers.len());
            for cover in covers {
                let kernel = Kernel::<52>::new(fields, side, facet, Some(cover));
                let points = covered_points(&kernel.x, &kernel.cover);
                if !points.is_empty() {
                    let (term, forces) = kernel.term(&points, balance);
                    terms.push(term);
                    sum.add(&forces);
                }
            }
            (terms, sum)
        }
    }
}

impl FacetForces {
    fn add(&mut self, other: &Self) {
        for corner in 0..4 {
            self.force[corner] += other.force[corner];
            self.area[corner] += other.area[corner];
        }
        self.pressure += other.pressure;
        self.friction += other.friction;
    }
}

/// Quantities of a facet on lanes: corner positions `0..12`, corner normals
/// `12..24`, pressures `24..28`, friction tractions `28..40` and the corners of
/// a covering facet `40..52`.
struct Kernel<'a, const N: usize> {
    lanes: Lanes<'a>,
    rows: [u32; 4],
    x: [Vector3<DualSVec64<N>>; 4],
    n: [Vector3<DualSVec64<N>>; 4],
    p: [DualSVec64<N>; 4],
    tau: [Vector3<DualSVec64<N>>; 4],
    cover: Vec<Vector3<DualSVec64<N>>>,
    normal: NormalField,
}

/// Normal that pressure acts along.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum NormalField {
    /// The facet's own.
    Facet,
    /// Interpolated from the nodal frames.
    Nodal,
}

impl<'a, const N: usize> Kernel<'a, N> {
    fn new(fields: &Fields<'a>, side: usize, facet: FacetId, cover: Option<FacetId>) -> Self {
        let configuration = fields.configuration;
        let numbering = configuration.pair.numbering();
        let own = configuration.side(side);
        let corners = own.corners(facet);
        let mut lanes = Lanes::default();
        let rows = corners.map(|corner| numbering.position(side, corner));
        for first in rows {
            lanes.push(Source::Unknowns { first, count: 3 });
        }
        for corner in corners {
            fields.push_vector(&mut lanes, fields.normal_jacobian(side, corner));
        }
        for corner in corners {
            fields.push_pressure(&mut lanes, side, corner);
        }
        for corner in corners {
            fields.push_vector(&mut lanes, fields.tau_jacobian(side, corner));
        }
        let cover = cover.map_or_else(Vec::new, |cover| {
            let other = configuration.side(1 - side);
            let opposite = other.corners(cover);
            for corner in opposite {
                lanes.push(if configuration.pair.is_rigid() {
                    Source::Constant(3)
                } else {
                    Source::Unknowns {
                        first: numbering.position(1 - side, corner),
                        count: 3,
                    }
                });
            }
            let corners = variables3(&other.corner_positions(cover), 40);
            corners[..distinct_corners(&opposite).len()].to_vec()
        });
        let pressure = |at: usize| variable(fields.pressure(side, corners[at]), 24 + at);
        Self {
            rows,
            x: variables3(&own.corner_positions(facet), 0),
            n: variables3(&corners.map(|corner| fields.normal(side, corner)), 12),
            p: std::array::from_fn(pressure),
            tau: variables3(&corners.map(|c| fields.tau[side][c as usize].value), 28),
            cover,
            normal: if configuration.pair.is_rigid() {
                NormalField::Nodal
            } else {
                NormalField::Facet
            },
            lanes,
        }
    }

    fn term(
        &self,
        points: &[QuadraturePoint<DualSVec64<N>>],
        balance: Option<&BalanceRows>,
    ) -> (LocalTerm, FacetForces) {
        let zero = || Vector3::repeat(DualSVec64::<N>::from_re(0.0));
        let mut force = [(); 4].map(|()| zero());
        let mut forces = FacetForces::default();
        for point in points {
            let weights = Shape::Quadrilateral.weights(point.xi, point.eta);
            let density = self.density(&weights);
            let weight = point.weight.re * density.area;
            forces.pressure += weight * density.pressure;
            forces.friction += weight * density.friction;
            let load = scaled(&density.force, point.weight);
            for corner in 0..4 {
                force[corner] += scaled(&load, weights.value[corner]);
                forces.area[corner] += weight * weights.value[corner].re;
            }
        }
        forces.force = force.each_ref().map(|f| f.map(|component| component.re));
        (self.rows(&force, balance), forces)
    }

    /// `t |x_,xi x x_,eta|` at a point.
    fn density(&self, weights: &striae_surface::facet::Weights<DualSVec64<N>>) -> Density<N> {
        let area = area_vector(weights, &self.x);
        let size = norm(&area);
        let n = match self.normal {
            NormalField::Facet => normalised(&area),
            NormalField::Nodal => normalised(&combination(&weights.value, &self.n)),
        };
        let turned: [Vector3<DualSVec64<N>>; 4] =
            std::array::from_fn(|corner| transported(&self.tau[corner], &self.n[corner], &n));
        let tau = combination(&weights.value, &turned);
        let mut p = self.p[0] * weights.value[0];
        for corner in 1..4 {
            p += self.p[corner] * weights.value[corner];
        }
        Density {
            force: scaled(&(tau - scaled(&n, p)), size),
            area: size.re,
            pressure: p.re,
            friction: tau.map(|component| component.re).norm(),
        }
    }

    /// Momentum rows `-f` and balance rows.
    fn rows(
        &self,
        force: &[Vector3<DualSVec64<N>>; 4],
        balance: Option<&BalanceRows>,
    ) -> LocalTerm {
        let mut rows = Vec::with_capacity(18);
        for corner in 0..4 {
            for axis in 0..3 {
                let row = -force[corner][axis];
                rows.push((
                    self.rows[corner] + axis as u32,
                    Field::Momentum,
                    row.re,
                    gradient(&row),
                ));
            }
        }
        if let Some(balance) = balance {
            let mut resultant = [DualSVec64::<N>::from_re(0.0); 6];
            for corner in 0..4 {
                let arm = self.x[corner] - constant3::<DualSVec64<N>>(&balance.centre);
                let moment = cross(&arm, &force[corner]);
                for axis in 0..3 {
                    resultant[axis] += force[corner][axis];
                    resultant[3 + axis] += moment[axis] / balance.radius;
                }
            }
            for mode in 0..balance.active {
                let mut row = DualSVec64::<N>::from_re(0.0);
                for (component, value) in resultant.iter().enumerate() {
                    row += *value * balance.modes[(component, mode)];
                }
                rows.push((
                    balance.first + mode as u32,
                    Field::Resultant,
                    row.re,
                    gradient(&row),
                ));
            }
        }
        LocalTerm::from_lanes(&self.lanes, &rows)
    }
}

struct Density<const N: usize> {
    force: Vector3<DualSVec64<N>>,
    area: f64,
    pressure: f64,
    friction: f64,
}

/// A load on the surface, as force per current area.
pub trait SurfaceLoad {
    /// The load at a point of the facet with these current corners.
    fn per_area<D: Real>(&self, x: &[Vector3<D>; 4], xi: D, eta: D) -> Vector3<D>;
}

/// Nodal forces of a load on the covered part of a cut facet: rows of the
/// corners' positions with the residual *plus* force (what is taken away from
/// the external load).
pub fn covered_load<L: SurfaceLoad>(
    configuration: &crate::configuration::Configuration,
    side: usize,
    facet: FacetId,
    covers: &[FacetId],
    load: &L,
) -> Vec<LocalTerm> {
    const N: usize = 24;
    let numbering = configuration.pair.numbering();
    let (own, other) = (configuration.side(side), configuration.side(1 - side));
    let first = own
        .corners(facet)
        .map(|corner| numbering.position(side, corner));
    let x: [Vector3<DualSVec64<N>>; 4] = variables3(&own.corner_positions(facet), 0);
    let mut terms = Vec::with_capacity(covers.len());
    for &cover in covers {
        let mut lanes = Lanes::default();
        for first in first {
            lanes.push(Source::Unknowns { first, count: 3 });
        }
        let opposite = other.corners(cover);
        for corner in opposite {
            lanes.push(if configuration.pair.is_rigid() {
                Source::Constant(3)
            } else {
                Source::Unknowns {
                    first: numbering.position(1 - side, corner),
                    count: 3,
                }
            });
        }
        let corners = variables3(&other.corner_positions(cover), 12);
        let window = &corners[..distinct_corners(&opposite).len()];
        let mut force = [(); 4].map(|()| Vector3::repeat(DualSVec64::<N>::from_re(0.0)));
        for point in covered_points(&x, window) {
            let weights = Shape::Quadrilateral.weights(point.xi, point.eta);
            let area = norm(&area_vector(&weights, &x)) * point.weight;
            let density = scaled(&load.per_area(&x, point.xi, point.eta), area);
            for corner in 0..4 {
                force[corner] += scaled(&density, weights.value[corner]);
            }
        }
        let rows: Vec<_> = (0..12)
            .map(|at| {
                let row = force[at / 3][at % 3];
                (
                    first[at / 3] + (at % 3) as u32,
                    Field::Momentum,
                    row.re,
                    gradient(&row),
                )
            })
            .collect();
        terms.push(LocalTerm::from_lanes(&lanes, &rows));
    }
    terms
}
