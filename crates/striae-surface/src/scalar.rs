//! Scalars and vectors that kernels are generic over.
//!
//! A kernel written for [`Real`] runs on `f64` and on the dual numbers of
//! `num-dual`, which carry exact first derivatives along.

use nalgebra::Vector3;
use num_dual::DualNum;

/// A real number, with or without derivatives.
pub trait Real: DualNum<Primitive = f64> + Copy {}

impl<T: DualNum<Primitive = f64> + Copy> Real for T {}

/// The constant `value`.
pub fn constant<D: Real>(value: f64) -> D {
    D::from(value)
}

/// The constant vector `value`.
pub fn constant3<D: Real>(value: &Vector3<f64>) -> Vector3<D> {
    value.map(D::from)
}

/// `u . v`.
pub fn dot<D: Real>(u: &Vector3<D>, v: &Vector3<D>) -> D {
    u.x * v.x + u.y * v.y + u.z * v.z
}

/// `u x v`.
pub fn cross<D: Real>(u: &Vector3<D>, v: &Vector3<D>) -> Vector3<D> {
    Vector3::new(
        u.y * v.z - u.z * v.y,
        u.z * v.x - u.x * v.z,
        u.x * v.y - u.y * v.x,
    )
}

/// `a v`.
pub fn scaled<D: Real>(v: &Vector3<D>, a: D) -> Vector3<D> {
    Vector3::new(v.x * a, v.y * a, v.z * a)
}

/// `|v|`; the derivative does not exist at zero.
pub fn norm<D: Real>(v: &Vector3<D>) -> D {
    dot(v, v).sqrt()
}

/// `v/|v|`.
pub fn normalised<D: Real>(v: &Vector3<D>) -> Vector3<D> {
    scaled(v, norm(v).recip())
}

/// `sum_J weight_J v_J`.
pub fn combination<D: Real>(weights: &[D; 4], vectors: &[Vector3<D>; 4]) -> Vector3<D> {
    let mut sum = scaled(&vectors[0], weights[0]);
    for corner in 1..4 {
        sum += scaled(&vectors[corner], weights[corner]);
    }
    sum
}
