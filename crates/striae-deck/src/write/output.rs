//! Output of a run.

use striae_output::{BodyField, ContactField, FieldOutput, Output, Probe, ProbePlace, Section};

use super::value::{list, number, text, vector};

/// The table of output.
pub(super) fn output(output: &Output) -> String {
    let fields = match output.fields {
        FieldOutput::Every(every) => format!("fields_every = {every}"),
        FieldOutput::Last => "fields_every = 0".to_owned(),
        FieldOutput::Interval(time) => format!("fields_interval = {}", number(time)),
    };
    let checkpoints = output.checkpoint_every.map_or(0, |every| every.get());
    let mut table = format!("\n[output]\n{fields}\ncheckpoint_every = {checkpoints}\n");
    if let Some(bodies) = &output.bodies {
        let bodies = list(bodies.iter().map(|name| text(name)));
        table += &format!("bodies = {bodies}\n");
    }
    if output.body_fields != BodyField::USUAL {
        let fields = list(output.body_fields.iter().map(|field| text(word(*field))));
        table += &format!("body_fields = {fields}\n");
    }
    if output.contact_fields != ContactField::USUAL {
        let words = output
            .contact_fields
            .iter()
            .map(|field| contact_word(*field));
        table += &format!("contact_fields = {}\n", list(words.map(text)));
    }
    if let Some(coefficient) = output.wear_coefficient {
        table += &format!("wear_coefficient = {}\n", number(coefficient));
    }
    if !output.probes.is_empty() {
        table += &format!("probes = {}\n", list(output.probes.iter().map(probe)));
    }
    if !output.sections.is_empty() {
        let sections = list(output.sections.iter().map(section));
        table += &format!("sections = {sections}\n");
    }
    table
}

fn word(field: BodyField) -> &'static str {
    match field {
        BodyField::Displacement => "displacement",
        BodyField::Velocity => "velocity",
        BodyField::CauchyStress => "cauchy-stress",
        BodyField::VonMises => "von-mises",
        BodyField::PrincipalStress => "principal-stress",
        BodyField::PrincipalStressDirections => "principal-stress-directions",
        BodyField::LogarithmicStrain => "logarithmic-strain",
        BodyField::PrincipalStrain => "principal-strain",
        BodyField::PrincipalStrainDirections => "principal-strain-directions",
        BodyField::StrainEnergyDensity => "strain-energy-density",
        BodyField::HistoryVariables => "history-variables",
        BodyField::Section => "section",
        BodyField::Fibres => "fibres",
    }
}

fn contact_word(field: ContactField) -> &'static str {
    match field {
        ContactField::Gap => "gap",
        ContactField::Traction => "traction",
        ContactField::MeanTraction => "mean-traction",
        ContactField::Slip => "slip",
        ContactField::SlipRate => "slip-rate",
        ContactField::AccumulatedSlip => "accumulated-slip",
        ContactField::WornDepth => "worn-depth",
        ContactField::FrictionState => "friction-state",
        ContactField::FrictionWork => "friction-work",
        ContactField::Normal => "normal",
        ContactField::Texture => "texture",
        ContactField::Status => "status",
        ContactField::Roles => "roles",
    }
}

fn section(section: &Section) -> String {
    let (name, body) = (text(&section.name), text(&section.body));
    let (point, normal) = (vector(&section.point), vector(&section.normal));
    format!("{{ name = {name}, body = {body}, point = {point}, normal = {normal} }}")
}

fn probe(probe: &Probe) -> String {
    let (name, body) = (text(&probe.name), text(&probe.body));
    let place = match &probe.place {
        ProbePlace::Point(at) => format!("point = {}", vector(at)),
        ProbePlace::Nodes(set) => format!("nodes = {}", text(set)),
    };
    format!("{{ name = {name}, body = {body}, {place} }}")
}
