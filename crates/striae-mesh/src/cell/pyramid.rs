//! The pyramid over the square `[-1, 1]^2` with its apex at `(0, 0, 1)`. With
//! `u = 1 - zeta`,
//!
//! ```text
//! N_a = (u + xi_a xi)(u + eta_a eta) / (4 u),   a = 0..3,      N_4 = zeta
//! ```
//!
//! (Bedrosian, Int. J. Numer. Methods Eng. 35 (1992) 95): linear on the triangles,
//! bilinear on the base. With `(xi, eta) = u (r, s)` every field is linear in `u` and in
//! `1, r, s, r s`, and volumes have the factor `u^2`: the rule has 2 x 2 Gauss points in
//! `r, s` and two points of Gauss and Jacobi with the weight `u^2` in `u`, the roots of
//! `u^2 - 4/3 u + 2/5`.

use super::{CellShape, MAX_CORNERS, MAX_POINTS};
use crate::Vec3;

/// `1/sqrt(3)`.
const G: f64 = 0.577_350_269_189_625_8;
/// `2/3 - sqrt(2/45)` and `2/3 + sqrt(2/45)`.
const ROOTS: [f64; 2] = [0.455_848_155_988_775, 0.877_485_177_344_558_3];
/// `1/6 -+ sqrt(45/2)/72`.
const WEIGHTS: [f64; 2] = [0.100_785_882_079_825_43, 0.232_547_451_253_507_9];

const fn point(r: f64, s: f64, level: usize) -> ([f64; 3], f64) {
    let u = ROOTS[level];
    ([u * r, u * s, 1.0 - u], WEIGHTS[level])
}

pub(super) static SHAPE: CellShape = CellShape {
    name: "pyramid",
    plural: "pyramids",
    corners: &CORNERS,
    faces: &[
        &[0, 3, 2, 1],
        &[0, 1, 4],
        &[1, 2, 4],
        &[2, 3, 4],
        &[3, 0, 4],
    ],
    faces_a_side: 1,
    trihedra: &[
        [0, 1, 3, 4],
        [1, 2, 0, 4],
        [2, 3, 1, 4],
        [3, 0, 2, 4],
        [4, 1, 0, 3],
        [4, 2, 1, 0],
        [4, 3, 2, 1],
        [4, 0, 3, 2],
    ],
    regular: std::f64::consts::FRAC_1_SQRT_2,
    corner_jacobian: 0.25,
    points: &[
        point(-G, -G, 1),
        point(G, -G, 1),
        point(G, G, 1),
        point(-G, G, 1),
        point(-G, -G, 0),
        point(G, -G, 0),
        point(G, G, 0),
        point(-G, G, 0),
    ],
    recovery: Some(recovery),
    vtk: 14,
    interpolation,
    gradients,
};

const CORNERS: [[f64; 3]; 5] = [
    [-1.0, -1.0, 0.0],
    [1.0, -1.0, 0.0],
    [1.0, 1.0, 0.0],
    [-1.0, 1.0, 0.0],
    [0.0, 0.0, 1.0],
];

/// The functions; at the apex their limit on the axis.
fn interpolation(at: &Vec3) -> [f64; MAX_CORNERS] {
    let u = 1.0 - at.z;
    let mut values = [0.0; MAX_CORNERS];
    values[4] = at.z;
    for (value, [x, y, _]) in values.iter_mut().zip(&CORNERS[..4]) {
        if u != 0.0 {
            *value = (u + x * at.x) * (u + y * at.y) / (4.0 * u);
        }
    }
    values
}

/// The gradients; not finite at the apex, where they have no limit.
fn gradients(at: &Vec3) -> [Vec3; MAX_CORNERS] {
    let u = 1.0 - at.z;
    let mut gradients = [Vec3::zeros(); MAX_CORNERS];
    gradients[4] = Vec3::z();
    for (gradient, [x, y, _]) in gradients.iter_mut().zip(&CORNERS[..4]) {
        let (p, q) = (u + x * at.x, u + y * at.y);
        // d(p q / u)/du = (p + q)/u - p q/u^2, and du = -dzeta.
        *gradient = Vec3::new(x * q, y * p, p * q / u - p - q) / (4.0 * u);
    }
    gradients
}

/// The linear field closest to the values.
fn recovery(at: &Vec3) -> [f64; MAX_POINTS] {
    let point = |g: usize| Vec3::from(SHAPE.points[g].0);
    let middle = (0..8).map(point).sum::<Vec3>() / 8.0;
    // The points are symmetric: moments about their middle are diagonal.
    let from_middle = |g: usize| point(g) - middle;
    let squares: Vec3 = (0..8)
        .map(|g| from_middle(g).component_mul(&from_middle(g)))
        .sum();
    let out = at - middle;
    std::array::from_fn(|g| 0.125 + out.component_div(&squares).dot(&from_middle(g)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn levels_integrate_up_to_the_fifth_power() {
        for power in 0..4 {
            let sum: f64 = (0..2).map(|at| WEIGHTS[at] * ROOTS[at].powi(power)).sum();
            assert!((sum - 1.0 / f64::from(power + 3)).abs() < 1e-15, "{sum}");
        }
    }
}
