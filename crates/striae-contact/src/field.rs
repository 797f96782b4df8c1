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

use nalgebra::{Matrix3, Vector3};
use num_dual::DualSVec64;
use striae_mesh::{FacetId, Vec3};
use striae_surface::{
    facet::{Shape, Weights},
    scalar::combination,
    topology::distinct_corners,
};

use crate::{
    balance::BalanceRows,
    clip::{Covered, covered},
    facet_coverage::FacetCoverage,
    moving::{FlatSlopes, moving_points},
    quadrature::GAUSS_2,
    term::{Field, Lanes, LocalTerm, Row, Source, add_block, variable3, variables3},
    transfer::Fields,
    transported::Transported,
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

/// Terms of one facet: momentum rows of its corners and balance rows of its patch.
pub fn facet_terms(
    fields: &Fields,
    side: usize,
    facet: FacetId,
    balance: Option<&BalanceRows>,
) -> (Vec<LocalTerm>, FacetForces) {
    let mut sum = FacetForces::default();
    let mut terms = Vec::new();
    match fields.configuration.facet_coverage(side, facet) {
        FacetCoverage::Bare => {}
        FacetCoverage::Whole => {
            let kernel = Kernel::new(fields, side, facet, None);
            terms.push(kernel.whole(balance, &mut sum));
        }
        FacetCoverage::Cut(covers) => {
            for cover in covers {
                let kernel = Kernel::new(fields, side, facet, Some(cover));
                if !covered(&kernel.x, &kernel.cover).triangles.is_empty() {
                    terms.push(kernel.covered(balance, &mut sum));
                }
            }
        }
    }
    (terms, sum)
}

/// Lanes: corner positions, corner normals, pressures, friction tractions and
/// the corners of a covering facet.
const LANES: usize = 52;
const X: usize = 0;
const NORMAL: usize = 12;
const PRESSURE: usize = 24;
const TAU: usize = 28;
const COVER: usize = 40;

/// Derivatives of the forces on the four corners lane by lane.
type Slopes = [[f64; 12]; LANES];

/// Quantities of a facet and where they come from.
struct Kernel<'a> {
    lanes: Lanes<'a>,
    rows: [u32; 4],
    x: [Vec3; 4],
    n: [Vec3; 4],
    p: [f64; 4],
    tau: [Vec3; 4],
    cover: Vec<Vec3>,
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

impl<'a> Kernel<'a> {
    fn new(fields: &Fields<'a>, side: usize, facet: FacetId, cover: Option<FacetId>) -> Self {
        let configuration = fields.configuration;
        let rigid = configuration.pair.is_rigid();
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
            for corner in opposite.into_iter().filter(|_| !rigid) {
                let first = numbering.position(1 - side, corner);
                lanes.push(Source::Unknowns { first, count: 3 });
            }
            other.corner_positions(cover)[..distinct_corners(&opposite).len()].to_vec()
        });
        if cover.is_empty() || rigid {
            lanes.push(Source::Constant(12));
        }
        Self {
            rows,
            x: own.corner_positions(facet),
            n: corners.map(|corner| fields.normal(side, corner)),
            p: corners.map(|corner| fields.pressure(side, corner)),
            tau: corners.map(|corner| fields.tau[side][corner as usize].value),
            cover,
            normal: if rigid {
                NormalField::Nodal
            } else {
                NormalField::Facet
            },
            lanes,
        }
    }

    /// The term of the whole facet.
    fn whole(&self, balance: Option<&BalanceRows>, sum: &mut FacetForces) -> LocalTerm {
        let mut integral = Integral::zero();
        for (xi, w_xi) in GAUSS_2 {
            for (eta, w_eta) in GAUSS_2 {
                let weights = Shape::Quadrilateral.weights(xi, eta);
                integral.add(&weights, &self.density(&weights), w_xi * w_eta, sum);
            }
        }
        self.rows(&integral, balance, sum)
    }

    /// The term of its covered part.
    fn covered(&self, balance: Option<&BalanceRows>, sum: &mut FacetForces) -> LocalTerm {
        let x: [Vector3<DualSVec64<24>>; 4] = variables3(&self.x, 0);
        let cover = self.cover.iter().enumerate();
        let cover: Vec<_> = cover.map(|(at, x)| variable3(x, 12 + 3 * at)).collect();
        let covered: Covered<DualSVec64<24>> = covered(&x, &cover);
        let mut integral = Integral::zero();
        for triangle in 0..covered.triangles.len() {
            let mut flat = FlatSlopes::<12>::zero();
            for point in moving_points(&covered, triangle) {
                let weights = Shape::Quadrilateral.weights(point.xi, point.eta);
                let density = self.density(&weights);
                integral.add(&weights, &density, point.weight, sum);
                let [by_xi, by_eta, by_weight] = density.moved(&weights);
                let by_xi = by_xi.map(|slope| slope * point.weight);
                let by_eta = by_eta.map(|slope| slope * point.weight);
                flat.add(&point, [&by_xi, &by_eta, &by_weight]);
            }
            let chained = flat.chained(&covered, triangle);
            for (lane, by_lane) in (X..X + 12).chain(COVER..COVER + 12).zip(&chained) {
                let slopes = integral.slopes[lane].iter_mut().zip(by_lane);
                slopes.for_each(|(slope, change)| *slope += change);
            }
        }
        self.rows(&integral, balance, sum)
    }

    /// `t |x_,xi x x_,eta|` at a point with its derivatives.
    fn density(&self, weights: &Weights<f64>) -> Density {
        let x_xi = combination(&weights.d_xi, &self.x);
        let x_eta = combination(&weights.d_eta, &self.x);
        let twist = (self.x[0] - self.x[1] + self.x[2] - self.x[3]) * 0.25;
        let a = x_xi.cross(&x_eta);
        let size = a.norm();
        let d_a = [x_xi.cross(&twist), twist.cross(&x_eta)];
        let interpolated = combination(&weights.value, &self.n);
        let n = match self.normal {
            NormalField::Facet => a / size,
            NormalField::Nodal => interpolated.normalize(),
        };
        let p: f64 = (0..4)
            .map(|corner| weights.value[corner] * self.p[corner])
            .sum();
        let turned: [Transported; 4] =
            std::array::from_fn(|corner| Transported::new(&self.tau[corner], &self.n[corner], &n));
        let tau: Vec3 = (0..4).map(|c| turned[c].value * weights.value[c]).sum();
        let traction = tau - n * p;

        let mut by_n = Matrix3::identity() * (-p * size);
        for corner in 0..4 {
            by_n += turned[corner].by_n * (size * weights.value[corner]);
        }
        let mut by_a = traction * (a / size).transpose();
        let mut gradient = [[0.0; 3]; COVER];
        let slope = |weights: &[f64; 4]| -> Vec3 {
            (0..4)
                .map(|c| (turned[c].value - n * self.p[c]) * (size * weights[c]))
                .sum()
        };
        let (mut d_xi, mut d_eta) = (slope(&weights.d_xi), slope(&weights.d_eta));
        match self.normal {
            NormalField::Facet => by_a += by_n * (Matrix3::identity() - n * n.transpose()) / size,
            NormalField::Nodal => {
                let tangential = (Matrix3::identity() - n * n.transpose()) / interpolated.norm();
                let by_sum = by_n * tangential;
                for corner in 0..4 {
                    let block = by_sum * weights.value[corner];
                    add_block(&mut gradient, NORMAL + 3 * corner, &block);
                }
                d_xi += by_sum * combination(&weights.d_xi, &self.n);
                d_eta += by_sum * combination(&weights.d_eta, &self.n);
            }
        }
        d_xi += by_a * d_a[0];
        d_eta += by_a * d_a[1];
        let (cross_xi, cross_eta) = (x_xi.cross_matrix(), x_eta.cross_matrix());
        for corner in 0..4 {
            let share = size * weights.value[corner];
            let by_x = cross_xi * weights.d_eta[corner] - cross_eta * weights.d_xi[corner];
            let mut add = |lane: usize, block: Matrix3<f64>| {
                add_block(&mut gradient, lane + 3 * corner, &block);
            };
            add(X, by_a * by_x);
            add(NORMAL, turned[corner].by_from * share);
            add(TAU, turned[corner].by_vector * share);
            gradient[PRESSURE + corner] = (n * -share).into();
        }
        Density {
            force: traction * size,
            gradient,
            d_xi,
            d_eta,
            area: size,
            pressure: p,
            friction: tau.norm(),
        }
    }

    /// Momentum rows `-f` and balance rows.
    fn rows(
        &self,
        integral: &Integral,
        balance: Option<&BalanceRows>,
        sum: &mut FacetForces,
    ) -> LocalTerm {
        let Integral { force, slopes } = integral;
        for corner in 0..4 {
            sum.force[corner] += force[corner];
        }
        let mut rows: Vec<Row> = Vec::with_capacity(18);
        for corner in 0..4 {
            for axis in 0..3 {
                let unknown = self.rows[corner] + axis as u32;
                rows.push((unknown, Field::Momentum, -force[corner][axis]));
            }
        }
        let triples = self.lanes.triples();
        let columns = self.lanes.chained(slopes, &triples);
        let momentum = |column: &[f64; 12]| column.map(|slope| -slope);
        let Some(balance) = balance else {
            let columns: Vec<[f64; 12]> = columns.iter().map(momentum).collect();
            return LocalTerm::from_columns(&rows, &triples, &columns);
        };
        let resultant = balance.resultant(&self.x, force);
        for mode in 0..balance.active {
            let residual = balance.modes.column(mode).dot(&resultant);
            rows.push((balance.first + mode as u32, Field::Resultant, residual));
        }
        let mut with_balance = vec![[0.0; 18]; columns.len()];
        for (at, (to, column)) in with_balance.iter_mut().zip(&columns).enumerate() {
            to[..12].copy_from_slice(&momentum(column));
            let slopes: [Vec3; 4] = std::array::from_fn(|corner| {
                Vec3::from_column_slice(&column[3 * corner..3 * corner + 3])
            });
            let mut change = balance.resultant(&self.x, &slopes);
            // A corner that moves takes its force along.
            for corner in (0..4).filter(|&corner| self.rows[corner] == triples[at / 3]) {
                let turn = Vec3::ith(at % 3, 1.0 / balance.radius).cross(&force[corner]);
                let mut moment = change.fixed_view_mut::<3, 1>(3, 0);
                moment += turn;
            }
            to[12..].copy_from_slice(balance.modes.tr_mul(&change).as_slice());
        }
        LocalTerm::from_columns(&rows, &triples, &with_balance)
    }
}

/// Forces on the four corners and their derivatives.
struct Integral {
    force: [Vec3; 4],
    slopes: Slopes,
}

impl Integral {
    fn zero() -> Self {
        Self {
            force: [Vec3::zeros(); 4],
            slopes: [[0.0; 12]; LANES],
        }
    }

    /// Adds a quadrature point of the weight `w`.
    fn add(&mut self, weights: &Weights<f64>, density: &Density, w: f64, sum: &mut FacetForces) {
        let area = w * density.area;
        sum.pressure += area * density.pressure;
        sum.friction += area * density.friction;
        for corner in 0..4 {
            self.force[corner] += density.force * (weights.value[corner] * w);
            sum.area[corner] += area * weights.value[corner];
        }
        for (slope, by_lane) in self.slopes[..COVER].iter_mut().zip(&density.gradient) {
            for corner in 0..4 {
                for axis in 0..3 {
                    slope[3 * corner + axis] += by_lane[axis] * (weights.value[corner] * w);
                }
            }
        }
    }
}

/// The contact force per `d xi d eta` at a point.
struct Density {
    force: Vec3,
    gradient: [[f64; 3]; COVER],
    d_xi: Vec3,
    d_eta: Vec3,
    area: f64,
    pressure: f64,
    friction: f64,
}

impl Density {
    /// Derivatives of the forces on the corners by the coordinates, over the weight, and
    /// by the weight of the point.
    fn moved(&self, weights: &Weights<f64>) -> [[f64; 12]; 3] {
        let mut moved = [[0.0; 12]; 3];
        for corner in 0..4 {
            let value = weights.value[corner];
            let by_xi = self.d_xi * value + self.force * weights.d_xi[corner];
            let by_eta = self.d_eta * value + self.force * weights.d_eta[corner];
            for (rows, by) in moved.iter_mut().zip([by_xi, by_eta, self.force * value]) {
                rows[3 * corner..3 * corner + 3].copy_from_slice(by.as_slice());
            }
        }
        moved
    }
}
