//! The tetrahedron on `xi, eta, zeta >= 0`, `xi + eta + zeta <= 1`, with
//!
//! ```text
//! N_0 = 1 - xi - eta - zeta,   N_1 = xi,   N_2 = eta,   N_3 = zeta
//! ```
//!
//! and four points at `(5 - sqrt(5))/20` from three of the faces (Keast, Comput. Methods
//! Appl. Mech. Eng. 55 (1986) 339). They are exact to degree two, so that the mass is
//! consistent; gradients are constant.

use super::{CellShape, MAX_CORNERS, MAX_POINTS};
use crate::Vec3;

/// `(5 - sqrt(5))/20`.
const NEAR: f64 = 0.138_196_601_125_010_5;
/// `1 - 3 NEAR`.
const FAR: f64 = 0.585_410_196_624_968_5;
const WEIGHT: f64 = 1.0 / 24.0;

pub(super) static SHAPE: CellShape = CellShape {
    name: "tetrahedron",
    plural: "tetrahedra",
    corners: &[
        [0.0, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [0.0, 0.0, 1.0],
    ],
    faces: &[&[0, 2, 1], &[0, 1, 3], &[1, 2, 3], &[2, 0, 3]],
    faces_a_side: 1,
    trihedra: &[[0, 1, 2, 3], [1, 2, 0, 3], [2, 0, 1, 3], [3, 0, 2, 1]],
    regular: std::f64::consts::FRAC_1_SQRT_2,
    corner_jacobian: 1.0,
    points: &[
        ([NEAR, NEAR, NEAR], WEIGHT),
        ([FAR, NEAR, NEAR], WEIGHT),
        ([NEAR, FAR, NEAR], WEIGHT),
        ([NEAR, NEAR, FAR], WEIGHT),
    ],
    recovery: Some(recovery),
    vtk: 10,
    interpolation,
    gradients,
};

fn interpolation(at: &Vec3) -> [f64; MAX_CORNERS] {
    let mut values = [0.0; MAX_CORNERS];
    values[..4].copy_from_slice(&[1.0 - at.x - at.y - at.z, at.x, at.y, at.z]);
    values
}

fn gradients(_: &Vec3) -> [Vec3; MAX_CORNERS] {
    let mut gradients = [Vec3::zeros(); MAX_CORNERS];
    gradients[..4].copy_from_slice(&[Vec3::repeat(-1.0), Vec3::x(), Vec3::y(), Vec3::z()]);
    gradients
}

/// The mean of the values: stress is constant.
fn recovery(_: &Vec3) -> [f64; MAX_POINTS] {
    let mut shares = [0.0; MAX_POINTS];
    shares[..4].fill(0.25);
    shares
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_are_those_of_degree_two() {
        assert!((NEAR - (5.0 - 5f64.sqrt()) / 20.0).abs() < 1e-16);
        assert!((FAR + 3.0 * NEAR - 1.0).abs() < 1e-15);
        // int xi^2 = 1/60, int xi eta = 1/120.
        let sum = |f: fn([f64; 3]) -> f64| -> f64 {
            SHAPE
                .points
                .iter()
                .map(|(at, weight)| f(*at) * weight)
                .sum()
        };
        assert!((sum(|[x, _, _]| x * x) - 1.0 / 60.0).abs() < 1e-16);
        assert!((sum(|[x, y, _]| x * y) - 1.0 / 120.0).abs() < 1e-16);
    }
}
