//! Vectors and scalars with their derivatives by the unknowns of a pair.

use nalgebra::Matrix3;
use striae_mesh::Vec3;

use crate::unknown::{Gradient, Jacobian};

/// A vector with its derivatives by the unknowns.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Tracked {
    /// The vector.
    pub value: Vec3,
    /// Its derivatives.
    pub jacobian: Jacobian,
}

/// A scalar with its derivatives by the unknowns.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TrackedScalar {
    /// The scalar.
    pub value: f64,
    /// Its derivatives.
    pub gradient: Gradient,
}

/// Adds `by v`, `v` an intermediate vector, to a Jacobian; the order of its entries is free.
pub fn add_chained(jacobian: &mut Jacobian, by: &Matrix3<f64>, inner: &Jacobian) {
    for (first, block) in inner {
        match jacobian.iter_mut().find(|entry| entry.0 == *first) {
            Some((_, sum)) => *sum += by * block,
            None => jacobian.push((*first, by * block)),
        }
    }
}

/// Adds to a gradient by a triple.
pub fn add_slope(gradient: &mut Gradient, first: u32, slope: Vec3) {
    match gradient.iter_mut().find(|entry| entry.0 == first) {
        Some((_, sum)) => *sum += slope,
        None => gradient.push((first, slope)),
    }
}
