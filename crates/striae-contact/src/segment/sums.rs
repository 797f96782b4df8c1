//! Sums over the points of a common polygon and their derivatives in its plane.
//!
//! With `grad N_c` the gradient in the plane, a point `y` and corners `Y_k` move
//!
//! ```text
//! dN_c = grad N_c . (dy - sum_k N_k dY_k)        k over the corners of the side of c
//! dy = sum_m b_m dv_m,   dw = w d(area)/area      v_m: vertices of the triangle
//! ```
//!
//! The 36 pairs `c <= d` are kept in three runs: both of `a`, one of each, both of
//! `b`. A corner of `a` moves the first two, a corner of `b` the last two.

use super::plane_facet::{PlaneFacet, PlaneWeights, Vec2};

/// Number of pairs `c <= d` of eight functions.
pub(super) const PAIRS: usize = 36;
/// Start of the pairs of one function of each side.
const MIXED: usize = 10;
/// Start of the pairs of two functions of side `b`.
const LAST: usize = 26;

/// A number for each pair of functions.
pub(super) type ByPair = [f64; PAIRS];

/// Pairs of functions of one side.
const OWN: [(usize, usize); 10] = [
    (0, 0),
    (0, 1),
    (0, 2),
    (0, 3),
    (1, 1),
    (1, 2),
    (1, 3),
    (2, 2),
    (2, 3),
    (3, 3),
];

/// The functions `c <= d`, 0..8, of a pair.
pub(super) fn functions(pair: usize) -> (usize, usize) {
    if pair < MIXED {
        OWN[pair]
    } else if pair < LAST {
        ((pair - MIXED) / 4, 4 + (pair - MIXED) % 4)
    } else {
        let (c, d) = OWN[pair - LAST];
        (4 + c, 4 + d)
    }
}

/// Number of pairs with a function of a given side.
const TOUCHED: usize = LAST;

/// A number for each pair that has a function of a given side: the first or the last
/// of all pairs.
type ByOwn = [f64; TOUCHED];

/// Derivatives of all pairs by coordinates in the plane.
pub(super) struct PlaneSlopes {
    /// By the two coordinates of each of the eight corners, through coordinates on facets.
    own: [[[ByOwn; 2]; 4]; 2],
    /// By the two coordinates of each vertex of the polygon and of its centre.
    pub vertices: Vec<[ByPair; 2]>,
}

impl PlaneSlopes {
    /// No dependence yet on this many vertices.
    pub fn zero(vertices: usize) -> Self {
        Self {
            own: [[[[0.0; TOUCHED]; 2]; 4]; 2],
            vertices: vec![[[0.0; PAIRS]; 2]; vertices],
        }
    }

    /// By the coordinates of each corner, while the polygon rests.
    pub fn by_corners(&self) -> Box<[[ByPair; 2]; 8]> {
        let mut corners = Box::new([[[0.0; PAIRS]; 2]; 8]);
        for side in 0..2 {
            for k in 0..4 {
                for axis in 0..2 {
                    let target = &mut corners[4 * side + k][axis][MIXED * side..][..TOUCHED];
                    target.copy_from_slice(&self.own[side][k][axis]);
                }
            }
        }
        corners
    }
}

/// A triangle of the polygon: the places of its vertices and their indices.
pub(super) struct Triangle {
    /// Counter-clockwise.
    pub places: [Vec2; 3],
    /// Indices among the vertices of the polygon.
    pub indices: [usize; 3],
}

/// Adds the integrals over a triangle of all `N_c N_d`, and derivatives if requested.
#[inline(always)]
pub(super) fn add_triangle(
    facets: &[PlaneFacet; 2],
    triangle: &Triangle,
    rule: &[([f64; 3], f64)],
    mass: &mut ByPair,
    mut slopes: Option<&mut PlaneSlopes>,
) {
    let v = &triangle.places;
    let area = 0.5 * (v[1] - v[0]).perp(&(v[2] - v[0]));
    let mut own = [0.0; PAIRS];
    let mut by_vertex = [[[0.0; PAIRS]; 2]; 3];
    for (shares, weight) in rule {
        let place = v[0] * shares[0] + v[1] * shares[1] + v[2] * shares[2];
        let [a, b] = [facets[0].at(&place), facets[1].at(&place)];
        add(&mut own, *weight, &products(&a.value, &b.value));
        let weight = weight * area;
        let Some(slopes) = &mut slopes else { continue };
        for axis in 0..2 {
            let gradients = gradients([&a, &b], axis);
            for side in 0..2 {
                for k in 0..4 {
                    let factor = -weight * [&a, &b][side].value[k];
                    add(&mut slopes.own[side][k][axis], factor, &gradients[side]);
                }
            }
            let total = total(&gradients);
            for k in 0..3 {
                add(&mut by_vertex[k][axis], weight * shares[k], &total);
            }
        }
    }
    add(mass, area, &own);
    let Some(slopes) = slopes else { return };
    for k in 0..3 {
        let opposite = (v[(k + 2) % 3] - v[(k + 1) % 3]) * 0.5;
        let by_area = [-opposite.y, opposite.x];
        let target = &mut slopes.vertices[triangle.indices[k]];
        for axis in 0..2 {
            add(&mut target[axis], 1.0, &by_vertex[k][axis]);
            add(&mut target[axis], by_area[axis], &own);
        }
    }
}

/// `sum += factor terms`.
#[inline(always)]
pub(super) fn add<const N: usize>(sum: &mut [f64; N], factor: f64, terms: &[f64; N]) {
    for at in 0..N {
        sum[at] += factor * terms[at];
    }
}

/// `N_c N_d` of all pairs.
#[inline(always)]
fn products(a: &[f64; 4], b: &[f64; 4]) -> ByPair {
    let mut products = [0.0; PAIRS];
    for (pair, (c, d)) in OWN.into_iter().enumerate() {
        products[pair] = a[c] * a[d];
        products[LAST + pair] = b[c] * b[d];
    }
    for c in 0..4 {
        for d in 0..4 {
            products[MIXED + 4 * c + d] = a[c] * b[d];
        }
    }
    products
}

/// Derivatives of `N_c N_d` along an axis by the place on side `a` and by that on `b`.
#[inline(always)]
fn gradients([a, b]: [&PlaneWeights; 2], axis: usize) -> [ByOwn; 2] {
    let (grad_a, grad_b) = (&a.gradient[axis], &b.gradient[axis]);
    let mut gradients = [[0.0; TOUCHED]; 2];
    for (pair, (c, d)) in OWN.into_iter().enumerate() {
        gradients[0][pair] = grad_a[c] * a.value[d] + a.value[c] * grad_a[d];
        gradients[1][LAST - MIXED + pair] = grad_b[c] * b.value[d] + b.value[c] * grad_b[d];
    }
    for c in 0..4 {
        for d in 0..4 {
            gradients[0][MIXED + 4 * c + d] = grad_a[c] * b.value[d];
            gradients[1][4 * c + d] = a.value[c] * grad_b[d];
        }
    }
    gradients
}

/// The sum of both, for all pairs.
#[inline(always)]
fn total(gradients: &[ByOwn; 2]) -> ByPair {
    std::array::from_fn(|pair| {
        let first = if pair < LAST { gradients[0][pair] } else { 0.0 };
        let second = if pair < MIXED {
            0.0
        } else {
            gradients[1][pair - MIXED]
        };
        first + second
    })
}
