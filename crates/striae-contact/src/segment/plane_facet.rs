//! A facet seen along the normal of a pair: a plane bilinear map and its inverse.
//!
//! ```text
//! y = o + A xi + B eta + C xi eta,     J = y_,xi x y_,eta = J0 (1 + xi A x C/J0 + eta C x B/J0)
//! ```
//!
//! For `y - o = r` elimination of `xi` or `eta` leaves two quadratics whose
//! discriminant is `J^2` at the solution (u x v is a scalar in the plane):
//!
//! ```text
//! eta = 2 A x r/(A x B - C x r + J),   xi = -2 B x r/(A x B + C x r + J),
//! J = sign(J0) sqrt((A x B - C x r)^2 - 4 (B x C)(A x r))
//! ```

use nalgebra::Vector2;
use striae_surface::facet::Shape;

/// A vector or point in the plane of a pair.
pub(super) type Vec2 = Vector2<f64>;

/// A facet in the plane of a pair.
#[derive(Clone, Copy, Debug)]
pub(super) struct PlaneFacet {
    /// Its shape.
    pub shape: Shape,
    origin: Vec2,
    by_xi: Vec2,
    by_eta: Vec2,
    twist: Vec2,
    jacobian: f64,
}

/// The interpolation functions at a point of the plane.
pub(super) struct PlaneWeights {
    /// `N_c`.
    pub value: [f64; 4],
    /// `dN_c/dy_i`, by axis.
    pub gradient: [[f64; 4]; 2],
}

impl PlaneFacet {
    /// The facet with these corners in the plane.
    pub fn new(shape: Shape, y: &[Vec2; 4]) -> Self {
        let [origin, by_xi, by_eta, twist] = match shape {
            Shape::Triangle => [y[0], y[1] - y[0], y[2] - y[0], Vec2::zeros()],
            Shape::Quadrilateral => [
                (y[0] + y[1] + y[2] + y[3]) * 0.25,
                (y[1] + y[2] - y[0] - y[3]) * 0.25,
                (y[2] + y[3] - y[0] - y[1]) * 0.25,
                (y[0] - y[1] + y[2] - y[3]) * 0.25,
            ],
        };
        Self {
            shape,
            origin,
            by_xi,
            by_eta,
            twist,
            jacobian: by_xi.perp(&by_eta),
        }
    }

    /// Its area, negative where the corners run clockwise.
    pub fn area(&self) -> f64 {
        match self.shape {
            Shape::Triangle => 0.5 * self.jacobian,
            Shape::Quadrilateral => 4.0 * self.jacobian,
        }
    }

    /// Largest relative departure of `J` from its mean: 0 for a triangle or a
    /// parallelogram, less than 1 where the facet is convex.
    pub fn distortion(&self) -> f64 {
        let changes = self.by_xi.perp(&self.twist).abs() + self.twist.perp(&self.by_eta).abs();
        changes / self.jacobian.abs()
    }

    /// Interpolation functions and gradients at the point `y`.
    #[inline(always)]
    pub fn at(&self, y: &Vec2) -> PlaneWeights {
        let r = y - self.origin;
        let (a, b, c) = (&self.by_xi, &self.by_eta, &self.twist);
        let (across_a, across_b, across_c) = (a.perp(&r), b.perp(&r), c.perp(&r));
        let root = {
            let linear = self.jacobian - across_c;
            let square = linear * linear - 4.0 * b.perp(c) * across_a;
            square.max(0.0).sqrt().copysign(self.jacobian)
        };
        let eta = 2.0 * across_a / (self.jacobian - across_c + root);
        let xi = -2.0 * across_b / (self.jacobian + across_c + root);
        let (y_xi, y_eta) = (a + c * eta, b + c * xi);
        let inverse = 1.0 / root;
        let grad_xi = [y_eta.y * inverse, -y_eta.x * inverse];
        let grad_eta = [-y_xi.y * inverse, y_xi.x * inverse];
        let weights = self.shape.weights(xi, eta);
        PlaneWeights {
            value: weights.value,
            gradient: std::array::from_fn(|axis| {
                std::array::from_fn(|corner| {
                    weights.d_xi[corner] * grad_xi[axis] + weights.d_eta[corner] * grad_eta[axis]
                })
            }),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_inverse_map_returns_to_the_point_and_gradients_are_those_of_position() {
        let y = [[0.0, 0.0], [1.0, 0.1], [1.7, 1.2], [-0.1, 0.9]].map(Vec2::from);
        for (shape, corners) in [
            (Shape::Quadrilateral, y),
            (Shape::Quadrilateral, [y[3], y[2], y[1], y[0]]),
            (Shape::Triangle, [y[0], y[1], y[2], y[2]]),
        ] {
            let facet = PlaneFacet::new(shape, &corners);
            assert!(facet.distortion() < 1.0);
            for target in [[0.1, 0.1], [0.6, 0.5], [1.4, 1.0], [-0.05, 0.8]].map(Vec2::from) {
                let weights = facet.at(&target);
                let place: Vec2 = (0..4).map(|c| corners[c] * weights.value[c]).sum();
                assert!((place - target).norm() < 1e-15);
                for (row, gradient) in weights.gradient.iter().enumerate() {
                    let sum: Vec2 = (0..4).map(|c| corners[c] * gradient[c]).sum();
                    let unit = Vec2::from_fn(|i, _| f64::from(u8::from(i == row)));
                    assert!((sum - unit).norm() < 1e-14);
                }
            }
        }
    }
}
