//! Axes and angles.

use crate::{
    faults::FaultList,
    raw,
    read::At,
    value::{Number, vector},
};
use striae_mesh::Vec3;
use striae_model::FaultKind as ModelFault;
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

/// A vector that is not zero.
pub(super) fn nonzero(
    raw: &At<[Number; 3]>,
    place: &str,
    faults: &mut FaultList<'_>,
) -> Option<Vec3> {
    let vector = vector(&raw.value);
    if vector.norm() > 0.0 {
        return Some(vector);
    }
    faults.push(
        &raw.span,
        ModelFault::ZeroVector {
            place: place.into(),
        },
    );
    None
}

/// An angle, 0 where none is stated.
pub(super) fn degrees(raw: &Option<At<Number>>) -> f64 {
    raw.as_ref().map_or(0.0, |angle| angle.value.0)
}
