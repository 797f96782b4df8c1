//! `hertz-mindlin-two-body`: a block with a spherical face on a deformable foundation.
//!
//! Shows friction and slip in the contact plane while partial slip turns into full slip, beside
//! collocated rows. Two variants show the origin of friction across the motion: one without
//! friction while it is pressed, and one of the same contact zone with a hundredth of the strains.

use striae_contact::side::Side;
use striae_figure::{Axis, Color, Content, Figure, Marker, Panel, Series, Width};
use striae_mesh::Vec3;

use super::{
    contact_face::ContactFace,
    measure::{MeasuredNode, surface_nodes_in},
    study::{Extent, Run, Study},
};
use crate::failure::Failure;

/// Coarsest first.
const DECKS: [(&str, &str); 2] = decks!("hertz-mindlin-two-body": "h-0.8", "h-0.4");
/// Displacement sideways at the ends of the steps, m.
const WAYS: [f64; 3] = [0.0, 0.03, 0.15];
const WEIGHTED: &str = r#"enforcement = "weighted""#;
const COLLOCATED: &str = r#"enforcement = "collocated""#;
const MU: f64 = 0.1;
/// Part of the deck that states friction.
const FRICTION: &str = r#"friction = { law = "coulomb", mu = 0.1 }"#;
/// The step that makes all slip.
const SLIDE: &str = r#"[[step]]
name = "slide"
increments = 12
displacement = [{ body = "block", nodes = "zmax", x = 0.15 }]"#;
/// Friction from the second step on.
const LATE: [[&str; 2]; 3] = [
    [FRICTION, ""],
    [
        r#"name = "shear""#,
        r#"name = "shear"
friction = [{ pair = "contact", law = "coulomb", mu = 0.1 }]"#,
    ],
    [SLIDE, ""],
];
/// A hundred times the radius, a hundredth of the displacements: a contact zone of
/// the same size.
const SHALLOW: [[&str; 2]; 4] = [
    ["radius = 12,", "radius = 1200,"],
    ["z = -0.3 }", "z = -0.003 }"],
    ["x = 0.03 }", "x = 0.0003 }"],
    [SLIDE, ""],
];
/// Quantities that the quick run omits.
const FULL_ONLY: [&str; 12] = [
    "h-0.4.pressed.friction",
    "h-0.4.lateral",
    "h-0.4.late.lateral",
    "h-0.4.slide.lateral",
    "h-0.4.slide.ratio.a",
    "h-0.4.slide.ratio.b",
    "h-0.4.slide.tilt",
    "h-0.4.slide.forces",
    "h-0.4.slide.forces.flat",
    "h-0.4.mismatch",
    "h-0.4.plain.mismatch",
    "slide.forces.fall",
];

/// Runs the case.
pub fn run(study: &mut Study) -> Result<(), Failure> {
    let decks = match study.extent {
        Extent::Full => &DECKS[..],
        Extent::Quick => &DECKS[..1],
    };
    let mut off_laws = Vec::new();
    for &(name, text) in decks {
        let deck = study.deck(name, text)?;
        let run = study.run(name, deck)?;
        pressed_and_sheared(study, name, &run);
        let off_law = slid(study, name, &run);
        study.draw(&arrows(&run), &format!("arrows-{name}"))?;
        study.draw(&reactions(&run), &format!("reactions-{name}"))?;
        let late = study.variant(name, text, &LATE)?;
        let late = study.run(&format!("{name}-late"), late)?;
        study.measured(format!("{name}.late.lateral"), lateral_share(&late));
        study.draw(&arrows(&late), &format!("arrows-{name}-late"))?;
        let plain = study.variant(name, text, &[[WEIGHTED, COLLOCATED]])?;
        let plain = study.run(&format!("{name}-plain"), plain)?;
        let mismatch = plain.at_end_of(3, "pair.contact.mismatch");
        study.measured(format!("{name}.plain.mismatch"), mismatch);
        off_laws.push(off_law);
    }
    let (name, text) = DECKS[0];
    let shallow = study.variant(name, text, &SHALLOW)?;
    let shallow = study.run(&format!("{name}-shallow"), shallow)?;
    study.measured("shallow.pressed.friction", friction_share(&shallow, 0));
    study.measured("shallow.lateral", lateral_share(&shallow));
    if let [coarse, fine] = off_laws[..] {
        study.measured("slide.forces.fall", fine / coarse);
    } else {
        study.left_out.extend(FULL_ONLY);
    }
    Ok(())
}

/// The part that is not full slip.
fn pressed_and_sheared(study: &mut Study, name: &str, run: &Run) {
    study.measured(format!("{name}.pressed.friction"), friction_share(run, 0));
    study.measured(format!("{name}.lateral"), lateral(run, 1));
    study.measured(format!("{name}.slide.lateral"), lateral(run, 2));
    let mismatch = run.largest("pair.contact.mismatch");
    study.measured(format!("{name}.mismatch"), mismatch);
}

/// Full slip: how far the forces are off the law.
fn slid(study: &mut Study, name: &str, run: &Run) -> f64 {
    let at_end = |of: &str| run.at_end_of(3, &format!("pair.contact.{of}"));
    for side in ["a", "b"] {
        let integral = |of: &str| at_end(&format!("{of}_integral_{side}"));
        let ratio = integral("friction") / integral("pressure");
        study.measured(format!("{name}.slide.ratio.{side}"), ratio);
    }
    let force = ["x", "y", "z"].map(|axis| at_end(&format!("resultant_a.{axis}")));
    let face = ContactFace::between(run, force.into());
    study.measured(format!("{name}.slide.forces"), face.ratio());
    study.measured(format!("{name}.slide.forces.flat"), face.flat_ratio());
    study.measured(format!("{name}.slide.tilt"), face.tilt());
    (face.ratio() - MU).abs()
}

/// Largest value of the nodes of the spherical face at the end of a step.
fn largest(run: &Run, step: usize, of: fn(&MeasuredNode) -> f64) -> f64 {
    pressed(run, step).iter().map(of).fold(0.0, f64::max)
}

/// Largest friction across the motion over the largest.
fn lateral(run: &Run, step: usize) -> f64 {
    let across = largest(run, step, |node| node.result.tau.y.abs());
    across / largest(run, step, |node| node.result.tau.norm())
}

/// Largest friction across the motion over the largest that can be, when sheared.
fn lateral_share(run: &Run) -> f64 {
    let across = largest(run, 1, |node| node.result.tau.y.abs());
    across / (MU * largest(run, 1, |node| node.result.pressure))
}

/// Largest friction over the largest that can be.
fn friction_share(run: &Run, step: usize) -> f64 {
    let friction = largest(run, step, |node| node.result.tau.norm());
    friction / (MU * largest(run, step, |node| node.result.pressure))
}

/// Nodes of the spherical face under pressure at the end of a step.
fn pressed(run: &Run, step: usize) -> Vec<MeasuredNode<'_>> {
    let mut nodes = surface_nodes_in(run, &run.finished.steps[step], Side::A);
    nodes.retain(|node| node.result.pressure > 0.0);
    nodes
}

/// A vector of a node.
type Vector = fn(&MeasuredNode) -> Vec3;

/// Friction above at the ends of the steps, slip of the last increment below, once
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
        for step in first..run.finished.steps.len() {
            let nodes = pressed(run, step);
            if nodes.iter().all(|node| vector(node) == Vec3::zeros()) {
                continue;
            }
            let places = |node: &MeasuredNode| [node.position.x, node.position.y];
            let vectors = nodes.iter().map(vector).map(|v| [v.x, v.y]);
            let content = Content::Arrows {
                origins: nodes.iter().map(places).collect(),
                vectors: vectors.collect(),
                unit: unit.to_owned(),
            };
            let axis = |label: &str| Axis::linear(label, "m").within(-2.5, 2.5);
            panels.push(
                Panel::plane(axis("x"), axis("y"))
                    .titled(format!("{} m sideways", WAYS[step]))
                    .with(Series::new(name, content).colored(color)),
            );
        }
    }
    Figure {
        columns: run.finished.steps.len(),
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
