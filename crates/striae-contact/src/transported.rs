//! Transport between two normals with its derivatives.

use nalgebra::{Matrix3, Vector3};
use num_dual::DualSVec64;
use striae_mesh::Vec3;
use striae_surface::transport::transported;

use crate::term::{gradient, variable3};

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
        type D = DualSVec64<9>;
        let turned: Vector3<D> =
            transported(&variable3(vector, 0), &variable3(from, 3), &variable3(n, 6));
        let gradients = [0, 1, 2].map(|axis: usize| gradient(&turned[axis]));
        let block = |lane: usize| Matrix3::from_fn(|row, column| gradients[row][lane + column]);
        Self {
            value: turned.map(|component| component.re),
            by_vector: block(0),
            by_from: block(3),
            by_n: block(6),
        }
    }
}
