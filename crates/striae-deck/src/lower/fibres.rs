//! Fibres of materials.

use super::admissible::admissible;
use crate::{faults::FaultList, raw, read::At};
use striae_law::bulk::{FibreStiffness, Fibres, Fibrous, Material};

/// The material with its fibres, or `None` after their faults have been noted.
pub(super) fn with_fibres(
    ground: Material,
    raw: &At<Vec<At<raw::Fibres>>>,
    faults: &mut FaultList<'_>,
) -> Option<Material> {
    let families: Vec<Option<Fibres>> = raw
        .value
        .iter()
        .map(|family| fibres(&family.value))
        .collect();
    let families: Option<Vec<Fibres>> = families.into_iter().collect();
    let made = Fibrous::new(ground, &families?);
    let made = made.map_err(|error| (error, raw.span.clone()));
    admissible(made, faults).map(Material::fibrous)
}

fn fibres(raw: &raw::Fibres) -> Option<Fibres> {
    let direction = raw.direction.as_ref()?;
    let Ok(direction) = direction.value.made(&direction.span)?;
    let stiffness = match raw.stiffness.as_ref()? {
        raw::FibreStiffness::Exponential(raw) => FibreStiffness::Exponential {
            k1: raw.k1.as_ref()?.value.0,
            k2: raw.k2.as_ref()?.value.0,
            dispersion: raw.dispersion.as_ref().map_or(0.0, |share| share.value.0),
        },
        raw::FibreStiffness::Linear(raw) => FibreStiffness::Linear {
            modulus: raw.modulus.as_ref()?.value.0,
        },
    };
    Some(Fibres {
        stiffness,
        direction,
    })
}
