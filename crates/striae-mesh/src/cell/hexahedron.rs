//! The hexahedron on `[-1, 1]^3`, with
//!
//! ```text
//! N_a(xi) = (1 + xi_a xi)(1 + eta_a eta)(1 + zeta_a zeta) / 8
//! ```
//!
//! and 2 x 2 x 2 Gauss points; point `g` lies towards corner `g`, at `1/sqrt(3)` of its
//! coordinates, with weight one.

use super::{CellShape, MAX_CORNERS, MAX_POINTS};
use crate::Vec3;

/// `1/sqrt(3)`.
const G: f64 = 0.577_350_269_189_625_8;

pub(super) static SHAPE: CellShape = CellShape {
    name: "hexahedron",
    plural: "hexahedra",
    corners: &CORNERS,
    // Bottom, top, -eta, +xi, +eta, -xi.
    faces: &[
        &[0, 3, 2, 1],
        &[4, 5, 6, 7],
        &[0, 1, 5, 4],
        &[1, 2, 6, 5],
        &[2, 3, 7, 6],
        &[3, 0, 4, 7],
    ],
    faces_a_side: 1,
    trihedra: &[
        [0, 1, 3, 4],
        [1, 2, 0, 5],
        [2, 3, 1, 6],
        [3, 0, 2, 7],
        [4, 7, 5, 0],
        [5, 4, 6, 1],
        [6, 5, 7, 2],
        [7, 6, 4, 3],
    ],
    regular: 1.0,
    corner_jacobian: 0.125,
    points: &[
        ([-G, -G, -G], 1.0),
        ([G, -G, -G], 1.0),
        ([G, G, -G], 1.0),
        ([-G, G, -G], 1.0),
        ([-G, -G, G], 1.0),
        ([G, -G, G], 1.0),
        ([G, G, G], 1.0),
        ([-G, G, G], 1.0),
    ],
    recovery: Some(recovery),
    vtk: 12,
    interpolation,
    gradients,
};

const CORNERS: [[f64; 3]; 8] = [
    [-1.0, -1.0, -1.0],
    [1.0, -1.0, -1.0],
    [1.0, 1.0, -1.0],
    [-1.0, 1.0, -1.0],
    [-1.0, -1.0, 1.0],
    [1.0, -1.0, 1.0],
    [1.0, 1.0, 1.0],
    [-1.0, 1.0, 1.0],
];

fn interpolation(at: &Vec3) -> [f64; MAX_CORNERS] {
    let mut values = [0.0; MAX_CORNERS];
    for (value, corner) in values.iter_mut().zip(CORNERS) {
        *value = (0..3).map(|j| 0.5 + 0.5 * corner[j] * at[j]).product();
    }
    values
}

fn gradients(at: &Vec3) -> [Vec3; MAX_CORNERS] {
    let mut gradients = [Vec3::zeros(); MAX_CORNERS];
    for (gradient, corner) in gradients.iter_mut().zip(CORNERS) {
        let factor = |j: usize| 0.5 + 0.5 * corner[j] * at[j];
        let slope = |j: usize| 0.5 * corner[j];
        *gradient = Vec3::new(
            slope(0) * factor(1) * factor(2),
            factor(0) * slope(1) * factor(2),
            factor(0) * factor(1) * slope(2),
        );
    }
    gradients
}

/// The trilinear field through the values.
fn recovery(at: &Vec3) -> [f64; MAX_POINTS] {
    let values = interpolation(&(at * 3f64.sqrt()));
    std::array::from_fn(|g| values[g])
}

#[cfg(test)]
mod tests {
    #[test]
    fn gauss_points_are_those_of_two_points_an_axis() {
        assert_eq!(super::G, 1.0 / 3f64.sqrt());
    }
}
