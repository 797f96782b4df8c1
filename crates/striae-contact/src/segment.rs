//! The common polygon of two facets, one of each side, with all that contact needs of it.
//!
//! ```text
//! n = unit(c_b n_a - c_a n_b)                   c: compliances h/E, 0 if rigid
//! D_cd = int N_c N_d dA                         c, d: 0..4 functions of a, 4..8 of b
//! ```
//!
//! Both facets are seen along `n`; the polygons are clipped exactly against each other in
//! the plane across it, where `dA` is the area, and a point of that plane has coordinates
//! on both facets by inverting the bilinear map of each. `n_a`, `n_b` are the unit normals
//! of the facets from their diagonals. With them come the first derivatives by the 24
//! coordinates of the corners: through `n`, vertices, weights and inverse maps.
//!
//! Both facets parallelograms or triangles (distortion below [`AFFINE`]): `D` and its
//! derivatives are exact. They need degree five, not four: the derivative of `N_c` by a
//! corner brings in one more function. Otherwise the functions are not polynomials of
//! the place; rules of degree 6 (distortion below [`MILD`]) and 8 leave a small error.
//! Distortion is the largest relative departure of the Jacobian from its mean. Corners within
//! 1e-6 of the size of the smaller facet count as on an opposing edge.

mod chain;
mod closed;
mod closed_share;
mod divided;
mod facing;
mod fan;
mod moved;
mod normal;
mod plane_facet;
mod points;
mod polygon;
mod pressed_plane;
mod rigid_plane;
mod rule;
mod sums;
mod support;

use nalgebra::Matrix3;
use pulp::{Simd, WithSimd};
use striae_mesh::Vec3;
use striae_surface::facet::Shape;

use pressed_plane::pressed_on_plane;
pub use rigid_plane::plane_segment;
pub use support::{Pressed, PressedSlopes, Pressing, Support};

use chain::{CornerSlopes, Plane};
use facing::{Facing, Faded};
use fan::{Apex, Fan, fan};
pub(crate) use normal::facet_normal;
use normal::{facet_slopes, pair_normal, pair_slopes};
use plane_facet::{PlaneFacet, Vec2};
pub(crate) use polygon::{FIRST, mixed};
use polygon::{Outline, Vertex, common, topology, twice_area};
use sums::{PAIRS, PlaneSlopes, Triangle, add_triangle, functions};

/// Facets face each other where `n_a . n_b` is below this, to which segments fade.
pub const FACING: f64 = -0.2;
/// Distance of a corner from an opposing edge, over the size of the smaller facet, up to
/// which it counts as on it.
pub const ON_EDGE: f64 = 1e-6;
/// Distortion up to which a quadrilateral counts as a parallelogram.
pub const AFFINE: f64 = 1e-6;
/// Distortion up to which the cheaper of the rules for general facets serves.
pub const MILD: f64 = 0.05;
/// Distortion from which a facet, seen along the normal, is too near to not being convex.
pub const NOT_CONVEX: f64 = 0.99;

/// A facet in space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Facet {
    /// Corners, counter-clockwise seen from outside; a triangle repeats its last one.
    pub corners: [Vec3; 4],
    /// Its shape.
    pub shape: Shape,
}

/// Request for derivatives of a segment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Derivatives {
    /// Values only.
    None,
    /// First derivatives.
    First,
}

/// Derivatives with which a segment is made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SegmentDerivatives {
    /// None.
    None,
    /// Derivatives of the normal and of the pressure, without those of `D`, which only friction
    /// needs.
    OfPressure,
    /// All.
    All,
}

impl From<Derivatives> for SegmentDerivatives {
    fn from(derivatives: Derivatives) -> Self {
        match derivatives {
            Derivatives::None => Self::None,
            Derivatives::First => Self::All,
        }
    }
}

/// The common polygon of two facets.
#[derive(Clone, Debug)]
pub struct Segment {
    /// `n`, outward of the first side.
    pub normal: Vec3,
    /// Area across `n`.
    pub area: f64,
    /// Hash of the corners and edges that the vertices of the polygon come from.
    pub topology: u64,
    /// `D_cd`, symmetric.
    pub mass: [[f64; 8]; 8],
    /// Derivatives, if requested.
    pub slopes: Option<Box<Slopes>>,
    /// Common polygon; `None` against a plane, where it is the whole facet.
    polygon: Option<Box<Polygon>>,
    /// Share of it that counts, if not all.
    faded: Option<Box<Faded>>,
}

/// A common polygon and the facets that it is of.
#[derive(Clone, Debug)]
struct Polygon {
    pair: PlanePair,
    vertices: Vec<Vertex>,
}

impl Segment {
    /// Integrals of pressure over the segment of this facet of the first side.
    pub(crate) fn pressed(&self, facet: &Facet, pressing: &Pressing) -> Pressed {
        let mass = self.faded.as_ref().map_or(&self.mass, |faded| &faded.whole);
        let slopes = self.slopes.as_deref();
        let whole = match &self.polygon {
            Some(polygon) => polygon.pressed(pressing, mass, slopes),
            None => pressed_on_plane(facet, &self.normal, pressing, mass, slopes),
        };
        match &self.faded {
            Some(faded) => faded.pressed(whole),
            None => whole,
        }
    }

    /// Interpolation functions at the vertices of the polygon; none against a plane.
    pub(crate) fn at_vertices(&self) -> Option<Vec<[f64; 8]>> {
        let polygon = self.polygon.as_ref()?;
        let vertices = polygon.vertices.iter();
        let shares = |vertex: &Vertex| support::shares(&polygon.pair.facets, &vertex.place);
        Some(vertices.map(shares).collect())
    }
}

/// Derivatives of a segment by the corners of both facets.
#[derive(Clone, Debug)]
pub struct Slopes {
    /// `dn/dx_c`.
    pub normal: [Matrix3<f64>; 8],
    /// `dD_cd/dx`, row [`pair_index`]`(c, d)`, column `3 k + i` for `x_k . e_i`; empty unless all
    /// derivatives are requested.
    pub mass: Vec<[f64; 24]>,
}

/// Row of `D_cd` in the upper triangle, packed row by row.
pub fn pair_index(c: usize, d: usize) -> usize {
    let (c, d) = (c.min(d), c.max(d));
    c * (15 - c) / 2 + d
}

/// `c <= d` of a row of [`pair_index`].
fn of_pair(row: usize) -> (usize, usize) {
    let starts = |c: &usize| pair_index(*c, *c) <= row;
    let c = (0..8).take_while(starts).last().unwrap_or(0);
    (c, c + row - pair_index(c, c))
}

/// The normal of two facets with these compliances; `None` where they have none.
pub(crate) fn normal_between(a: &Facet, b: &Facet, compliance: [f64; 2]) -> Option<Vec3> {
    let (n_a, n_b) = (facet_normal(a)?, facet_normal(b)?);
    pair_normal([&n_a, &n_b], compliance)
}

/// The segment of two facets with these compliances.
///
/// `None` as in [`segment_facing`], up to the cosine [`FACING`].
pub fn segment(
    a: &Facet,
    b: &Facet,
    compliance: [f64; 2],
    derivatives: impl Into<SegmentDerivatives>,
) -> Option<Segment> {
    segment_facing([a, b], FACING, compliance, derivatives)
}

/// The segment of two facets that oppose each other up to a cosine of their normals, to which
/// it fades.
///
/// `None` where they do not face each other, have no common area (thinner
/// than a corner's tolerance counts as none), where neither side has a compliance, or where
/// a facet is not convex seen along `n` ([`NOT_CONVEX`]), so that its map has no inverse.
pub fn segment_facing(
    [a, b]: [&Facet; 2],
    limit: f64,
    compliance: [f64; 2],
    derivatives: impl Into<SegmentDerivatives>,
) -> Option<Segment> {
    let derivatives = derivatives.into();
    let (n_a, n_b) = (facet_normal(a)?, facet_normal(b)?);
    let facing = Facing::of(n_a.dot(&n_b), limit)?;
    let normal = pair_normal([&n_a, &n_b], compliance)?;
    let pair = PlanePair::new([a, b], normal)?;
    let polygon = pair.polygon()?;
    let (mass, plane_slopes) = pair.integrals(&polygon, derivatives);
    let mut slopes = (derivatives != SegmentDerivatives::None).then(|| {
        let normal = pair_slopes([a, b], [&n_a, &n_b], compliance);
        let mass = plane_slopes.map_or_else(Vec::new, |in_plane| {
            let by_pair = in_plane.in_space(&pair.plane, &pair.corners, &normal, None);
            let mut mass = vec![[0.0; 24]; PAIRS];
            for (pair, row) in by_pair.iter().enumerate() {
                let (c, d) = functions(pair);
                mass[pair_index(c, d)] = *row;
            }
            mass
        });
        Box::new(Slopes { normal, mass })
    });
    let (mut area, mut mass) = (0.5 * twice_area(&polygon), symmetric(&mass));
    let faded = match facing {
        Facing::Whole => None,
        Facing::Part(share, by_cosine) => {
            let normals = [(n_b, facet_slopes(a, &n_a)), (n_a, facet_slopes(b, &n_b))];
            let integrals = (&mut area, &mut mass);
            let slopes = slopes.as_deref_mut();
            Some(Box::new(Faded::new(
                (share, by_cosine),
                &normals,
                integrals,
                slopes,
            )))
        }
    };
    Some(Segment {
        normal,
        area,
        topology: topology(&polygon),
        mass,
        slopes,
        faded,
        polygon: Some(Box::new(Polygon {
            pair,
            vertices: polygon,
        })),
    })
}

fn symmetric(packed: &[f64; PAIRS]) -> [[f64; 8]; 8] {
    let mut mass = [[0.0; 8]; 8];
    for (pair, value) in packed.iter().enumerate() {
        let (c, d) = functions(pair);
        (mass[c][d], mass[d][c]) = (*value, *value);
    }
    mass
}

/// Two facets seen along their normal.
#[derive(Clone, Debug)]
struct PlanePair {
    plane: Plane,
    corners: [Vec3; 8],
    places: [Vec2; 8],
    facets: [PlaneFacet; 2],
    tolerance: f64,
}

impl PlanePair {
    /// `None` if one is not convex, or faces the wrong way.
    fn new(facets: [&Facet; 2], normal: Vec3) -> Option<Self> {
        let corners: [Vec3; 8] = std::array::from_fn(|c| facets[c / 4].corners[c % 4]);
        let plane = Plane::new(normal, corners[0]);
        let places = corners.each_ref().map(|x| plane.place(x));
        let seen = [0, 1].map(|side| {
            let own = std::array::from_fn(|c| places[4 * side + c]);
            PlaneFacet::new(facets[side].shape, &own)
        });
        let convex = seen.iter().all(|facet| facet.distortion() < NOT_CONVEX);
        let faces = seen[0].area() > 0.0 && seen[1].area() < 0.0;
        let smaller = seen[0].area().min(-seen[1].area());
        (convex && faces).then(|| Self {
            plane,
            corners,
            places,
            facets: seen,
            tolerance: ON_EDGE * smaller.sqrt(),
        })
    }

    fn outline(&self, side: usize) -> Outline {
        let count = match self.facets[side].shape {
            Shape::Triangle => 3,
            Shape::Quadrilateral => 4,
        };
        let corners: Vec<usize> = match side {
            0 => (0..count).collect(),
            _ => (0..count).rev().collect(),
        };
        let places = corners.iter().map(|c| self.places[4 * side + c]).collect();
        Outline { corners, places }
    }

    /// The common polygon; `None` if it is thinner than the tolerance.
    fn polygon(&self) -> Option<Vec<Vertex>> {
        let polygon = common(&self.outline(0), &self.outline(1), self.tolerance);
        if polygon.len() < 3 {
            return None;
        }
        let first = polygon[0].place;
        let reach = polygon.iter().map(|vertex| (vertex.place - first).norm());
        let longest = reach.fold(0.0, f64::max);
        (twice_area(&polygon) > 0.1 * self.tolerance * longest).then_some(polygon)
    }

    /// Points and triangles that integrate pressure: exactly between parallelograms.
    fn rule_of_pressure(&self) -> (&'static [rule::Point], Apex) {
        let [a, b] = self.facets.each_ref().map(PlaneFacet::distortion);
        match a.max(b) {
            distortion if distortion <= AFFINE => (&rule::DEGREE_6, Apex::Corner),
            distortion if distortion <= MILD => (&rule::DEGREE_6, Apex::Centre),
            _ => (&rule::DEGREE_8, Apex::Centre),
        }
    }

    fn integrals(
        &self,
        polygon: &[Vertex],
        derivatives: SegmentDerivatives,
    ) -> ([f64; PAIRS], Option<CornerSlopes<PAIRS>>) {
        let [a, b] = self.facets.each_ref().map(PlaneFacet::distortion);
        let distortion = a.max(b);
        let (rule, apex): (&[_], _) = if distortion <= AFFINE {
            (&rule::DEGREE_5, Apex::Corner)
        } else if distortion <= MILD {
            (&rule::DEGREE_6, Apex::Centre)
        } else {
            (&rule::DEGREE_8, Apex::Centre)
        };
        let fan = fan(polygon, apex);
        let mut mass = [0.0; PAIRS];
        let mut slopes = match derivatives {
            SegmentDerivatives::None | SegmentDerivatives::OfPressure => None,
            SegmentDerivatives::All => Some(PlaneSlopes::zero(fan.places.len())),
        };
        let sums = Sums {
            facets: &self.facets,
            fan: &fan,
            rule,
            mass: &mut mass,
            slopes: slopes.as_mut(),
        };
        pulp::Arch::new().dispatch(sums);
        let slopes = slopes.map(|own| {
            let corners = own.by_corners();
            CornerSlopes::new(corners, own.vertices, polygon, &fan, &self.places)
        });
        (mass, slopes)
    }
}

/// Sums over all triangles of a fan, made with the widest registers there are: the same to
/// the last bit.
struct Sums<'a> {
    facets: &'a [PlaneFacet; 2],
    fan: &'a Fan,
    rule: &'a [([f64; 3], f64)],
    mass: &'a mut [f64; PAIRS],
    slopes: Option<&'a mut PlaneSlopes>,
}

impl WithSimd for Sums<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(mut self, _: S) {
        for &indices in &self.fan.triangles {
            let places = indices.map(|at| self.fan.places[at]);
            let triangle = Triangle { places, indices };
            let slopes = self.slopes.as_deref_mut();
            add_triangle(self.facets, &triangle, self.rule, self.mass, slopes);
        }
    }
}
