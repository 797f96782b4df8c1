//! Strain and tension that steps give to bodies.

use super::{Listed, Scope, list};
use crate::{
    faults::{FaultList, Span},
    raw,
    read::At,
    value::{Number, vector},
};
use striae_mesh::Vec3;
use striae_model::{
    Actuation, ActuationKind, BodyId, FaultKind as ModelFault, actuation::strain_in_axes, nearest,
};

/// The actuations of a step.
pub(super) fn actuations(
    raw: &raw::Step,
    scope: &Scope<'_>,
    faults: &mut FaultList<'_>,
) -> Listed<Actuation> {
    Listed::new(list(&raw.actuation), |At { value: raw, .. }| {
        let curve = scope.curves.find(raw.curve.as_ref(), faults);
        let kind = raw.kind.as_ref().and_then(|kind| lowered(kind, faults));
        let body = scope.bodies.find(raw.body.as_ref(), faults)?;
        let section = match &raw.section {
            Some(set) => Some(section(body, &set.value.0, &set.span, scope, faults)?),
            None => None,
        };
        Some(Actuation {
            body,
            section,
            kind: kind?,
            curve: curve?,
        })
    })
}

/// Number of a section by its element set.
fn section(
    body: BodyId,
    name: &str,
    span: &Span,
    scope: &Scope<'_>,
    faults: &mut FaultList<'_>,
) -> Option<usize> {
    let sets = scope.bodies.sections(body).iter().map(|of| of.set.clone());
    let mut known: Vec<String> = sets.collect();
    if let Some(at) = known.iter().position(|set| set == name) {
        return Some(at + 1);
    }
    known.sort();
    let kind = ModelFault::UnknownSet {
        body: scope.bodies.name(body).to_owned(),
        kind: "section of element",
        name: name.to_owned(),
        nearest: nearest(name, known.iter().map(String::as_str)),
        known,
    };
    faults.push(span, kind);
    None
}

fn lowered(raw: &raw::ActuationKind, faults: &mut FaultList<'_>) -> Option<ActuationKind> {
    match raw {
        raw::ActuationKind::Stretch(raw) => {
            let strain = raw.stretch.as_ref().map(|at| at.value.0);
            let along = match &raw.along {
                Some(at) => Some(lines(at, faults)?),
                None => None,
            };
            Some(match along {
                None => ActuationKind::isotropic(strain?),
                Some(Line::Direction(direction)) => ActuationKind::along(strain?, &direction),
                Some(Line::Fibres) => ActuationKind::FibreStrain(strain?),
            })
        }
        raw::ActuationKind::Strain(raw) => {
            let components = raw
                .strain
                .as_ref()?
                .value
                .map(|Number(component)| component);
            let Some(axes) = &raw.axes else {
                let axes = [Vec3::x(), Vec3::y()];
                return strain_in_axes(components, axes).map(ActuationKind::Strain);
            };
            let strain = strain_in_axes(components, axes.value.map(|axis| vector(&axis)));
            if strain.is_none() {
                let place = "the axes of a strain, and the part of the second normal to the first,";
                let place = place.to_owned();
                faults.push(&axes.span, ModelFault::ZeroVector { place });
            }
            strain.map(ActuationKind::Strain)
        }
        raw::ActuationKind::Thermal(raw) => Some(ActuationKind::Thermal {
            expansion: raw.thermal_expansion.as_ref()?.value.0,
            temperature: raw.temperature.as_ref()?.value.0,
        }),
        raw::ActuationKind::Tension(raw) => {
            let value = raw.tension.as_ref().map(|at| at.value.0);
            let along = lines(raw.along.as_ref()?, faults)?;
            let value = value?;
            Some(match along {
                Line::Direction(along) => ActuationKind::Tension { along, value },
                Line::Fibres => ActuationKind::FibreTension(value),
            })
        }
    }
}

/// Lines that are actuated.
enum Line {
    /// Along a unit vector.
    Direction(Vec3),
    /// Fibres of the material.
    Fibres,
}

fn lines(raw: &At<raw::Lines>, faults: &mut FaultList<'_>) -> Option<Line> {
    let raw::Lines::Direction(direction) = &raw.value else {
        return Some(Line::Fibres);
    };
    let along = vector(direction);
    // What has been made a unit vector before keeps its bits.
    let is_unit = (along.norm_squared() - 1.0).abs() < 8.0 * f64::EPSILON;
    let unit = match is_unit {
        true => Some(along),
        false => along.try_normalize(0.0),
    };
    if unit.is_none() {
        let place = "`along` of an actuation".to_owned();
        faults.push(&raw.span, ModelFault::ZeroVector { place });
    }
    unit.map(Line::Direction)
}
