//! The part of a facet that an opposing facet covers.
//!
//! Both are projected on the plane of the facet's mean normal, where the facet
//! is clipped by the edges of the opposing one (Sutherland & Hodgman, Commun.
//! ACM 17, 1974) and the rest is cut into triangles. Everything is
//! generic over dual numbers, so quadrature points and weights carry their
//! derivatives by the corners of both facets.

use nalgebra::{Matrix2, Vector2, Vector3};
use striae_surface::{
    facet::{Shape, area_vector},
    scalar::{Real, combination, cross, dot, normalised, scaled},
};

use crate::quadrature::collapsed_triangle;

/// A quadrature point on a facet.
#[derive(Clone, Copy, Debug)]
pub struct QuadraturePoint<D> {
    /// Facet coordinates.
    pub xi: D,
    /// Facet coordinates.
    pub eta: D,
    /// Weight to integrate over `d xi d eta`: the share of the parameter area.
    pub weight: D,
}

/// A facet in the plane of its mean normal.
#[derive(Clone, Debug)]
pub struct FlatFacet<D> {
    origin: Vector3<D>,
    axes: [Vector3<D>; 2],
    shape: Shape,
    /// Its corners.
    pub corners: [Vector2<D>; 4],
}

impl<D: Real> FlatFacet<D> {
    /// The facet of this shape with these corners.
    pub fn new(shape: Shape, facet: &[Vector3<D>; 4]) -> Self {
        let [xi, eta] = shape.centre().map(D::from);
        let centre = shape.weights(xi, eta);
        let origin = combination(&centre.value, facet);
        let m = normalised(&area_vector(&centre, facet));
        let edge = facet[1] - facet[0];
        let e1 = normalised(&(edge - scaled(&m, dot(&edge, &m))));
        let axes = [e1, cross(&m, &e1)];
        Self {
            corners: facet.each_ref().map(|x| flat(x, &origin, &axes)),
            origin,
            axes,
            shape,
        }
    }

    /// Triangles that make up what the convex polygon `cover` of three or four
    /// corners, facing the facet, covers.
    pub fn covered(&self, cover: &[Vector3<D>]) -> Vec<[Vector2<D>; 3]> {
        // The covering polygon faces this facet, so its corners go round the other way.
        let window = cover.iter().rev();
        let window: Vec<_> = window.map(|x| flat(x, &self.origin, &self.axes)).collect();
        let count = match self.shape {
            Shape::Triangle => 3,
            Shape::Quadrilateral => 4,
        };
        triangles(clipped(&self.corners[..count], &window))
    }
}

fn flat<D: Real>(x: &Vector3<D>, origin: &Vector3<D>, axes: &[Vector3<D>; 2]) -> Vector2<D> {
    let r = x - origin;
    Vector2::new(dot(&r, &axes[0]), dot(&r, &axes[1]))
}

/// Quadrature points on the covered part. Where many quantities are integrated with
/// derivatives by many lanes, [`moving`](crate::moving) is the faster way.
pub fn covered_points<D: Real>(
    shape: Shape,
    facet: &[Vector3<D>; 4],
    cover: &[Vector3<D>],
) -> Vec<QuadraturePoint<D>> {
    let flat = FlatFacet::new(shape, facet);
    let corners = &flat.corners;
    let mut points = Vec::new();
    for [first, second, third] in &flat.covered(cover) {
        let (u, v) = (second - first, third - first);
        let area = perpendicular(&u, &v) * 0.5;
        for ([r, s], share) in collapsed_triangle() {
            let target = first + u * D::from(r) + v * D::from(s);
            let Some([xi, eta]) = coordinates(shape, corners, &target) else {
                continue;
            };
            let weights = shape.weights(xi, eta);
            let [by_xi, by_eta] = [&weights.d_xi, &weights.d_eta].map(|slopes| {
                let terms = slopes
                    .iter()
                    .zip(corners)
                    .map(|(&slope, corner)| corner * slope);
                terms.fold(Vector2::zeros(), |sum, term| sum + term)
            });
            points.push(QuadraturePoint {
                xi,
                eta,
                weight: area * share / perpendicular(&by_xi, &by_eta),
            });
        }
    }
    points
}

/// Sine of the turn at a corner below which it counts as flat.
const FLAT: f64 = 1e-3;

/// Triangles of a convex polygon: a fan, after flat corners have been cut off.
///
/// If a side of the facet nearly runs along an edge of the window, their crossing is a flat corner
/// that moves along them without bound. Cut off alone, its triangle vanishes as fast as it moves;
/// as the end of a diagonal it would multiply the error of quadrature by its speed.
fn triangles<D: Real>(mut polygon: Vec<Vector2<D>>) -> Vec<[Vector2<D>; 3]> {
    let mut triangles = Vec::with_capacity(polygon.len());
    let mut at = 0;
    while polygon.len() > 3 && at < polygon.len() {
        let count = polygon.len();
        let [before, after] = [count - 1, 1].map(|step| polygon[(at + step) % count]);
        if is_flat(&before, &polygon[at], &after) {
            triangles.push([before, polygon.remove(at), after]);
            at = 0;
        } else {
            at += 1;
        }
    }
    triangles.extend((2..polygon.len()).map(|at| [polygon[0], polygon[at - 1], polygon[at]]));
    triangles
}

fn is_flat<D: Real>(before: &Vector2<D>, tip: &Vector2<D>, after: &Vector2<D>) -> bool {
    let (u, v) = (real(tip) - real(before), real(after) - real(tip));
    let lengths = u.norm() * v.norm();
    u.perp(&v).abs() <= FLAT * lengths && u.dot(&v) > 0.0
}

/// Without derivatives.
pub(crate) fn real<D: Real>(v: &Vector2<D>) -> Vector2<f64> {
    Vector2::new(v.x.re(), v.y.re())
}

/// `u x v`.
pub(crate) fn perpendicular<D: Real>(u: &Vector2<D>, v: &Vector2<D>) -> D {
    u.x * v.y - u.y * v.x
}

/// Change of the distance from an edge of the window, over its length, below
/// which a side runs along it and is not cut: the place of the crossing would be
/// round-off, and either end is as good.
const ALONG: f64 = 1e-10;

/// The part of the convex polygon `subject` inside the convex polygon `window`,
/// both counter-clockwise.
fn clipped<D: Real>(subject: &[Vector2<D>], window: &[Vector2<D>]) -> Vec<Vector2<D>> {
    let mut polygon = subject.to_vec();
    for (at, start) in window.iter().enumerate() {
        let edge = window[(at + 1) % window.len()] - start;
        let signed = |p: &Vector2<D>| perpendicular(&edge, &(p - start));
        let along = ALONG * real(&edge).norm_squared();
        let distance = |p: &Vector2<D>| real(&edge).perp(&(real(p) - real(start)));
        let distances: Vec<f64> = polygon.iter().map(distance).collect();
        let mut inside = Vec::with_capacity(polygon.len() + 1);
        for (index, point) in polygon.iter().enumerate() {
            let after = (index + 1) % polygon.len();
            let next = &polygon[after];
            let [d, d_next] = [distances[index], distances[after]];
            if d >= 0.0 {
                inside.push(*point);
            }
            let crosses = (d >= 0.0) != (d_next >= 0.0);
            // A side that runs along the edge crosses it nowhere in particular; the quotient below
            // would be round-off.
            if crosses && (d - d_next).abs() > along {
                let (d, d_next) = (signed(point), signed(next));
                let share = d / (d - d_next);
                inside.push(point + (next - point) * share);
            }
        }
        polygon = inside;
    }
    polygon
}

/// Coordinates of a point of a plane facet.
fn coordinates<D: Real>(
    shape: Shape,
    corners: &[Vector2<D>; 4],
    target: &Vector2<D>,
) -> Option<[D; 2]> {
    let ([xi, eta], inverse) = located(shape, &corners.each_ref().map(real), &real(target))?;
    let weights = shape.weights(xi, eta).value;
    let mut residual = -*target;
    for corner in 0..4 {
        residual += corners[corner] * D::from(weights[corner]);
    }
    Some([0, 1].map(|row| {
        // One Newton step in dual numbers at the converged real place adds the derivatives of the
        // implicit function.
        let change = residual.x * inverse[(row, 0)] + residual.y * inverse[(row, 1)];
        -change + [xi, eta][row]
    }))
}

/// Coordinates of a point of a plane facet and their derivatives by its place.
pub(crate) fn located(
    shape: Shape,
    corners: &[Vector2<f64>; 4],
    goal: &Vector2<f64>,
) -> Option<([f64; 2], Matrix2<f64>)> {
    let at = |xi: f64, eta: f64| {
        let w = shape.weights(xi, eta);
        let sum =
            |weights: &[f64; 4]| -> Vector2<f64> { (0..4).map(|c| corners[c] * weights[c]).sum() };
        let jacobian = Matrix2::from_columns(&[sum(&w.d_xi), sum(&w.d_eta)]);
        (sum(&w.value) - goal, jacobian)
    };
    let [mut xi, mut eta] = shape.centre();
    for _ in 0..20 {
        let (residual, jacobian) = at(xi, eta);
        let step = jacobian.try_inverse()? * residual;
        xi -= step.x;
        eta -= step.y;
        // Quadratic convergence: a step of this size leaves an error below round-off.
        if step.amax() < 1e-14 {
            break;
        }
    }
    Some(([xi, eta], at(xi, eta).1.try_inverse()?))
}

#[cfg(test)]
mod tests {
    use super::*;
    use num_dual::{Dual64, DualNum};
    use striae_surface::scalar::constant3;

    type V = Vector3<f64>;

    fn area(facet: &[V; 4], cover: &[V]) -> f64 {
        covered_points(Shape::Quadrilateral, facet, cover)
            .iter()
            .map(|point| {
                let weights = Shape::Quadrilateral.weights(point.xi, point.eta);
                point.weight * area_vector(&weights, facet).norm()
            })
            .sum()
    }

    fn irregular() -> [V; 4] {
        [
            V::new(0.0, 0.0, 0.0),
            V::new(1.0, 0.1, 0.0),
            V::new(1.3, 1.2, 0.0),
            V::new(-0.1, 0.9, 0.0),
        ]
    }

    #[test]
    fn parts_of_a_distorted_facet_add_up() {
        let facet = irregular();
        let half = |low: f64, high: f64| {
            let at = |x: f64, y: f64| V::new(x, y, 0.01);
            area(
                &facet,
                &[at(low, 5.0), at(high, 5.0), at(high, -5.0), at(low, -5.0)],
            )
        };
        let whole = half(-5.0, 5.0);
        let exact = 0.5 * (facet[2] - facet[0]).cross(&(facet[3] - facet[1])).norm();
        assert!((whole - exact).abs() < 1e-14);
        assert!((half(-5.0, 0.4) + half(0.4, 0.7) + half(0.7, 5.0) - whole).abs() < 1e-14);
        assert_eq!(half(2.0, 5.0), 0.0);
    }

    #[test]
    fn the_area_is_continuous_where_outlines_nearly_coincide() {
        let facet = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        let facet = facet.map(|[x, y]| V::new(x, y, 0.0));
        for shift in (5..16).map(|digits| 10_f64.powi(-digits)) {
            for [left, right] in [[-1.0, -1.0], [-0.5, -2.0], [-2.0, 0.5], [0.9, -1.1]] {
                let top = |x: f64| 1.0 + shift * (left + (right - left) * x);
                let at = |x: f64, y: f64| V::new(x, y, 0.0);
                let cover = |from: f64, to: f64| {
                    let corners = [at(from, top(from)), at(to, top(to)), at(to, -1.0)];
                    area(
                        &facet,
                        &[corners[0], corners[1], corners[2], at(from, -1.0)],
                    )
                };
                let parts = cover(-1.0, 0.3) + cover(0.3, 0.6) + cover(0.6, 2.0);
                assert!(
                    (parts - 1.0).abs() <= 2.0 * shift + 1e-12,
                    "{shift}: {parts}"
                );
            }
        }
    }

    #[test]
    fn the_rate_of_the_integral_is_bounded_where_edges_nearly_coincide() {
        let facet = irregular().map(|x| constant3::<Dual64>(&x));
        let [start, end] = [irregular()[3], irregular()[2]];
        for lean in (3..9).map(|digits| 10_f64.powi(-digits)) {
            // Its upper edge leans on that of the facet and moves out and in.
            let across = V::new(-(end - start).y, (end - start).x, 0.0);
            let at = |along: f64, offset: f64| {
                let x = start + (end - start) * along + across * offset;
                let mut x: Vector3<Dual64> = constant3(&x);
                x.x += Dual64::new(0.0, across.x);
                x.y += Dual64::new(0.0, across.y);
                x
            };
            let cover = |from: f64, to: f64| {
                let tilt = |along: f64| lean * (along - 0.37);
                let corners = [
                    at(from, tilt(from)),
                    at(to, tilt(to)),
                    at(to, -2.0),
                    at(from, -2.0),
                ];
                let points = covered_points(Shape::Quadrilateral, &facet, &corners).into_iter();
                points.fold(Dual64::new(0.0, 0.0), |sum, point| {
                    sum + point.weight * ((point.eta * point.eta + 1.0) * point.xi * 0.3).exp()
                })
            };
            let whole = cover(-1.0, 2.0);
            let parts = cover(-1.0, 0.6) + cover(0.6, 2.0);
            assert!(
                (whole.re - parts.re).abs() < 1e-4,
                "{lean}: {whole} {parts}"
            );
            assert!(
                (whole.eps - parts.eps).abs() < 1e-2,
                "{lean}: {whole} {parts}"
            );
            assert!(whole.eps.abs() < 10.0, "{lean}: {whole}");
        }
    }

    #[test]
    fn triangles_share_out_a_quadrilateral() {
        let [a, b, c, d] = [[0.0, 0.0], [1.0, 0.1], [1.3, 1.2], [-0.1, 0.9]]
            .map(|[x, y]| V::new(x, y, 0.2 * x - 0.1 * y));
        let at = |x: f64, y: f64| V::new(x, y, 0.0);
        let cover = [at(0.2, 1.5), at(1.4, 0.6), at(0.4, -0.3), at(-0.2, 0.3)];
        // Area, and moments of it by the interpolated place.
        let sums = |shape: Shape, facet: [V; 4]| {
            let points = covered_points(shape, &facet, &cover).into_iter();
            let parts = points.map(|point| {
                let weights = shape.weights(point.xi, point.eta);
                let share = point.weight * area_vector(&weights, &facet).norm();
                (combination(&weights.value, &facet) * share).push(share)
            });
            parts.sum::<nalgebra::Vector4<f64>>()
        };
        let whole = sums(Shape::Quadrilateral, [a, b, c, d]);
        let halves = [[a, b, c, c], [a, c, d, d]].map(|half| sums(Shape::Triangle, half));
        assert!((halves[0] + halves[1] - whole).norm() < 1e-14, "{whole}");
        assert!(halves.iter().all(|half| half.w > 0.1));
    }

    #[test]
    fn coordinates_lie_on_the_facet_and_first_moments_are_exact() {
        let facet = irregular();
        let at = |x: f64, y: f64| V::new(x, y, 0.0);
        let cover = [at(0.2, 0.8), at(0.7, 0.8), at(0.7, 0.3)];
        let mut moment = V::zeros();
        for point in covered_points(Shape::Quadrilateral, &facet, &cover) {
            let weights = Shape::Quadrilateral.weights(point.xi, point.eta);
            let x = combination(&weights.value, &facet);
            moment += x * point.weight * area_vector(&weights, &facet).norm();
        }
        let exact = (cover[0] + cover[1] + cover[2]) / 3.0 * 0.125;
        assert!((moment - exact).norm() < 1e-14);
    }
}
