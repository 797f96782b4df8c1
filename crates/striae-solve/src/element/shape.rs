//! Trilinear shape functions on the cube `[-1, 1]^3` and its Gauss points.
//!
//! ```text
//! N_a(xi) = (1 + xi_a xi)(1 + eta_a eta)(1 + zeta_a zeta) / 8
//! ```
//!
//! Gauss point `g` lies towards corner `g`, at `1/sqrt(3)` of its coordinates,
//! with weight one.

use striae_mesh::Vec3;

/// Coordinates of the corners, numbered as VTK's hexahedron.
pub(super) const CORNERS: [[f64; 3]; 8] = [
    [-1.0, -1.0, -1.0],
    [1.0, -1.0, -1.0],
    [1.0, 1.0, -1.0],
    [-1.0, 1.0, -1.0],
    [-1.0, -1.0, 1.0],
    [1.0, -1.0, 1.0],
    [1.0, 1.0, 1.0],
    [-1.0, 1.0, 1.0],
];

/// Coordinates of Gauss point `g`.
pub(super) fn gauss_point(g: usize) -> Vec3 {
    Vec3::from(CORNERS[g]) / 3f64.sqrt()
}

/// Shape functions at a point.
pub(super) fn shape(at: &Vec3) -> [f64; 8] {
    CORNERS.map(|corner| (0..3).map(|j| 0.5 + 0.5 * corner[j] * at[j]).product())
}

/// Gradients of the shape functions with respect to the local coordinates.
pub(super) fn shape_gradients(at: &Vec3) -> [Vec3; 8] {
    CORNERS.map(|corner| {
        let factor = |j: usize| 0.5 + 0.5 * corner[j] * at[j];
        let slope = |j: usize| 0.5 * corner[j];
        Vec3::new(
            slope(0) * factor(1) * factor(2),
            factor(0) * slope(1) * factor(2),
            factor(0) * factor(1) * slope(2),
        )
    })
}
