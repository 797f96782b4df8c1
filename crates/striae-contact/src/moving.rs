//! Integrals over a covered triangle and how they change with the facet.
//!
//! In the plane of the facet with corners `P_c` a quadrature point of the triangle
//! `v_k` lies at `sum b_k v_k = sum N_c(xi, eta) P_c`, and its weight is
//!
//! ```text
//! w = share area/delta,   delta = x_,xi x x_,eta,   x = sum N_c P_c
//! d(xi, eta) = [x_,xi x_,eta]^-1 (sum b_k dv_k - sum N_c dP_c)
//! dw = share/delta darea - w/delta (dx_,xi x x_,eta + x_,xi x dx_,eta)
//! ```
//!
//! so what depends on points and weights depends on 14 coordinates in the plane. Their
//! own derivatives come in once a triangle.

use nalgebra::{Matrix2, Vector2};
use num_dual::{Derivative, DualSVec64};
use striae_surface::facet::{Shape, Weights};

use crate::{
    clip::{located, real},
    quadrature::collapsed_triangle,
};

/// A quadrature point of a covered triangle.
pub struct MovingPoint {
    /// Facet coordinates.
    pub xi: f64,
    /// Facet coordinates.
    pub eta: f64,
    /// Weight to integrate over `d xi d eta`.
    pub weight: f64,
    barycentric: [f64; 3],
    share: f64,
    inverse: Matrix2<f64>,
    weights: Weights<f64>,
    d_xi: Vector2<f64>,
    d_eta: Vector2<f64>,
    twist: Vector2<f64>,
}

/// A point in the plane of a facet with its derivatives by the corners of two facets.
type Place<const N: usize> = Vector2<DualSVec64<N>>;

/// Quadrature points of a triangle of the facet with these corners.
pub fn moving_points<const N: usize>(
    corners: &[Place<N>; 4],
    triangle: &[Place<N>; 3],
) -> impl Iterator<Item = MovingPoint> {
    let facet = corners.each_ref().map(real);
    let vertices = triangle.each_ref().map(real);
    let area = 0.5 * (vertices[1] - vertices[0]).perp(&(vertices[2] - vertices[0]));
    let sum =
        move |weights: &[f64; 4]| -> Vector2<f64> { (0..4).map(|c| facet[c] * weights[c]).sum() };
    collapsed_triangle()
        .into_iter()
        .filter_map(move |([r, s], share)| {
            let barycentric = [1.0 - r - s, r, s];
            let target = (0..3).map(|k| vertices[k] * barycentric[k]).sum();
            let ([xi, eta], inverse) = located(Shape::Quadrilateral, &facet, &target)?;
            let weights = Shape::Quadrilateral.weights(xi, eta);
            let (d_xi, d_eta) = (sum(&weights.d_xi), sum(&weights.d_eta));
            Some(MovingPoint {
                xi,
                eta,
                weight: share * area / d_xi.perp(&d_eta),
                barycentric,
                share,
                inverse,
                weights,
                d_xi,
                d_eta,
                twist: (facet[0] - facet[1] + facet[2] - facet[3]) * 0.25,
            })
        })
}

/// Derivatives of `R` integrals by coordinates in the plane of the facet.
pub struct FlatSlopes<const R: usize> {
    /// By the corners of the facet, two each.
    facet: [[f64; R]; 8],
    /// By the vertices of the triangle, two each.
    vertices: [[f64; R]; 6],
    /// By the area of the triangle.
    area: [f64; R],
}

impl<const R: usize> FlatSlopes<R> {
    /// No dependence yet.
    pub fn zero() -> Self {
        Self {
            facet: [[0.0; R]; 8],
            vertices: [[0.0; R]; 6],
            area: [0.0; R],
        }
    }

    /// Adds the derivatives of terms that depend on the coordinates and the weight of a
    /// point like `by_xi`, `by_eta` and `by_weight`.
    pub fn add(&mut self, point: &MovingPoint, [by_xi, by_eta, by_weight]: [&[f64; R]; 3]) {
        let MovingPoint {
            inverse,
            weights,
            d_xi,
            d_eta,
            twist,
            ..
        } = point;
        let delta = d_xi.perp(d_eta);
        let loss = -point.weight / delta;
        let (loss_xi, loss_eta) = (loss * d_xi.perp(twist), loss * twist.perp(d_eta));
        let mut by_place = [[0.0; R]; 2];
        for row in 0..R {
            let xi = by_xi[row] + loss_xi * by_weight[row];
            let eta = by_eta[row] + loss_eta * by_weight[row];
            for axis in 0..2 {
                by_place[axis][row] = xi * inverse[(0, axis)] + eta * inverse[(1, axis)];
            }
            self.area[row] += by_weight[row] * (point.share / delta);
        }
        for (k, share) in point.barycentric.iter().enumerate() {
            for axis in 0..2 {
                for row in 0..R {
                    self.vertices[2 * k + axis][row] += share * by_place[axis][row];
                }
            }
        }
        for corner in 0..4 {
            let turned = (d_eta * weights.d_xi[corner] - d_xi * weights.d_eta[corner]) * loss;
            for (axis, by_delta) in [turned.y, -turned.x].into_iter().enumerate() {
                let share = -weights.value[corner];
                for row in 0..R {
                    self.facet[2 * corner + axis][row] +=
                        share * by_place[axis][row] + by_delta * by_weight[row];
                }
            }
        }
    }

    /// The derivatives by the `N` lanes that the corners of the facet and the vertices
    /// of the triangle depend on.
    pub fn chained<const N: usize>(
        mut self,
        corners: &[Place<N>; 4],
        vertices: &[Place<N>; 3],
    ) -> [[f64; R]; N] {
        for k in 0..3 {
            let [next, last] = [1, 2].map(|step| real(&vertices[(k + step) % 3]));
            let opposite = (last - next) * 0.5;
            for (axis, by_area) in [-opposite.y, opposite.x].into_iter().enumerate() {
                for row in 0..R {
                    self.vertices[2 * k + axis][row] += by_area * self.area[row];
                }
            }
        }
        let mut slopes = [[0.0; R]; N];
        let coordinates = corners.iter().chain(vertices).flatten();
        for (coordinate, by_rows) in coordinates.zip(self.facet.iter().chain(&self.vertices)) {
            let Derivative(Some(gradient)) = &coordinate.eps else {
                continue;
            };
            for (slope, by_lane) in slopes.iter_mut().zip(gradient.iter()) {
                for row in 0..R {
                    slope[row] += by_rows[row] * by_lane;
                }
            }
        }
        slopes
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        clip::{FlatFacet, covered_points},
        term::{gradient, variables3},
    };
    use num_dual::DualNum;
    use striae_mesh::Vec3;

    type D = DualSVec64<24>;

    fn integrands<T: DualNum<Primitive = f64> + Copy>(xi: T, eta: T) -> [T; 2] {
        [(xi * 0.7 + eta * eta).exp(), xi * eta + 1.0]
    }

    #[test]
    fn integrals_change_as_with_dual_numbers() {
        let facet = [
            [0.0, 0.0, 0.0],
            [1.0, 0.1, 0.1],
            [1.3, 1.2, 0.0],
            [-0.1, 0.9, 0.2],
        ];
        let cover = [
            [0.3, 1.6, 0.1],
            [1.7, 1.0, 0.1],
            [0.9, 0.2, 0.0],
            [0.2, 0.3, 0.1],
        ];
        let facet = variables3::<24>(&facet.map(Vec3::from), 0);
        let cover = variables3::<24>(&cover.map(Vec3::from), 12);
        let mut exact = [D::from_re(0.0); 2];
        for point in covered_points(Shape::Quadrilateral, &facet, &cover) {
            let values = integrands(point.xi, point.eta);
            (0..2).for_each(|row| exact[row] += values[row] * point.weight);
        }
        let flat_facet = FlatFacet::new(Shape::Quadrilateral, &facet);
        let triangles = flat_facet.covered(&cover);
        assert!(triangles.len() > 1);
        let mut sums = [0.0; 2];
        let mut slopes = [[0.0; 2]; 24];
        for triangle in &triangles {
            let mut flat = FlatSlopes::zero();
            for point in moving_points(&flat_facet.corners, triangle) {
                type Two = DualSVec64<2>;
                let values = integrands(
                    Two::from_re(point.xi).derivative(0),
                    Two::from_re(point.eta).derivative(1),
                );
                let by = |lane: usize| values.map(|value| gradient(&value)[lane] * point.weight);
                flat.add(&point, [&by(0), &by(1), &values.map(|value| value.re)]);
                (0..2).for_each(|row| sums[row] += values[row].re * point.weight);
            }
            for (sum, slope) in slopes
                .iter_mut()
                .zip(flat.chained(&flat_facet.corners, triangle))
            {
                (0..2).for_each(|row| sum[row] += slope[row]);
            }
        }
        for row in 0..2 {
            assert!((sums[row] - exact[row].re).abs() < 1e-14);
            for (lane, slope) in gradient(&exact[row]).into_iter().enumerate() {
                let own = slopes[lane][row];
                assert!(
                    (own - slope).abs() < 1e-13,
                    "row {row}, lane {lane}: {own}, not {slope}"
                );
            }
        }
    }
}
