//! Directions of fibres as fields in space at rest.
//!
//! About an axis through the point `o` with the unit direction `d`, and `r` the part of `X - o`
//! across it,
//!
//! ```text
//! axial            cos(t) d - sin(t) d x e       e = r/|r|
//! circumferential  cos(t) d x e + sin(t) d
//! radial           e
//! ```
//!
//! turned by the angle `t` about `e`, counter-clockwise seen from outside. On the axis, where
//! there is no `e`, any direction across it is taken.

use nalgebra::Vector3;
use serde::Serialize;

/// Direction of a family of fibres at rest.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub enum Direction {
    /// One direction everywhere, of any length.
    Uniform(Vector3<f64>),
    /// About an axis.
    About {
        /// A point of the axis.
        point: Vector3<f64>,
        /// Its direction, of any length.
        axis: Vector3<f64>,
        /// Kind of lines.
        lines: LinesAbout,
    },
}

/// Directions about an axis; angles in radians.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub enum LinesAbout {
    /// Along it, turned about the radius.
    Axial {
        /// The angle.
        turn: f64,
    },
    /// Around it, turned about the radius.
    Circumferential {
        /// The angle.
        turn: f64,
    },
    /// Away from it.
    Radial,
}

impl Direction {
    /// The unit direction at a place of the body at rest.
    pub fn at(&self, place: &Vector3<f64>) -> Vector3<f64> {
        match self {
            Self::Uniform(direction) => direction.normalize(),
            Self::About { point, axis, lines } => {
                let d = axis.normalize();
                let arm = place - point;
                let across = arm - d * d.dot(&arm);
                let e = match across.try_normalize(1e-12 * arm.norm()) {
                    Some(e) => e,
                    None => d.cross(&Vector3::ith(d.iamin(), 1.0)).normalize(),
                };
                let around = d.cross(&e);
                match lines {
                    LinesAbout::Axial { turn } => d * turn.cos() + around * -turn.sin(),
                    LinesAbout::Circumferential { turn } => around * turn.cos() + d * turn.sin(),
                    LinesAbout::Radial => e,
                }
            }
        }
    }

    /// Returns whether all its vectors have nonzero length.
    pub(super) fn has_length(&self) -> bool {
        let (vector, point) = match self {
            Self::Uniform(direction) => (direction, Vector3::zeros()),
            Self::About { point, axis, .. } => (axis, *point),
        };
        let norm = vector.norm();
        norm > 0.0 && norm.is_finite() && point.iter().all(|x| x.is_finite())
    }
}
