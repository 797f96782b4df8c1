//! Interpolation on one facet of three or four corners.
//!
//! Quadrilaterals use bilinear functions on `[-1, 1]^2`, triangles linear ones
//! on `xi, eta >= 0, xi + eta <= 1`. A triangle repeats its last corner in the
//! list of four; the repeated corner has weight zero.

use nalgebra::Vector3;
use striae_mesh::Vec3;

use crate::scalar::{Real, combination, constant, cross};

/// Shape of a facet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// Three corners.
    Triangle,
    /// Four corners.
    Quadrilateral,
}

/// Interpolation functions and their derivatives at a point of a facet.
#[derive(Clone, Copy, Debug)]
pub struct Weights<D> {
    /// `N_J`.
    pub value: [D; 4],
    /// `dN_J/dxi`.
    pub d_xi: [D; 4],
    /// `dN_J/deta`.
    pub d_eta: [D; 4],
}

impl Shape {
    /// The shape of a facet with these corners.
    pub fn of<T: PartialEq>(corners: &[T; 4]) -> Self {
        if corners[2] == corners[3] {
            Shape::Triangle
        } else {
            Shape::Quadrilateral
        }
    }

    /// Coordinates of the centre.
    pub fn centre(self) -> [f64; 2] {
        match self {
            Shape::Triangle => [1.0 / 3.0; 2],
            Shape::Quadrilateral => [0.0; 2],
        }
    }

    /// Coordinates of the corner in place `at`; of the first one for `None`.
    pub fn corner(self, at: Option<usize>) -> [f64; 2] {
        let corners = match self {
            Shape::Triangle => [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [0.0, 1.0]],
            Shape::Quadrilateral => [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]],
        };
        corners[at.unwrap_or(0)]
    }

    /// Distance of the point outside the facet in its own coordinates; negative inside.
    pub fn excess(self, xi: f64, eta: f64) -> f64 {
        match self {
            Shape::Triangle => (-xi).max(-eta).max(xi + eta - 1.0),
            Shape::Quadrilateral => xi.abs().max(eta.abs()) - 1.0,
        }
    }

    /// Interpolation functions at `(xi, eta)`.
    pub fn weights<D: Real>(self, xi: D, eta: D) -> Weights<D> {
        let (zero, one) = (constant::<D>(0.0), constant::<D>(1.0));
        match self {
            Shape::Triangle => Weights {
                value: [-xi - eta + 1.0, xi, eta, zero],
                d_xi: [-one, one, zero, zero],
                d_eta: [-one, zero, one, zero],
            },
            Shape::Quadrilateral => {
                let (xm, xp) = ((-xi + 1.0) * 0.5, (xi + 1.0) * 0.5);
                let (em, ep) = ((-eta + 1.0) * 0.5, (eta + 1.0) * 0.5);
                Weights {
                    value: [xm * em, xp * em, xp * ep, xm * ep],
                    d_xi: [em * -0.5, em * 0.5, ep * 0.5, ep * -0.5],
                    d_eta: [xm * -0.5, xp * -0.5, xp * 0.5, xm * 0.5],
                }
            }
        }
    }
}

/// `x_,xi x x_,eta`: normal to the facet with the length of the area element.
pub fn area_vector<D: Real>(weights: &Weights<D>, corners: &[Vector3<D>; 4]) -> Vector3<D> {
    cross(
        &combination(&weights.d_xi, corners),
        &combination(&weights.d_eta, corners),
    )
}

/// Unit normal of a facet of three or four corners, from its diagonals.
pub fn facet_normal(corners: &[Vec3; 4]) -> Vec3 {
    let [along, across] = [corners[2] - corners[0], corners[3] - corners[1]];
    along.cross(&across).normalize()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn weights_are_a_partition_of_unity_with_consistent_derivatives() {
        for shape in [Shape::Triangle, Shape::Quadrilateral] {
            let (xi, eta, step) = (0.21, 0.34, 1e-6);
            let at = shape.weights::<f64>(xi, eta);
            assert!((at.value.iter().sum::<f64>() - 1.0).abs() < 1e-15);
            let next = shape.weights::<f64>(xi + step, eta + 2.0 * step);
            for corner in 0..4 {
                let change = next.value[corner] - at.value[corner];
                let expected = step * (at.d_xi[corner] + 2.0 * at.d_eta[corner]);
                assert!((change - expected).abs() < 1e-11);
            }
        }
    }
}
