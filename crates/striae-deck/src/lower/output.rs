//! What is written.

use super::{body::Bodies, list};
use crate::{
    fault::FaultKind,
    faults::FaultList,
    raw,
    read::At,
    value::{Text, vector},
};
use std::{collections::BTreeSet, num::NonZeroUsize};
use striae_output::{BodyField, FieldOutput, Output, Probe, ProbePlace, probe_weights};

/// What is written; without the table, the default.
pub(super) fn output(
    raw: Option<&At<raw::OutputSettings>>,
    bodies: &Bodies,
    faults: &mut FaultList<'_>,
) -> Output {
    let default = Output::default();
    let Some(At { value: raw, .. }) = raw else {
        return default;
    };
    let every = raw.checkpoint_every.as_ref();
    let chosen = raw.bodies.as_ref().map(|chosen| {
        let names = chosen.value.iter();
        names.for_each(|name| _ = bodies.find(Some(name), faults));
        chosen
            .value
            .iter()
            .map(|name| name.value.0.clone())
            .collect()
    });
    let fields = raw.body_fields.as_ref().map(|fields| {
        let mut all: Vec<BodyField> = Vec::new();
        for field in fields.value.iter().map(|field| body_field(field.value)) {
            if !all.contains(&field) {
                all.push(field);
            }
        }
        all
    });
    Output {
        fields: field_output(raw, faults),
        bodies: chosen,
        body_fields: fields.unwrap_or(default.body_fields),
        wear_coefficient: raw.wear_coefficient.as_ref().map(|k| k.value.0),
        probes: probes(list(&raw.probes), bodies, faults),
        checkpoint_every: every.map_or(default.checkpoint_every, |every| {
            NonZeroUsize::new(every.value.0)
        }),
    }
}

fn field_output(raw: &raw::OutputSettings, faults: &mut FaultList<'_>) -> FieldOutput {
    match (&raw.fields_every, &raw.fields_interval) {
        (Some(_), Some(interval)) => {
            let kind = FaultKind::Exclusive {
                first: "fields_every".into(),
                second: "fields_interval".into(),
                place: "[output]".into(),
                choices: vec!["`fields_every`".into(), "`fields_interval`".into()],
            };
            faults.push(&interval.span, kind);
            FieldOutput::Last
        }
        (None, Some(interval)) => FieldOutput::Interval(interval.value.0),
        (Some(every), None) => {
            NonZeroUsize::new(every.value.0).map_or(FieldOutput::Last, FieldOutput::Every)
        }
        (None, None) => Output::default().fields,
    }
}

fn body_field(raw: raw::BodyField) -> BodyField {
    match raw {
        raw::BodyField::Displacement => BodyField::Displacement,
        raw::BodyField::Velocity => BodyField::Velocity,
        raw::BodyField::CauchyStress => BodyField::CauchyStress,
        raw::BodyField::VonMises => BodyField::VonMises,
        raw::BodyField::PrincipalStress => BodyField::PrincipalStress,
        raw::BodyField::StrainEnergyDensity => BodyField::StrainEnergyDensity,
    }
}

fn probes(raw: &[At<raw::Probe>], bodies: &Bodies, faults: &mut FaultList<'_>) -> Vec<Probe> {
    let mut known: BTreeSet<&str> = BTreeSet::new();
    let mut all = Vec::new();
    for At { span, value: raw } in raw {
        let (
            Some(At {
                span: at,
                value: Text(name),
            }),
            Some(body),
        ) = (&raw.name, &raw.body)
        else {
            continue;
        };
        if !known.insert(name) {
            let name = name.clone();
            faults.push(at, FaultKind::ProbeTwice { name });
        }
        let place = raw.place.as_ref().and_then(|place| match place {
            raw::ProbePlace::Point(raw) => {
                Some(ProbePlace::Point(vector(&raw.point.as_ref()?.value)))
            }
            raw::ProbePlace::Nodes(raw) => {
                Some(ProbePlace::Nodes(raw.nodes.as_ref()?.value.0.clone()))
            }
        });
        let (Some(id), Some(place)) = (bodies.find(Some(body), faults), place) else {
            continue;
        };
        let found = bodies.mesh(id).map(|mesh| probe_weights(mesh, &place));
        if let Some(Err(cause)) = found {
            let name = name.clone();
            faults.push(span, FaultKind::Probe { name, cause });
        }
        all.push(Probe {
            name: name.clone(),
            body: body.value.0.clone(),
            place,
        });
    }
    all
}
