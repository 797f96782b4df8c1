//! Cavities and their contents.

use super::{Listed, Scope, body::Bodies, list};
use crate::{faults::FaultList, names::Names, raw, read::At};
use striae_model::{Cavity, CavityContent, CavityFilling, CavityId};

/// The cavities with their names; `None` for the faulty ones.
pub(super) fn cavities(
    raw: &[At<raw::Cavity>],
    bodies: &Bodies,
    faults: &mut FaultList<'_>,
) -> (Names, Vec<Option<Cavity>>) {
    let names = raw.iter().map(|at| at.value.name.as_ref());
    let names = Names::new("cavity", names, faults);
    let mut lower = |at: &At<raw::Cavity>| {
        let raw = &at.value;
        let mut parts = Vec::new();
        for side in list(&raw.faces) {
            let body = bodies.find(side.value.body.as_ref(), faults)?;
            let faces = bodies.faces(body, side.value.facets.as_ref(), faults)?;
            parts.push((body, faces));
        }
        let name = raw.name.as_ref()?.value.0.clone();
        Some(Cavity { name, parts })
    };
    (names, raw.iter().map(&mut lower).collect())
}

/// Contents of cavities in a step.
pub(super) fn fillings(
    raw: &[At<raw::Filling>],
    scope: &Scope<'_>,
    faults: &mut FaultList<'_>,
) -> Listed<CavityFilling> {
    Listed::new(raw, |filling| {
        let raw = &filling.value;
        let cavity = raw.cavity.as_ref();
        let cavity = cavity.and_then(|name| scope.cavity_names.find(name, faults));
        let curve = scope.curves.find(raw.curve.as_ref(), faults);
        Some(CavityFilling {
            cavity: CavityId(cavity?),
            content: content(raw.content.as_ref()?)?,
            curve: curve?,
        })
    })
}

fn content(raw: &raw::CavityContent) -> Option<CavityContent> {
    Some(match raw {
        raw::CavityContent::Pressure(raw) => {
            CavityContent::Pressure(raw.pressure.as_ref()?.value.0)
        }
        raw::CavityContent::Volume(raw) => CavityContent::Volume(raw.volume.as_ref()?.value.0),
        raw::CavityContent::VolumeRatio(raw) => {
            CavityContent::VolumeRatio(raw.volume_ratio.as_ref()?.value.0)
        }
        raw::CavityContent::Gas(raw) => {
            let gas = &raw.gas.as_ref()?.value;
            CavityContent::Gas {
                ambient: gas.ambient.as_ref()?.value.0,
                exponent: gas.exponent.as_ref().map_or(1.0, |at| at.value.0),
            }
        }
    })
}
