//! `hertz-mindlin-two-body`: a block with a spherical face on a deformable foundation.
//!
//! Shows friction and slip in the contact plane while partial slip turns into
//! full slip, and what the unknowns that balance the resultants do.

use striae_io::figure::{Axis, Color, Content, Figure, Marker, Panel, Series, Width};
use striae_mesh::Vec3;

use super::{
    measure::{SurfaceNode, surface_nodes_in},
    study::{Extent, Run, Study},
};
use crate::failure::Failure;

/// Coarsest first.
const DECKS: [(&str, &str); 2] = decks!("hertz-mindlin-two-body": "h-0.8", "h-0.4");
/// Displacement sideways at the ends of the steps, m.
const WAYS: [f64; 3] = [0.0, 0.03, 0.15];
const BALANCED: &str = r#"balance = "resultants""#;
const PLAIN: &str = r#"balance = "none""#;

/// Runs the case.
pub fn run(study: &mut Study) -> Result<(), Failure> {
    let mut plain_mismatches = Vec::new();
    let decks = match study.extent {
        Extent::Full => &DECKS[..],
        Extent::Quick => &DECKS[..1],
    };
    for &(name, text) in decks {
        let deck = study.deck(name, text)?;
        let run = study.run(name, deck)?;
        judge(study, name, &run);
        study.draw(&arrows(&run), &format!("arrows-{name}"))?;
        study.draw(&reactions(&run), &format!("reactions-{name}"))?;
        let plain = study.variant(name, text, &[[BALANCED, PLAIN]])?;
        let plain = study.run(&format!("{name}-plain"), plain)?;
        let mismatch = plain.at_end_of(3, "pair.contact.mismatch");
        study.measured(format!("{name}.plain.mismatch"), mismatch);
        plain_mismatches.push(mismatch);
    }
    if let [coarse, fine] = plain_mismatches[..] {
        study.measured("plain.mismatch.fall", fine / coarse);
    } else {
        let fine = [
            "h-0.4.lateral",
            "h-0.4.slide.lateral",
            "h-0.4.slide.ratio.a",
            "h-0.4.slide.ratio.b",
            "h-0.4.mismatch",
            "h-0.4.plain.mismatch",
            "plain.mismatch.fall",
        ];
        study.left_out.extend(fine);
    }
    Ok(())
}

fn judge(study: &mut Study, name: &str, run: &Run) {
    let lateral = |step: usize| {
        let nodes = pressed(run, step);
        let largest = |of: fn(&SurfaceNode) -> f64| nodes.iter().map(of).fold(0.0, f64::max);
        largest(|node| node.result.tau.y.abs()) / largest(|node| node.result.tau.norm())
    };
    study.measured(format!("{name}.lateral"), lateral(1));
    study.measured(format!("{name}.slide.lateral"), lateral(2));
    for side in ["a", "b"] {
        let integral = |of: &str| run.at_end_of(3, &format!("pair.contact.{of}_integral_{side}"));
        let ratio = integral("friction") / integral("pressure");
        study.measured(format!("{name}.slide.ratio.{side}"), ratio);
    }
    let mismatch = run.largest("pair.contact.mismatch");
    study.measured(format!("{name}.mismatch"), mismatch);
}

/// Nodes of the spherical face under pressure at the end of a step.
fn pressed(run: &Run, step: usize) -> Vec<SurfaceNode<'_>> {
    let mut nodes = surface_nodes_in(run, &run.simulation.steps[step], 0);
    nodes.retain(|node| node.result.pressure > 0.0);
    nodes
}

/// A vector of a node.
type Vector = fn(&SurfaceNode) -> Vec3;

/// Friction above at the ends of the steps, slip of the last increment below once
/// there is any.
fn arrows(run: &Run) -> Figure {
    let mut panels = Vec::new();
    let rows: [(&str, &str, Color, usize, Vector); 2] = [
        ("friction", "MPa", Color::Vermillion, 0, |node| {
            node.result.tau * 1e3
        }),
        ("slip", "mm", Color::Blue, 1, |node| node.result.slip * 1e3),
    ];
    for (name, unit, color, first, vector) in rows {
        for (step, way) in WAYS.iter().enumerate().skip(first) {
            let nodes = pressed(run, step);
            let places = |node: &SurfaceNode| [node.position.x, node.position.y];
            let vectors = nodes.iter().map(vector).map(|v| [v.x, v.y]);
            let content = Content::Arrows {
                origins: nodes.iter().map(places).collect(),
                vectors: vectors.collect(),
                unit: unit.to_owned(),
            };
            let axis = |label: &str| Axis::linear(label, "m").within(-2.5, 2.5);
            panels.push(
                Panel::plane(axis("x"), axis("y"))
                    .titled(format!("{way} m sideways"))
                    .with(Series::new(name, content).colored(color)),
            );
        }
    }
    Figure {
        columns: WAYS.len(),
        ..Figure::new(Width::Page, panels)
    }
}

/// Resultants over the sideways motion.
fn reactions(run: &Run) -> Figure {
    let force = |axis: &str| run.column(&format!("pair.contact.resultant_a.{axis}"));
    let (normal, tangential, times) = (force("z"), force("x"), run.column("time"));
    let way = |time: f64| {
        let step = (time as usize).min(2);
        if step == 0 {
            return 0.0;
        }
        let share = time - step as f64;
        WAYS[step - 1] + share * (WAYS[step] - WAYS[step - 1])
    };
    let points = |value: &dyn Fn(usize) -> f64| -> Vec<[f64; 2]> {
        let rows = (0..times.len()).filter(|row| times[*row] >= 1.0);
        rows.map(|row| [1e3 * way(times[row]), value(row)])
            .collect()
    };
    let panel = Panel::new(
        Axis::linear("displacement", "mm"),
        Axis::linear("force", "MN"),
    )
    .with(
        Series::new(
            "0.1 x normal",
            Content::line(points(&|row| 1e2 * normal[row])),
        )
        .colored(Color::Black),
    )
    .with(
        Series::new(
            "tangential",
            Content::markers(points(&|row| -1e3 * tangential[row]), Marker::Circle),
        )
        .colored(Color::Vermillion),
    );
    Figure::new(Width::Column, vec![panel])
}
