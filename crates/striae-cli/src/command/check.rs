//! `striae check DECK`: validation and a summary of what would be simulated.

use crate::failure::Failure;
use std::{collections::BTreeSet, io::Write, path::PathBuf};
use striae_contact::{initial::Fit, interference::Spot};
use striae_deck as deck;
use striae_law::bulk::LameConstants;
use striae_mesh::{NodeId, Vec3};
use striae_solve::{
    initial::{ROUND_OFF, fits, other_name, surface_node},
    model::{Body, Formulation, Model, Pair, PairId, RigidShape, RigidSurface, Side},
    newton::{Analysis, Estimate, estimate},
    problem::Problem,
    stabilisation::first_increment,
    warning::warnings_at_start,
};

/// Check a deck and summarise what it describes.
#[derive(clap::Args)]
pub struct Arguments {
    /// The deck.
    pub deck: PathBuf,
}

/// Reads the deck and prints the summary.
pub fn run(arguments: &Arguments, out: &mut dyn Write) -> Result<(), Failure> {
    let deck = deck::read(&arguments.deck)?;
    write!(out, "{}", summary(&deck.model)?)?;
    Ok(())
}

fn summary(model: &Model) -> Result<String, Failure> {
    let mut lines = vec![model.title.clone()];
    lines.extend(model.bodies.iter().map(body_line));
    lines.extend(model.rigid_surfaces.iter().map(rigid_line));
    let fits = fits(model);
    for (index, (pair, fit)) in model.pairs.iter().zip(&fits).enumerate() {
        lines.push(pair_line(pair, model));
        lines.extend(fit.iter().map(|fit| fit_line(model, PairId(index), fit)));
    }
    lines.extend((0..model.steps.len()).map(|step| step_line(model, step)));
    lines.extend(size_lines(model)?);
    let warnings = warnings_at_start(model, &fits);
    lines.extend(warnings.iter().map(|warning| format!("warning: {warning}")));
    lines.push("no faults".into());
    Ok(lines.join("\n") + "\n")
}

fn body_line(body: &Body) -> String {
    let law = body.material.name();
    let LameConstants { lambda, shear } = body.material.lame_constants();
    let formulation = match body.formulation {
        Formulation::Standard => "",
        Formulation::MeanDilatation => " with mean dilatation",
    };
    format!(
        "  body `{}`: {} nodes, {} elements{formulation}, smallest scaled Jacobian {:.3}; {law}, lambda = {lambda:.6e}, G = {shear:.6e}",
        body.name,
        body.mesh.positions.len(),
        body.mesh.element_count(),
        body.mesh.quality().smallest_scaled_jacobian,
    )
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
        Side::Deformable { body, faces } => {
            let name = &model.bodies[body.0].name;
            format!(
                "`{name}` ({} facets, {} nodes)",
                faces.len(),
                side_nodes(side, model).len()
            )
        }
        Side::Rigid(rigid) => format!("rigid `{}`", model.rigid_surfaces[rigid.0].name),
    });
    let stabilised = if pair.stabilised { ", stabilised" } else { "" };
    format!("  pair `{}`: {a} and {b}{stabilised}", pair.name)
}

/// Smallest gap and deepest overlap of a pair, and where.
fn fit_line(model: &Model, pair: PairId, fit: &Fit) -> String {
    let at = |side: usize, spot: Spot, x: &Vec3| {
        let spot = match spot {
            Spot::Node(node) => surface_node(model, pair, side, node).map(|node| node.to_string()),
            Spot::Centre(facet) => Some(format!("the centre of {facet}")),
        };
        format!(
            "{} of `{}` ({:.6}, {:.6}, {:.6})",
            spot.unwrap_or_default(),
            other_name(model, pair, 1 - side),
            x.x,
            x.y,
            x.z
        )
    };
    let gap = match &fit.gap {
        Some(gap) => {
            let place = at(gap.side, gap.spot, &gap.point);
            format!("smallest gap {:.3e} at {place}", gap.gap)
        }
        None => format!(
            "the sides do not face each other; nearest distance {:.3e}",
            fit.distance
        ),
    };
    let overlap = fit
        .overlap
        .as_ref()
        .filter(|overlap| overlap.share() > ROUND_OFF);
    let overlap = overlap.map_or("no overlap".into(), |overlap| {
        let place = at(overlap.side, overlap.spot, &overlap.point);
        let share = 100.0 * overlap.share();
        format!(
            "largest overlap {:.3e} ({share:.1} % of the facet size) at {place}",
            overlap.depth
        )
    });
    format!("    {gap}; {overlap}")
}

fn step_line(model: &Model, index: usize) -> String {
    let step = &model.steps[index];
    let first = first_increment(model, index);
    let increments = step.increments;
    format!(
        "  step `{}`: duration {}, increments from {:.3e} to {:.3e} of it, first {:.3e}",
        step.name, step.duration, increments.smallest, increments.largest, first
    )
}

fn side_nodes(side: &Side, model: &Model) -> BTreeSet<NodeId> {
    match side {
        Side::Deformable { body, faces } => {
            let mesh = &model.bodies[body.0].mesh;
            faces
                .iter()
                .flat_map(|face| mesh.face_nodes(*face))
                .collect()
        }
        Side::Rigid(_) => BTreeSet::new(),
    }
}

/// Unknowns of the first linear system, and what solvers take for it.
fn size_lines(model: &Model) -> Result<Vec<String>, Failure> {
    let problem = Problem::new(model.clone())?;
    let Estimate {
        unknowns,
        analysis,
        others,
    } = match estimate(&problem) {
        Ok(estimate) => estimate,
        Err(reason) => {
            return Ok(vec![format!(
                "  the undeformed state cannot be evaluated: {reason}"
            )]);
        }
    };
    let cost = |analysis: &Analysis| {
        let megabytes = analysis.peak_bytes as f64 / 1e6;
        format!("{megabytes:.1} MB and {:.1e} operations", analysis.flops)
    };
    let mut lines = vec![format!(
        "  unknowns {unknowns} at the start; a factorisation ({}) takes about {}",
        analysis.method,
        cost(&analysis)
    )];
    let other = |other: &Analysis| format!("    otherwise by {}: {}", other.method, cost(other));
    lines.extend(others.iter().map(other));
    Ok(lines)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;
    use striae_contact::selection::{Before, Selection};
    use striae_solve::{assembly::StepContext, state::State};

    #[test]
    fn the_summary_counts_what_the_deck_describes() {
        let text = include_str!("template.toml");
        let deck = deck::parse(text, "deck.toml", Path::new("")).unwrap();
        let said = summary(&deck.model).unwrap();
        assert!(
            said.contains("body `lower`: 75 nodes, 32 elements, smallest scaled Jacobian 1.000"),
            "{said}"
        );
        assert!(said.contains(
            "pair `interface`: `lower` (16 facets, 25 nodes) and `upper` (9 facets, 16 nodes)"
        ));
        // 3 (75 + 48) displacements and three tractions of every node that is kept.
        let displacements = 3 * (75 + 48);
        let tractions = 3 * kept_at_the_start(&deck.model);
        let unknowns = format!("unknowns {} at", displacements + tractions);
        assert!(said.contains(&unknowns), "{unknowns}: {said}");
        for method in ["(condensed) takes", "by multifrontal: ", "by iterative: "] {
            assert!(said.contains(method), "{said}");
        }
    }

    /// Nodes of the first pair that bear unknowns in the undeformed state.
    fn kept_at_the_start(model: &Model) -> usize {
        let problem = Problem::new(model.clone()).unwrap();
        let state = State::undeformed(&problem);
        let context = StepContext::new(&problem, 0, &state);
        let of_pair = &state.pairs[0];
        let before = Before {
            kept: &of_pair.kept,
            pointed: &of_pair.pointed,
            points: &of_pair.points,
        };
        let configuration = context.configuration(0, &state.positions, &state.rigid);
        let selection = Selection::new(&configuration, None, before, &context.fixed_on_pair[0]);
        selection.kept().len()
    }
}
