//! Output of a run.

use super::{body::Bodies, list};
use crate::{
    fault::FaultKind,
    faults::FaultList,
    raw,
    read::At,
    value::{Text, vector},
};
use std::{collections::BTreeSet, num::NonZeroUsize};
use striae_output::{
    BodyField, ContactField, FieldOutput, Output, Probe, ProbePlace, Section, probe_weights,
    section_cut,
};

/// Output of a run; without the table, the default.
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
    let of_bodies = raw.body_fields.as_ref();
    let of_bodies = of_bodies.map(|fields| once(&fields.value, body_field));
    let of_contact = raw.contact_fields.as_ref();
    let of_contact = of_contact.map(|fields| once(&fields.value, contact_field));
    Output {
        fields: field_output(raw, faults),
        bodies: chosen,
        body_fields: of_bodies.unwrap_or(default.body_fields),
        contact_fields: of_contact.unwrap_or(default.contact_fields),
        wear_coefficient: raw.wear_coefficient.as_ref().map(|k| k.value.0),
        probes: probes(list(&raw.probes), bodies, faults),
        sections: sections(list(&raw.sections), bodies, faults),
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
        raw::BodyField::PrincipalStressDirections => BodyField::PrincipalStressDirections,
        raw::BodyField::LogarithmicStrain => BodyField::LogarithmicStrain,
        raw::BodyField::PrincipalStrain => BodyField::PrincipalStrain,
        raw::BodyField::PrincipalStrainDirections => BodyField::PrincipalStrainDirections,
        raw::BodyField::StrainEnergyDensity => BodyField::StrainEnergyDensity,
        raw::BodyField::HistoryVariables => BodyField::HistoryVariables,
        raw::BodyField::Section => BodyField::Section,
        raw::BodyField::Fibres => BodyField::Fibres,
    }
}

fn contact_field(raw: raw::ContactField) -> ContactField {
    match raw {
        raw::ContactField::Gap => ContactField::Gap,
        raw::ContactField::Traction => ContactField::Traction,
        raw::ContactField::MeanTraction => ContactField::MeanTraction,
        raw::ContactField::Slip => ContactField::Slip,
        raw::ContactField::SlipRate => ContactField::SlipRate,
        raw::ContactField::AccumulatedSlip => ContactField::AccumulatedSlip,
        raw::ContactField::WornDepth => ContactField::WornDepth,
        raw::ContactField::FrictionState => ContactField::FrictionState,
        raw::ContactField::FrictionWork => ContactField::FrictionWork,
        raw::ContactField::Normal => ContactField::Normal,
        raw::ContactField::Texture => ContactField::Texture,
        raw::ContactField::Status => ContactField::Status,
        raw::ContactField::Roles => ContactField::Roles,
    }
}

/// The meaning of words, each once.
fn once<R: Copy, T: PartialEq>(words: &[At<R>], meaning: fn(R) -> T) -> Vec<T> {
    let mut all = Vec::new();
    for word in words.iter().map(|word| meaning(word.value)) {
        if !all.contains(&word) {
            all.push(word);
        }
    }
    all
}

fn sections(raw: &[At<raw::Section>], bodies: &Bodies, faults: &mut FaultList<'_>) -> Vec<Section> {
    let mut known: BTreeSet<&str> = BTreeSet::new();
    let mut all = Vec::new();
    for At { span, value: raw } in raw {
        let (Some(name), Some(body)) = (&raw.name, &raw.body) else {
            continue;
        };
        let text = &name.value.0;
        if !known.insert(text) {
            let kind = FaultKind::SectionTwice { name: text.clone() };
            faults.push(&name.span, kind);
        }
        let id = bodies.find(Some(body), faults);
        let (Some(id), Some(point), Some(normal)) = (id, &raw.point, &raw.normal) else {
            continue;
        };
        let section = Section {
            name: text.clone(),
            body: body.value.0.clone(),
            point: vector(&point.value),
            normal: vector(&normal.value),
        };
        let found = bodies.mesh(id).map(|mesh| section_cut(mesh, &section));
        if let Some(Err(cause)) = found {
            let name = text.clone();
            faults.push(span, FaultKind::Section { name, cause });
        }
        all.push(section);
    }
    all
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
