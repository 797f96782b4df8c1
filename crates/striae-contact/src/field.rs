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
//! ones the points of `clip`.

use nalgebra::{Matrix3, Vector3};
use num_dual::DualSVec64;
use striae_mesh::{FacetId, Vec3};
use striae_surface::{
    facet::{Shape, Weights},
    scalar::combination,
    topology::distinct_corners,
};

pub use crate::integral::FacetForces;
use crate::{
    clip::FlatFacet,
    collocated::NodalField,
    configuration::Configuration,
    facet_coverage::FacetCoverage,
    frame::Frames,
    integral::{Density, Integral, LANES},
    moving::{FlatSlopes, moving_points},
    quadrature::GAUSS_2,
    side::Side,
    term::{Field, Lanes, LocalTerm, Row, Source, add_block, variable3, variables3},
    transported::Transported,
};

/// The fields of both sides.
#[derive(Clone, Copy, Debug)]
pub struct Fields<'a> {
    /// Configuration of the pair.
    pub configuration: &'a Configuration<'a>,
    /// Nodal frames.
    pub frames: &'a Frames,
    /// Nodal pressures and frictions.
    pub nodal: &'a [Vec<NodalField>; 2],
}

/// Terms of one facet: momentum rows of its corners.
pub(crate) fn facet_terms(
    fields: &Fields,
    side: Side,
    facet: FacetId,
) -> (Vec<LocalTerm>, FacetForces) {
    let mut sum = FacetForces::default();
    let mut terms = Vec::new();
    match fields.configuration.facet_coverage(side, facet) {
        FacetCoverage::Bare => {}
        FacetCoverage::Whole => {
            let kernel = Kernel::new(fields, side, facet);
            terms.push(kernel.whole(&mut sum));
        }
        FacetCoverage::Cut(covers) => {
            let covers = covers.iter().map(|cover| Cover::new(fields, side, *cover));
            let covers: Vec<Cover> = covers.collect();
            let kernel = Kernel::new(fields, side, facet);
            terms.extend(kernel.cut(&covers, &mut sum));
        }
    }
    (terms, sum)
}

/// Lanes of the corners: positions, normals, pressures and friction tractions.
const X: usize = 0;
const NORMAL: usize = 12;
const PRESSURE: usize = 24;
const TAU: usize = 28;

/// An opposing facet that may cover a part.
struct Cover<'a> {
    lanes: Lanes<'a>,
    x: Vec<Vec3>,
}

impl Cover<'_> {
    fn new(fields: &Fields, side: Side, facet: FacetId) -> Self {
        let configuration = fields.configuration;
        let other = configuration.side(side.opposite());
        let corners = other.corners(facet);
        let mut lanes = Lanes::default();
        if configuration.pair.is_rigid() {
            lanes.push(Source::Constant(12));
        } else {
            for corner in corners {
                let first = configuration
                    .pair
                    .numbering()
                    .position(side.opposite(), corner);
                lanes.push(Source::Unknowns { first, count: 3 });
            }
        }
        let x = other.corner_positions(facet)[..distinct_corners(&corners).len()].to_vec();
        Self { lanes, x }
    }
}

/// Quantities of a facet and where they come from.
struct Kernel<'a> {
    lanes: Lanes<'a>,
    rows: [u32; 4],
    x: [Vec3; 4],
    n: [Vec3; 4],
    p: [f64; 4],
    tau: [Vec3; 4],
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
    fn new(fields: &Fields<'a>, side: Side, facet: FacetId) -> Self {
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
        let nodal = corners.map(|corner| &fields.nodal[side][corner]);
        let normals = corners.map(|corner| {
            let frame = fields.frames[side][corner].as_ref();
            &frame.expect("all corners carry traction").n
        });
        for n in normals {
            lanes.push(Source::Vector(&n.jacobian));
        }
        for field in nodal {
            lanes.push(Source::Scalar(&field.pressure.gradient));
        }
        for field in nodal {
            lanes.push(Source::Vector(&field.tau.jacobian));
        }
        Self {
            rows,
            x: own.corner_positions(facet),
            n: normals.map(|n| n.value),
            p: nodal.map(|field| field.pressure.value),
            tau: nodal.map(|field| field.tau.value),
            normal: if rigid {
                NormalField::Nodal
            } else {
                NormalField::Facet
            },
            lanes,
        }
    }

    /// The term of the whole facet.
    fn whole(&self, sum: &mut FacetForces) -> LocalTerm {
        let mut integral = Integral::zero();
        for (xi, w_xi) in GAUSS_2 {
            for (eta, w_eta) in GAUSS_2 {
                let weights = Shape::Quadrilateral.weights(xi, eta);
                integral.add(&weights, &self.density(&weights), w_xi * w_eta, sum);
            }
        }
        integral.report(sum);
        self.term(&self.lanes, &integral.force, &integral.slopes)
    }

    /// Terms of its covered parts: one with all forces, and for every cover one with
    /// their derivatives by its corners.
    fn cut(&self, covers: &[Cover], sum: &mut FacetForces) -> Vec<LocalTerm> {
        let in_plane = FlatFacet::new(Shape::Quadrilateral, &self.x);
        let mut covers = covers
            .iter()
            .filter(|cover| !in_plane.covered(&cover.x).is_empty())
            .peekable();
        if covers.peek().is_none() {
            return Vec::new();
        }
        let flat: FlatFacet<DualSVec64<24>> =
            FlatFacet::new(Shape::Quadrilateral, &variables3(&self.x, 0));
        let mut integral = Integral::zero();
        let mut terms = Vec::new();
        for cover in covers {
            let slopes = self.covered(&flat, cover, &mut integral, sum);
            terms.push(self.term(&cover.lanes, &[Vec3::zeros(); 4], &slopes));
        }
        integral.report(sum);
        terms.push(self.term(&self.lanes, &integral.force, &integral.slopes));
        terms
    }

    /// Adds the part that a facet covers; returns derivatives by the corners of that facet.
    fn covered(
        &self,
        flat: &FlatFacet<DualSVec64<24>>,
        cover: &Cover,
        integral: &mut Integral,
        sum: &mut FacetForces,
    ) -> [[f64; 12]; 12] {
        let window = cover.x.iter().enumerate();
        let window: Vec<Vector3<_>> = window.map(|(at, x)| variable3(x, 12 + 3 * at)).collect();
        let mut by_cover = [[0.0; 12]; 12];
        for triangle in &flat.covered(&window) {
            let mut slopes = FlatSlopes::<12>::zero();
            for point in moving_points(&flat.corners, triangle) {
                let weights = Shape::Quadrilateral.weights(point.xi, point.eta);
                let density = self.density(&weights);
                integral.add(&weights, &density, point.weight, sum);
                let [by_xi, by_eta, by_weight] = density.moved(&weights);
                let by_xi = by_xi.map(|slope| slope * point.weight);
                let by_eta = by_eta.map(|slope| slope * point.weight);
                slopes.add(&point, [&by_xi, &by_eta, &by_weight]);
            }
            let chained = slopes.chained(&flat.corners, triangle);
            let lanes = integral.slopes[X..X + 12].iter_mut().chain(&mut by_cover);
            for (slopes, by_lane) in lanes.zip(&chained) {
                let slopes = slopes.iter_mut().zip(by_lane);
                slopes.for_each(|(slope, change)| *slope += change);
            }
        }
        by_cover
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
        let slope = |weights: &[f64; 4]| -> Vec3 {
            (0..4)
                .map(|c| (turned[c].value - n * self.p[c]) * (size * weights[c]))
                .sum()
        };
        let mut density = Density {
            force: traction * size,
            gradient: [[0.0; 3]; LANES],
            d_xi: slope(&weights.d_xi),
            d_eta: slope(&weights.d_eta),
            area: size,
            pressure: p,
            friction: tau.norm(),
        };
        match self.normal {
            NormalField::Facet => by_a += by_n * (Matrix3::identity() - n * n.transpose()) / size,
            NormalField::Nodal => {
                let tangential = (Matrix3::identity() - n * n.transpose()) / interpolated.norm();
                let by_sum = by_n * tangential;
                for corner in 0..4 {
                    let block = by_sum * weights.value[corner];
                    add_block(&mut density.gradient, NORMAL + 3 * corner, &block);
                }
                density.d_xi += by_sum * combination(&weights.d_xi, &self.n);
                density.d_eta += by_sum * combination(&weights.d_eta, &self.n);
            }
        }
        density.d_xi += by_a * d_a[0];
        density.d_eta += by_a * d_a[1];
        let (cross_xi, cross_eta) = (x_xi.cross_matrix(), x_eta.cross_matrix());
        for corner in 0..4 {
            let by_x = cross_xi * weights.d_eta[corner] - cross_eta * weights.d_xi[corner];
            let share = size * weights.value[corner];
            add_corner(
                &mut density.gradient,
                corner,
                by_a * by_x,
                &turned[corner],
                share,
            );
            density.gradient[PRESSURE + corner] = (n * -share).into();
        }
        density
    }

    /// Momentum rows `-f`.
    fn term(&self, lanes: &Lanes, force: &[Vec3; 4], slopes: &[[f64; 12]]) -> LocalTerm {
        let mut rows: Vec<Row> = Vec::with_capacity(12);
        for corner in 0..4 {
            for axis in 0..3 {
                let unknown = self.rows[corner] + axis as u32;
                rows.push((unknown, Field::Momentum, -force[corner][axis]));
            }
        }
        let triples = lanes.triples();
        let columns = lanes.chained(slopes, &triples);
        let columns: Vec<[f64; 12]> = columns
            .iter()
            .map(|column| column.map(|slope| -slope))
            .collect();
        LocalTerm::from_columns(&rows, &triples, &columns)
    }
}

/// Adds the derivatives of a density by the place, the normal and the friction of a corner,
/// which has a share of the field there.
fn add_corner(
    gradient: &mut [[f64; 3]],
    corner: usize,
    by_x: Matrix3<f64>,
    turned: &Transported,
    share: f64,
) {
    let mut add = |lane: usize, block: Matrix3<f64>| {
        add_block(gradient, lane + 3 * corner, &block);
    };
    add(X, by_x);
    add(NORMAL, turned.by_from * share);
    add(TAU, turned.by_vector * share);
}
