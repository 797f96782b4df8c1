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

use nalgebra::{Matrix3, Vector3, Vector6};
use num_dual::{Derivative, DualSVec64};
use striae_mesh::{FacetId, Vec3};
use striae_surface::{
    facet::{Shape, Weights},
    scalar::combination,
    topology::distinct_corners,
};

use crate::{
    clip::{QuadraturePoint, covered_points},
    facet_coverage::FacetCoverage,
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
    let mut sum = FacetForces::default();
    let mut terms = Vec::new();
    match fields.configuration.facet_coverage(side, facet) {
        FacetCoverage::Bare => {}
        FacetCoverage::Whole => {
            let kernel = Kernel::new(fields, side, facet, None);
            terms.push(kernel.term(&whole_points(), balance, &mut sum));
        }
        FacetCoverage::Cut(covers) => {
            for cover in covers {
                let kernel = Kernel::new(fields, side, facet, Some(cover));
                let points = covered_points(&kernel.corners(), &kernel.cover_corners());
                if !points.is_empty() {
                    terms.push(kernel.term(&points, balance, &mut sum));
                }
            }
        }
    }
    (terms, sum)
}

/// A dual number over the corners of a facet and of a covering one.
type Moving = DualSVec64<24>;

fn whole_points() -> Vec<QuadraturePoint<Moving>> {
    let mut points = Vec::with_capacity(4);
    for (xi, w_xi) in GAUSS_2 {
        for (eta, w_eta) in GAUSS_2 {
            points.push(QuadraturePoint {
                xi: Moving::from_re(xi),
                eta: Moving::from_re(eta),
                weight: Moving::from_re(w_xi * w_eta),
            });
        }
    }
    points
}

/// Lanes: corner positions, corner normals, pressures, friction tractions and
/// the corners of a covering facet.
const LANES: usize = 52;
const X: usize = 0;
const NORMAL: usize = 12;
const PRESSURE: usize = 24;
const TAU: usize = 28;
const COVER: usize = 40;

/// Derivatives of a vector lane by lane.
type Gradient3 = [[f64; 3]; LANES];

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

    fn corners(&self) -> [Vector3<Moving>; 4] {
        variables3(&self.x, 0)
    }

    fn cover_corners(&self) -> Vec<Vector3<Moving>> {
        let corners = self.cover.iter().enumerate();
        corners.map(|(at, x)| variable3(x, 12 + 3 * at)).collect()
    }

    fn term(
        &self,
        points: &[QuadraturePoint<Moving>],
        balance: Option<&BalanceRows>,
        sum: &mut FacetForces,
    ) -> LocalTerm {
        let mut force = [Vec3::zeros(); 4];
        let mut slopes: Slopes = [[0.0; 12]; LANES];
        for point in points {
            let weights = Shape::Quadrilateral.weights(point.xi.re, point.eta.re);
            let density = self.density(&weights);
            let w = point.weight.re;
            let area = w * density.area;
            sum.pressure += area * density.pressure;
            sum.friction += area * density.friction;
            for corner in 0..4 {
                force[corner] += density.force * (weights.value[corner] * w);
                sum.area[corner] += area * weights.value[corner];
            }
            for (slope, by_lane) in slopes[..COVER].iter_mut().zip(&density.gradient) {
                for corner in 0..4 {
                    for axis in 0..3 {
                        slope[3 * corner + axis] += by_lane[axis] * (weights.value[corner] * w);
                    }
                }
            }
            density.add_moving(&weights, point, &mut slopes);
        }
        for corner in 0..4 {
            sum.force[corner] += force[corner];
        }
        self.rows(&force, &slopes, balance)
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
        let mut gradient: Gradient3 = [[0.0; 3]; LANES];
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
    fn rows(&self, force: &[Vec3; 4], slopes: &Slopes, balance: Option<&BalanceRows>) -> LocalTerm {
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
        let resultant = self.resultant(force, balance);
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
            let mut change = self.resultant(&slopes, balance);
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

    /// Force and moment over the patch radius about the patch centre.
    fn resultant(&self, force: &[Vec3; 4], balance: &BalanceRows) -> Vector6<f64> {
        let mut resultant = Vector6::zeros();
        for corner in 0..4 {
            let arm = (self.x[corner] - balance.centre) / balance.radius;
            let mut sum = resultant.fixed_view_mut::<3, 1>(0, 0);
            sum += force[corner];
            let mut sum = resultant.fixed_view_mut::<3, 1>(3, 0);
            sum += arm.cross(&force[corner]);
        }
        resultant
    }
}

struct Density {
    force: Vec3,
    gradient: Gradient3,
    d_xi: Vec3,
    d_eta: Vec3,
    area: f64,
    pressure: f64,
    friction: f64,
}

impl Density {
    /// Adds the derivatives of the forces by a quadrature point that moves with the corners.
    fn add_moving(
        &self,
        weights: &Weights<f64>,
        point: &QuadraturePoint<Moving>,
        slopes: &mut Slopes,
    ) {
        let w = point.weight.re;
        for corner in 0..4 {
            let value = weights.value[corner];
            let by_xi = (self.d_xi * value + self.force * weights.d_xi[corner]) * w;
            let by_eta = (self.d_eta * value + self.force * weights.d_eta[corner]) * w;
            let parts = [
                (by_xi, &point.xi),
                (by_eta, &point.eta),
                (self.force * value, &point.weight),
            ];
            for (vector, quantity) in parts {
                let Derivative(Some(gradient)) = &quantity.eps else {
                    continue;
                };
                for lane in 0..12 {
                    for axis in 0..3 {
                        slopes[X + lane][3 * corner + axis] += vector[axis] * gradient[lane];
                        slopes[COVER + lane][3 * corner + axis] +=
                            vector[axis] * gradient[12 + lane];
                    }
                }
            }
        }
    }
}
