//! The wedge: the triangle `xi, eta >= 0`, `xi + eta <= 1` times `[-1, 1]` in `zeta`, with
//!
//! ```text
//! N_a = L_a (1 - zeta)/2,   N_{a+3} = L_a (1 + zeta)/2,   L = (1 - xi - eta, xi, eta)
//! ```
//!
//! and three points of the triangle, exact to degree two, on two Gauss levels.

use super::{CellShape, MAX_CORNERS, MAX_POINTS};
use crate::Vec3;

/// `1/sqrt(3)`.
const G: f64 = 0.577_350_269_189_625_8;
const NEAR: f64 = 1.0 / 6.0;
const FAR: f64 = 2.0 / 3.0;
const WEIGHT: f64 = 1.0 / 6.0;

pub(super) static SHAPE: CellShape = CellShape {
    name: "wedge",
    plural: "wedges",
    corners: &[
        [0.0, 0.0, -1.0],
        [1.0, 0.0, -1.0],
        [0.0, 1.0, -1.0],
        [0.0, 0.0, 1.0],
        [1.0, 0.0, 1.0],
        [0.0, 1.0, 1.0],
    ],
    faces: &[
        &[0, 2, 1],
        &[3, 4, 5],
        &[0, 1, 4, 3],
        &[1, 2, 5, 4],
        &[2, 0, 3, 5],
    ],
    faces_a_side: 1,
    trihedra: &[
        [0, 1, 2, 3],
        [1, 2, 0, 4],
        [2, 0, 1, 5],
        [3, 5, 4, 0],
        [4, 3, 5, 1],
        [5, 4, 3, 2],
    ],
    // sin(60 degrees)
    regular: 0.866_025_403_784_438_6,
    corner_jacobian: 0.5,
    points: &[
        ([NEAR, NEAR, -G], WEIGHT),
        ([FAR, NEAR, -G], WEIGHT),
        ([NEAR, FAR, -G], WEIGHT),
        ([NEAR, NEAR, G], WEIGHT),
        ([FAR, NEAR, G], WEIGHT),
        ([NEAR, FAR, G], WEIGHT),
    ],
    recovery: Some(recovery),
    vtk: 13,
    interpolation,
    gradients,
};

fn interpolation(at: &Vec3) -> [f64; MAX_CORNERS] {
    let triangle = [1.0 - at.x - at.y, at.x, at.y];
    let mut values = [0.0; MAX_CORNERS];
    for a in 0..3 {
        values[a] = triangle[a] * (0.5 - 0.5 * at.z);
        values[a + 3] = triangle[a] * (0.5 + 0.5 * at.z);
    }
    values
}

fn gradients(at: &Vec3) -> [Vec3; MAX_CORNERS] {
    let triangle = [
        (1.0 - at.x - at.y, -1.0, -1.0),
        (at.x, 1.0, 0.0),
        (at.y, 0.0, 1.0),
    ];
    let mut gradients = [Vec3::zeros(); MAX_CORNERS];
    for (a, (value, along_xi, along_eta)) in triangle.into_iter().enumerate() {
        let (low, high) = (0.5 - 0.5 * at.z, 0.5 + 0.5 * at.z);
        gradients[a] = Vec3::new(along_xi * low, along_eta * low, -0.5 * value);
        gradients[a + 3] = Vec3::new(along_xi * high, along_eta * high, 0.5 * value);
    }
    gradients
}

/// The field linear in the triangle and along the axis through the values.
fn recovery(at: &Vec3) -> [f64; MAX_POINTS] {
    // Points of the triangle are halfway from its middle to the corners.
    let out = |s: f64| 2.0 * s - 1.0 / 3.0;
    let values = interpolation(&Vec3::new(out(at.x), out(at.y), at.z * 3f64.sqrt()));
    std::array::from_fn(|g| values[g])
}
