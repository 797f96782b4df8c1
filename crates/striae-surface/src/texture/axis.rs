//! Axes in space.

use nalgebra::Vector3;
use serde::Serialize;
use striae_declared::Values;
use striae_mesh::Vec3;

use super::axes::tangential;
use crate::scalar::{Real, constant3, cross, dot, normalised};

/// An axis in space.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Axis {
    /// A point of it.
    pub point: Vec3,
    /// Its direction, of any length.
    pub direction: Vec3,
}

impl Axis {
    /// Returns the axis that values of [`Parameter::axis`](striae_declared::Parameter::axis) state.
    pub fn stated(values: &Values, name: &str) -> Self {
        let axis = values.table(name);
        Self {
            point: axis.array("point").into(),
            direction: axis.array("direction").into(),
        }
    }

    /// Returns the values that state the axis.
    pub(super) fn values(&self) -> Values {
        let [point, direction]: [[f64; 3]; 2] = [self.point, self.direction].map(Into::into);
        let values = Values::default().with("point", point);
        values.with("direction", direction)
    }

    /// Unit vector along the axis.
    pub fn along<D: Real>(&self) -> Vector3<D> {
        unit(constant3(&self.direction))
    }

    /// Vector around the axis at a point, by the right-hand rule: the sine of the angle between
    /// the axis and the line from its point long.
    pub fn around<D: Real>(&self, point: Vector3<D>) -> Vector3<D> {
        cross(&self.along(), &self.towards(point))
    }

    /// Vector away from the axis at a point, as long as that around it.
    pub fn away<D: Real>(&self, point: Vector3<D>) -> Vector3<D> {
        tangential(self.towards(point), self.along())
    }

    fn towards<D: Real>(&self, point: Vector3<D>) -> Vector3<D> {
        unit(point - constant3(&self.point))
    }
}

/// The vector at unit length; zero stays zero.
pub(super) fn unit<D: Real>(vector: Vector3<D>) -> Vector3<D> {
    if dot(&vector, &vector).re() > 0.0 {
        normalised(&vector)
    } else {
        vector
    }
}
