//! Parallel transport of tangent vectors by the smallest rotation between normals.
//!
//! The rotation that takes the unit vector `m` to the unit vector `n` along
//! their great circle is, without a singular branch short of `n = -m`,
//!
//! ```text
//! R = c I + [v]_x + v v^T/(1 + c),    v = m x n,    c = m . n
//! ```
//!
//! Jones & Papadopoulos (2006), eq. (56), rearranged.

use nalgebra::Vector3;

use crate::scalar::{Real, cross, dot, scaled};

/// `R(to, from) vector`: turns `vector` with the rotation that takes the unit
/// vector `from` to the unit vector `to`.
pub fn transported<D: Real>(vector: &Vector3<D>, from: &Vector3<D>, to: &Vector3<D>) -> Vector3<D> {
    let v = cross(from, to);
    let c = dot(from, to);
    let along = dot(&v, vector) / (c + 1.0);
    scaled(vector, c) + cross(&v, vector) + scaled(&v, along)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn takes_the_first_normal_to_the_second_and_keeps_lengths() {
        let from = Vector3::new(0.1, -0.3, 0.9_f64).normalize();
        let to = Vector3::new(-0.6, 0.5, 0.2_f64).normalize();
        let vector = Vector3::new(0.3, 2.0, -0.7);
        assert!((transported(&from, &from, &to) - to).norm() < 1e-15);
        let turned = transported(&vector, &from, &to);
        assert!((turned.norm() - vector.norm()).abs() < 1e-14);
        assert!((turned.dot(&to) - vector.dot(&from)).abs() < 1e-14);
        assert!((transported(&turned, &to, &from) - vector).norm() < 1e-14);
    }

    #[test]
    fn leaves_the_axis_of_rotation_alone() {
        let from = Vector3::new(1.0, 0.0, 0.0);
        let to = Vector3::new(0.6, 0.8, 0.0_f64);
        let axis = Vector3::new(0.0, 0.0, 1.0);
        assert!((transported(&axis, &from, &to) - axis).norm() < 1e-15);
    }
}
