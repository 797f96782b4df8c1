//! Laws that refuse their constants.

use crate::faults::{FaultList, Span};
use striae_model::FaultKind as ModelFault;

/// Value that was made, or `None` after the reason for its absence has been noted.
pub(super) fn admissible<T, E: ToString>(
    made: Result<T, (E, Span)>,
    faults: &mut FaultList<'_>,
) -> Option<T> {
    made.map_err(|(error, span)| {
        let cause = error.to_string();
        faults.push(&span, ModelFault::Material { cause });
    })
    .ok()
}
