//! Derivatives of integrals over the points of a polygon, in the plane of a pair.
//!
//! A point moves with the vertices of its triangle, its coordinates on the facets with their
//! corners, and the gap there with the heights of the corners, see [`super::sums`].

use super::{Polygon, Slopes, chain::CornerSlopes, fan::Fan, plane_facet::Vec2, sums::add};

/// Supports whose rows are integrated at once, beside the forces on the eight corners.
pub(super) const AT_ONCE: usize = 8;
/// Integrals at once.
pub(super) const M: usize = 8 + AT_ONCE;

/// Derivatives of `M` integrals in the plane of a pair.
pub(super) struct Moved {
    /// By the two coordinates of each corner, while the polygon rests.
    corners: Box<[[[f64; M]; 2]; 8]>,
    /// By the height of each corner.
    heights: Box<[[f64; M]; 8]>,
    /// By the two coordinates of each vertex and of the centre.
    vertices: Vec<[[f64; M]; 2]>,
}

/// Quantities that an integrand depends on at a point.
pub(super) struct Integrand {
    /// Its value.
    pub value: [f64; M],
    /// Derivative by the gap.
    pub by_gap: [f64; M],
    /// Gradient along an axis by the place on either side, at a constant gap.
    pub gradient: [[[f64; M]; 2]; 2],
    /// Gradient of the gap in the same order.
    pub of_gap: [[f64; 2]; 2],
}

/// A triangle of a fan under way: weights of its vertices.
pub(super) struct OnTriangle {
    own: [f64; M],
    by_vertex: [[[f64; M]; 2]; 3],
}

impl Moved {
    pub(super) fn zero(vertices: usize) -> Self {
        Self {
            corners: Box::new([[[0.0; M]; 2]; 8]),
            heights: Box::new([[0.0; M]; 8]),
            vertices: vec![[[0.0; M]; 2]; vertices],
        }
    }

    /// Adds a point with the functions `n` of the corners, `shares` of the vertices of its
    /// triangle and the weight `whole` of its area.
    #[inline(always)]
    pub(super) fn add_point(
        &mut self,
        on: &mut OnTriangle,
        integrand: &Integrand,
        n: &[f64; 8],
        (shares, whole): (&[f64; 3], f64),
    ) {
        for c in 0..8 {
            let sign = if c < 4 { -1.0 } else { 1.0 };
            add(&mut self.heights[c], whole * sign * n[c], &integrand.by_gap);
        }
        for axis in 0..2 {
            let mut total = [0.0; M];
            for side in 0..2 {
                let mut gradient = integrand.gradient[side][axis];
                let of_gap = integrand.of_gap[side][axis];
                add(&mut gradient, of_gap, &integrand.by_gap);
                for c in 4 * side..4 * side + 4 {
                    add(&mut self.corners[c][axis], -whole * n[c], &gradient);
                }
                add(&mut total, 1.0, &gradient);
            }
            for k in 0..3 {
                add(&mut on.by_vertex[k][axis], whole * shares[k], &total);
            }
        }
    }

    /// Adds what the vertices `v` of a triangle with these indices move.
    #[inline(always)]
    pub(super) fn add_triangle(&mut self, on: &OnTriangle, v: &[Vec2; 3], indices: &[usize; 3]) {
        for k in 0..3 {
            let opposite = (v[(k + 2) % 3] - v[(k + 1) % 3]) * 0.5;
            let by_area = [-opposite.y, opposite.x];
            let target = &mut self.vertices[indices[k]];
            for axis in 0..2 {
                add(&mut target[axis], 1.0, &on.by_vertex[k][axis]);
                add(&mut target[axis], by_area[axis], &on.own);
            }
        }
    }
}

impl Integrand {
    #[inline(always)]
    pub(super) fn zero() -> Self {
        Self {
            value: [0.0; M],
            by_gap: [0.0; M],
            gradient: [[[0.0; M]; 2]; 2],
            of_gap: [[0.0; 2]; 2],
        }
    }
}

impl OnTriangle {
    /// Sum of the integrands over the area of the triangle.
    #[inline(always)]
    pub(super) fn own(&self) -> &[f64; M] {
        &self.own
    }

    #[inline(always)]
    pub(super) fn add_value(&mut self, weight: f64, integrand: &Integrand) {
        add(&mut self.own, weight, &integrand.value);
    }

    pub(super) fn new() -> Self {
        Self {
            own: [0.0; M],
            by_vertex: [[[0.0; M]; 2]; 3],
        }
    }
}

impl Polygon {
    /// Derivatives by the corners in space.
    pub(super) fn in_space(&self, moved: Moved, fan: &Fan, known: &Slopes) -> [[f64; 24]; M] {
        let (pair, polygon) = (&self.pair, &self.vertices);
        let Moved {
            corners,
            heights,
            vertices,
        } = moved;
        let own = CornerSlopes::new(corners, vertices, polygon, fan, &pair.places);
        let by_height = Some(&*heights);
        own.in_space(&pair.plane, &pair.corners, &known.normal, by_height)
    }
}
