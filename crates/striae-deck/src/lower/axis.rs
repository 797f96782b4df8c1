//! Axes and angles.

use super::generator::nonzero;
use crate::{
    faults::FaultList,
    raw,
    read::At,
    value::{Number, vector},
};
use striae_mesh::Vec3;
use striae_surface::texture::Axis;

/// An axis in space.
pub(super) fn axis(raw: &At<raw::Axis>, faults: &mut FaultList<'_>) -> Option<Axis> {
    Some(Axis {
        point: raw
            .value
            .point
            .as_ref()
            .map_or(Vec3::zeros(), |point| vector(&point.value)),
        direction: nonzero(
            raw.value.direction.as_ref()?,
            "the direction of an axis",
            faults,
        )?,
    })
}

/// An angle, 0 where none is stated.
pub(super) fn degrees(raw: &Option<At<Number>>) -> f64 {
    raw.as_ref().map_or(0.0, |angle| angle.value.0)
}
