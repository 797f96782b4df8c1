//! The two unit vectors of a texture at a point.

use nalgebra::Vector3;

use crate::scalar::{Real, cross, dot, normalised, scaled};

/// Tangential parts below this fraction of a unit direction count as none.
const VANISHING: f64 = 1e-6;

/// Texture at a point: orthonormal vectors in the tangent plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Axes<D> {
    /// Along the grooves or the row of scales.
    pub s: Vector3<D>,
    /// Across it, `a = n x s`; for scales from root to free edge.
    pub a: Vector3<D>,
}

impl<D: Real> Axes<D> {
    /// Axes whose `s` is the normalised tangential part of `direction`.
    ///
    /// `direction` is of the order of one; `None` where its tangential part
    /// vanishes. `normal` is a unit vector.
    pub fn along(direction: Vector3<D>, normal: Vector3<D>) -> Option<Self> {
        let tangent = tangential(direction, normal);
        // Written so that a vector that is not a number vanishes too.
        (dot(&tangent, &tangent).re() > VANISHING * VANISHING).then(|| {
            let s = normalised(&tangent);
            let a = cross(&normal, &s);
            Self { s, a }
        })
    }
}

/// `(I - n n) v`.
pub(super) fn tangential<D: Real>(vector: Vector3<D>, normal: Vector3<D>) -> Vector3<D> {
    vector - scaled(&normal, dot(&normal, &vector))
}
