//! Placement of a rigid side: `x = R X + s` for the point `X` of its reference configuration.

use nalgebra::{Matrix3, Vector3};
use serde::{Deserialize, Serialize};
use striae_mesh::Vec3;
use striae_surface::scalar::{Real, constant3};

/// A rigid motion from the reference configuration.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Placement {
    /// Rotation `R`.
    pub rotation: Matrix3<f64>,
    /// Shift `s`.
    pub shift: Vec3,
}

impl Placement {
    /// Initial placement.
    pub fn at_rest() -> Self {
        Self::shifted(Vec3::zeros())
    }

    /// Moved without turning.
    pub fn shifted(shift: Vec3) -> Self {
        Self {
            rotation: Matrix3::identity(),
            shift,
        }
    }

    /// Position of the point `X`.
    pub fn point(&self, reference: &Vec3) -> Vec3 {
        self.rotation * reference + self.shift
    }

    /// Image of the direction `V`.
    pub fn direction(&self, reference: &Vec3) -> Vec3 {
        self.rotation * reference
    }

    /// The point `X` that is at `x`.
    pub fn back(&self, x: &Vec3) -> Vec3 {
        self.rotation.tr_mul(&(x - self.shift))
    }

    /// Inverse map for numbers with derivatives.
    pub(crate) fn back_of<D: Real>(&self, x: &Vector3<D>) -> Vector3<D> {
        self.rotation
            .map(D::from)
            .tr_mul(&(x - constant3(&self.shift)))
    }

    /// Map of directions from the reference configuration, for numbers with derivatives.
    pub(crate) fn direction_of<D: Real>(&self, reference: &Vector3<D>) -> Vector3<D> {
        self.rotation.map(D::from) * reference
    }
}
