//! Fibres of materials.

use super::{
    admissible::admissible,
    axis::nonzero,
    axis::{axis, degrees},
};
use crate::{faults::FaultList, raw, read::At, value::Number};
use striae_law::bulk::{Direction, FibreStiffness, Fibres, Fibrous, LinesAbout, Material};
use striae_mesh::Vec3;
use striae_surface::texture::Axis;

/// The material with its fibres, or `None` after their faults have been noted.
pub(super) fn with_fibres(
    ground: Material,
    raw: &At<Vec<At<raw::Fibres>>>,
    faults: &mut FaultList<'_>,
) -> Option<Material> {
    let families: Vec<Option<Fibres>> = raw
        .value
        .iter()
        .map(|family| fibres(&family.value, faults))
        .collect();
    let families: Option<Vec<Fibres>> = families.into_iter().collect();
    let made = Fibrous::new(ground, &families?);
    let made = made.map_err(|error| (error, raw.span.clone()));
    admissible(made, faults).map(Material::fibrous)
}

fn fibres(raw: &raw::Fibres, faults: &mut FaultList<'_>) -> Option<Fibres> {
    let direction = raw.direction.as_ref();
    let direction = direction.and_then(|direction| lines(&direction.value, faults));
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
    let direction = direction?;
    Some(Fibres {
        stiffness,
        direction,
    })
}

fn lines(raw: &raw::FibreDirection, faults: &mut FaultList<'_>) -> Option<Direction> {
    match raw {
        raw::FibreDirection::Uniform(raw) => {
            let direction = raw.uniform.as_ref()?;
            let direction: Vec3 = nonzero(direction, "the direction of fibres", faults)?;
            Some(Direction::Uniform(direction))
        }
        raw::FibreDirection::Circumferential(raw) => {
            let turn = radians(&raw.turn);
            about(
                &raw.circumferential,
                LinesAbout::Circumferential { turn },
                faults,
            )
        }
        raw::FibreDirection::Axial(raw) => {
            let turn = radians(&raw.turn);
            about(&raw.axial, LinesAbout::Axial { turn }, faults)
        }
        raw::FibreDirection::Radial(raw) => about(&raw.radial, LinesAbout::Radial, faults),
    }
}

fn about(
    raw: &Option<At<raw::Axis>>,
    lines: LinesAbout,
    faults: &mut FaultList<'_>,
) -> Option<Direction> {
    let Axis { point, direction } = axis(raw.as_ref()?, faults)?;
    Some(Direction::About {
        point,
        axis: direction,
        lines,
    })
}

fn radians(turn: &Option<At<Number>>) -> f64 {
    degrees(turn).to_radians()
}
