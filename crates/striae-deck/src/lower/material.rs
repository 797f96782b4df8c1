//! Bulk materials.

use super::{admissible::admissible, fibres::with_fibres};
use crate::{
    faults::{FaultList, Span},
    raw,
};
use striae_law::bulk::Material;

/// A material, or `None` after its faults have been noted.
pub(super) fn material(
    raw: &raw::Material,
    span: &Span,
    faults: &mut FaultList<'_>,
) -> Option<Material> {
    let ground = raw.law.as_ref()?.made(span)?;
    let ground = admissible(ground, faults)?;
    match &raw.fibres {
        Some(fibres) => with_fibres(ground, fibres, faults),
        None => Some(ground),
    }
}
