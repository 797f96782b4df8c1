//! Directions.

use crate::{
    faults::FaultList,
    read::At,
    value::{Number, vector},
};
use striae_mesh::Vec3;
use striae_model::FaultKind as ModelFault;

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
