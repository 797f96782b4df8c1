//! Transport between two normals with its derivatives.
//!
//! With `w = m x n` and `c = m . n` the turned vector and its derivatives are
//!
//! ```text
//! u = c v + w x v + (w . v)/(1 + c) w
//! du = R dv + (-[v]_x + ((w . v) I + w v^T)/(1 + c)) dw + (v - (w . v)/(1 + c)^2 w) dc
//! dw = [m]_x dn - [n]_x dm,   dc = m . dn + n . dm
//! ```

use nalgebra::Matrix3;
use striae_mesh::Vec3;

/// `R(n, m) v` with its derivatives by `v`, `m` and `n`.
pub struct Transported {
    /// `R(n, m) v`.
    pub value: Vec3,
    /// Derivative by `v`, which is `R`.
    pub by_vector: Matrix3<f64>,
    /// Derivative by `m`.
    pub by_from: Matrix3<f64>,
    /// Derivative by `n`.
    pub by_n: Matrix3<f64>,
}

impl Transported {
    /// Turns `vector` from the normal `from` to the normal `n`.
    pub fn new(vector: &Vec3, from: &Vec3, n: &Vec3) -> Self {
        let (w, c) = (from.cross(n), from.dot(n));
        let share = 1.0 / (1.0 + c);
        let along = w.dot(vector) * share;
        let scaled = w * share;
        let by_w = Matrix3::from_diagonal_element(along) + scaled * vector.transpose()
            - vector.cross_matrix();
        let by_c = vector - scaled * along;
        Self {
            value: vector * c + w.cross(vector) + w * along,
            by_vector: Matrix3::from_diagonal_element(c)
                + w.cross_matrix()
                + w * scaled.transpose(),
            by_from: by_c * n.transpose() - by_w * n.cross_matrix(),
            by_n: by_c * from.transpose() + by_w * from.cross_matrix(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::term::{parts, variable3};
    use nalgebra::Vector3;
    use num_dual::DualSVec64;
    use striae_surface::transport::transported;

    #[test]
    fn derivatives_are_those_of_dual_numbers() {
        let from = Vec3::new(0.2, -0.3, 0.9).normalize();
        let n = Vec3::new(-0.4, 0.1, 0.8).normalize();
        let vector = Vec3::new(0.7, -1.1, 0.4);
        let turned = Transported::new(&vector, &from, &n);
        let dual: Vector3<DualSVec64<9>> = transported(
            &variable3(&vector, 0),
            &variable3(&from, 3),
            &variable3(&n, 6),
        );
        let (value, gradient) = parts(&dual);
        assert!((turned.value - value).norm() < 1e-15);
        for (lane, block) in [(0, turned.by_vector), (3, turned.by_from), (6, turned.by_n)] {
            let exact = Matrix3::from_fn(|row, column| gradient[lane + column][row]);
            assert!((block - exact).norm() < 1e-15, "lanes from {lane}: {block}");
        }
    }
}
