//! `striae check DECK`: validation, a summary of what would be simulated, and advice; see
//! [`striae::advice`].

mod json;

use crate::{failure::Failure, source::Source};
use std::{collections::BTreeSet, io::Write};
use striae::advice::{Advice, Remark, Topic};
use striae_deck::{Deck, Location, Part};
use striae_law::bulk::{LameConstants, Material};
use striae_mesh::{NodeId, significant};
use striae_model::{
    Body, BodySection, ContactSurface, Formulation, Model, Pair, RigidShape, RigidSurface,
};
use striae_solve::stabilisation::first_increment;

/// Check a deck: its faults, or what it describes, with warnings and notes.
#[derive(clap::Args)]
pub struct Arguments {
    #[command(flatten)]
    pub source: Source,
    /// Print the result as JSON.
    #[arg(long)]
    pub json: bool,
}

/// Reads the deck and prints the summary and the advice.
pub fn run(arguments: &Arguments, out: &mut dyn Write) -> Result<(), Failure> {
    let deck = match arguments.source.read() {
        Err(faults) if arguments.json => {
            writeln!(out, "{:#}", json::of_faults(&faults))?;
            return Err(faults.into());
        }
        read => read?,
    };
    let advice = Advice::of(&deck.model);
    match arguments.json {
        true => writeln!(out, "{:#}", json::of_model(&deck, &advice))?,
        false => write!(out, "{}", summary(&deck, &advice))?,
    }
    match advice.faults.len() {
        0 => Ok(()),
        count => Err(Failure::Impossible(count)),
    }
}

fn summary(deck: &Deck, advice: &Advice) -> String {
    let Deck { model, notes, .. } = deck;
    let mut lines = vec![model.title.clone()];
    for body in &model.bodies {
        lines.push(body_line(body));
        lines.extend(body.sections.iter().map(section_line));
    }
    lines.extend(model.rigid_surfaces.iter().map(rigid_line));
    // Contact of everything has pairs of bodies that may never meet.
    let is_near = |pair: &&Pair| {
        let mut fits = advice.notes.iter().filter(|note| note.topic == Topic::Fit);
        pair.is_expected_to_touch()
            || pair.is_on_itself()
            || fits.any(|note| note.name.as_ref() == Some(&pair.name))
    };
    let near = model.pairs.iter().filter(is_near);
    lines.extend(near.map(|pair| pair_line(pair, model)));
    lines.extend((0..model.steps.len()).map(|step| step_line(model, step)));
    lines.extend(notes.iter().map(|note| format!("note: {note}")));
    for (class, remarks) in [
        ("note", &advice.notes),
        ("warning", &advice.warnings),
        ("fault", &advice.faults),
    ] {
        lines.extend(remarks.iter().map(|remark| {
            let at = place(deck, remark);
            let at = at.map(|at| format!(" [{}:{}]", at.file, at.position.line));
            format!("{class}: {remark}{}", at.unwrap_or_default())
        }));
    }
    let counted = |count: usize, one: &str| match count {
        0 => format!("no {one}s"),
        1 => format!("1 {one}"),
        _ => format!("{count} {one}s"),
    };
    let [faults, warnings] = [&advice.faults, &advice.warnings].map(Vec::len);
    lines.push(format!(
        "{}, {}",
        counted(faults, "fault"),
        counted(warnings, "warning")
    ));
    lines.join("\n") + "\n"
}

/// Location in the deck of the subject of a remark.
fn place<'d>(deck: &'d Deck, remark: &Remark) -> Option<&'d Location> {
    let kinds = match remark.topic {
        Topic::Fit | Topic::Facing | Topic::NeverMeets | Topic::Friction | Topic::Texture => {
            [Part::Pair, Part::Body, Part::Tie, Part::Rigid, Part::Step]
        }
        _ => [Part::Body, Part::Rigid, Part::Step, Part::Pair, Part::Tie],
    };
    deck.places.of(&kinds, remark.name.as_deref()?)
}

fn body_line(body: &Body) -> String {
    let sections = body.sections.iter();
    let in_sections: usize = sections.map(|section| section.elements.len()).sum();
    let (nodes, elements) = (body.mesh.positions.len(), body.mesh.element_count());
    let own = match (in_sections, elements - in_sections) {
        (0, _) => made_of(body.formulation, &body.material),
        (_, 0) => " in sections".to_owned(),
        (_, rest) => format!(
            ", {rest} in no section{}",
            made_of(body.formulation, &body.material)
        ),
    };
    format!(
        "  body `{}`: {nodes} nodes, {elements} elements{own}",
        body.name
    )
}

fn section_line(section: &BodySection) -> String {
    format!(
        "    section `{}`: {} elements{}",
        section.set,
        section.elements.len(),
        made_of(section.formulation, &section.material)
    )
}

fn made_of(formulation: Formulation, material: &Material) -> String {
    let law = material.name();
    let LameConstants { lambda, shear } = material.lame_constants();
    let formulation = match formulation {
        Formulation::Standard => "",
        Formulation::MeanDilatation => " with mean dilatation",
        Formulation::AssumedStrain => " with assumed strain",
    };
    let [lambda, shear] = [lambda, shear].map(|modulus| significant(modulus, 7));
    format!("{formulation}; {law}, lambda = {lambda}, G = {shear}")
}

fn rigid_line(rigid: &RigidSurface) -> String {
    let shape = match &rigid.shape {
        RigidShape::Plane { .. } => "plane".into(),
        RigidShape::Bare => {
            let tied: usize = rigid.ties.iter().map(|(_, nodes)| nodes.len()).sum();
            format!("{tied} nodes tied")
        }
        RigidShape::Facets { positions, facets } => {
            format!("{} nodes, {} facets", positions.len(), facets.len())
        }
    };
    format!("  rigid surface `{}`: {shape}", rigid.name)
}

fn pair_line(pair: &Pair, model: &Model) -> String {
    let [a, b] = [&pair.a, &pair.b].map(|side| match side {
        ContactSurface::Deformable { body, faces } => {
            let name = &model.bodies[body.0].name;
            format!(
                "`{name}` ({} facets, {} nodes)",
                faces.len(),
                side_nodes(side, model).len()
            )
        }
        ContactSurface::Rigid(rigid) => format!("rigid `{}`", model.rigid_surfaces[rigid.0].name),
        ContactSurface::Itself => "itself".to_owned(),
    });
    let stabilised = if pair.stabilised { ", stabilised" } else { "" };
    let features = pair.feature_angle.map_or_else(String::new, |angle| {
        format!(", faces part at edges of {angle} degrees")
    });
    format!("  pair `{}`: {a} and {b}{stabilised}{features}", pair.name)
}

fn step_line(model: &Model, index: usize) -> String {
    let step = &model.steps[index];
    let first = first_increment(model, index);
    let increments = step.increments;
    let shares = [increments.smallest, increments.largest, first];
    let [smallest, largest, first] = shares.map(|share| significant(share, 4));
    format!(
        "  step `{}`: duration {}, increments from {smallest} to {largest} of it, first {first}",
        step.name, step.duration
    )
}

fn side_nodes(side: &ContactSurface, model: &Model) -> BTreeSet<NodeId> {
    match side {
        ContactSurface::Deformable { body, faces } => {
            let mesh = &model.bodies[body.0].mesh;
            faces
                .iter()
                .flat_map(|face| mesh.face_nodes(*face))
                .collect()
        }
        ContactSurface::Rigid(_) | ContactSurface::Itself => BTreeSet::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;
    use striae_contact::selection::Selection;
    use striae_deck as deck;
    use striae_solve::{assembly::StepContext, problem::Problem, state::State};

    #[test]
    fn the_summary_counts_what_the_deck_describes() {
        let text = include_str!("new/blocks.toml");
        let deck = deck::parse(text, "deck.toml", Path::new("")).unwrap();
        let said = summary(&deck, &Advice::of(&deck.model));
        assert!(
            said.contains("body `lower`: 75 nodes, 32 elements; neo-Hookean"),
            "{said}"
        );
        assert!(said.contains(
            "pair `lower-upper`: `lower` (64 facets, 66 nodes) and `upper` (42 facets, 44 nodes)"
        ));
        // 3 (75 + 48) displacements and three tractions of every node that is kept.
        let displacements = 3 * (75 + 48);
        let tractions = 3 * kept_at_the_start(&deck.model);
        let unknowns = format!("unknowns {} at", displacements + tractions);
        assert!(said.contains(&unknowns), "{unknowns}: {said}");
        for method in [
            "(condensed) takes",
            "by multifrontal: ",
            "by iterative: ",
            "smallest scaled Jacobian 1.000",
            "\nno faults, no warnings\n",
        ] {
            assert!(said.contains(method), "{said}");
        }
    }

    /// Nodes of all pairs that bear unknowns in the undeformed state.
    fn kept_at_the_start(model: &Model) -> usize {
        let problem = Problem::new(model.clone()).unwrap();
        let state = State::undeformed(&problem);
        let context = StepContext::new(&problem, 0, &state);
        let kept = (0..problem.pairs.len()).map(|pair| {
            let configuration = context.configuration(pair, &state.positions, &state.rigid);
            let selection = Selection::new(
                &configuration,
                None,
                &state.pairs[pair].kept,
                &context.fixed_on_pair[pair],
            );
            selection.kept().len()
        });
        kept.sum()
    }
}
