//! `tyre-pressed`: a tyre pressed onto a road and pushed over it without turning.
//!
//! Runs the deck with scales 45 degrees apart, 135 degrees apart and with isotropic
//! friction. At the end all nodes slide, so the resultant of friction is the law over
//! the pressure found, `-mu sum A p w(d)` with slip and textures at the nodes.

use std::f64::consts::FRAC_PI_4;

use striae_contact::side::Side;
use striae_figure::{Axis, Color, Content, Figure, Panel, Series, Width};
use striae_law::friction::Friction;
use striae_mesh::Vec3;
use striae_solve::state::State;
use striae_surface::texture::{Field, Lines, Paint};

use super::{
    measure::surface_nodes_in,
    study::{Run, Study},
    tyre::{ROADS, areas, arrows, deck, friction, pressures, shapes},
};
use crate::failure::Failure;

const DECKS: [(&str, &str); 1] = decks!("tyre-pressed": "deck");
const MU: f64 = 0.5;

/// Runs the case.
pub fn run(study: &mut Study) -> Result<(), Failure> {
    let near = ran(study, "45")?;
    let far = ran(study, "135")?;
    let isotropic = ran(study, "isotropic")?;
    let vertical = near.column("pair.patch.resultant_a.z");
    study.measured(
        "vertical.pressed",
        near.at_end_of(1, "pair.patch.resultant_a.z"),
    );
    study.measured(
        "vertical.pushed",
        near.at_end_of(4, "pair.patch.resultant_a.z"),
    );
    let steps = near.column("step");
    let sliding = steps
        .iter()
        .zip(&vertical)
        .filter(|(step, _)| **step >= 3.0);
    let sliding: Vec<f64> = sliding.map(|(_, force)| *force).collect();
    let mean = sliding.iter().sum::<f64>() / sliding.len() as f64;
    let off = sliding.iter().map(|force| (force / mean - 1.0).abs());
    study.measured("vertical.unsteady", off.fold(0.0, f64::max));
    for (run, name, road) in [(&near, "45", ROADS[0]), (&far, "135", ROADS[1])] {
        let pressing = run.at_end_of(4, "pair.patch.pressure_integral_a");
        let law = law(run, &run.finished.state, road) * pressing;
        for (axis, law) in [("x", law.x), ("y", law.y)] {
            let found = run.at_end_of(4, &format!("pair.patch.resultant_a.{axis}"));
            study.measured(format!("plateau.{name}.{axis}"), found);
            let off = (found - law).abs() / (MU * pressing);
            study.measured(format!("law.{name}.{axis}"), off);
        }
    }
    let sideways = isotropic.largest("pair.patch.resultant_a.y");
    study.measured("isotropic.lateral", sideways / mean);
    draw(study, &near, &far, &isotropic)
}

fn ran(study: &mut Study, name: &str) -> Result<Run, Failure> {
    let [(file, text)] = DECKS;
    let mut deck = deck(study, file, text)?;
    let pair = &mut deck.model.pairs[0];
    match name {
        "135" => {
            pair.textures[1] = Some(Paint::Field(Field {
                lines: Lines::Uniform(Vec3::x()),
                turn: FRAC_PI_4,
            }));
        }
        "isotropic" => {
            pair.textures = [None, None];
            pair.friction = Friction::coulomb(MU).expect("a coefficient of friction");
        }
        _ => {}
    }
    study.run(name, deck)
}

/// Mean friction by the law for slip as found, over the mean pressure.
///
/// The mean over nodes, each with its pressure and area, stands for that over the field.
fn law(run: &Run, state: &State, road: Vec3) -> Vec3 {
    let nodes = surface_nodes_in(run, state, Side::A);
    let (mut sum, mut force) = (Vec3::zeros(), 0.0);
    for (node, area) in nodes.iter().zip(areas(run, state)) {
        let result = node.result;
        let pressed = area * result.pressure.max(0.0);
        let a = result.normal.cross(&result.texture);
        if let Some(d) = result.slip.try_normalize(0.0) {
            sum -= friction(a, road, d) * (MU * pressed);
        }
        force += pressed;
    }
    sum / force
}

fn draw(study: &Study, near: &Run, far: &Run, isotropic: &Run) -> Result<(), Failure> {
    let states: Vec<&State> = near.finished.steps.iter().collect();
    let x = Axis::linear("x", "m").within(-0.6, 1.5);
    let shapes = shapes(near, &states, x).titled("after 0, 0.3, 0.6 and 0.9 m");
    study.draw(&Figure::new(Width::Page, vec![shapes]), "shapes")?;
    let forces = vec![reactions(near, far, isotropic)];
    study.draw(&Figure::new(Width::Page, forces), "reactions")?;
    let last = &near.finished.state;
    let patch = vec![pressures(near, last), arrows(near, last)];
    study.draw(&Figure::new(Width::Page, patch), "patch")
}

fn reactions(near: &Run, far: &Run, isotropic: &Run) -> Panel {
    let line = |run: &Run, axis: &str, sign: f64| {
        let ways = run.column("displacement.rim.x");
        let down = run.column("displacement.rim.z");
        let force = run.column(&format!("pair.patch.resultant_a.{axis}"));
        let points = ways.iter().zip(down).zip(force);
        // The way of the rim: down, then forward.
        Content::line(points.map(|((x, z), f)| [x - z, sign * f]).collect())
    };
    let dashed = |run: &Run, axis: &str, sign: f64| match line(run, axis, sign) {
        Content::Curve { points, .. } => Content::dashed(points),
        other => other,
    };
    Panel::new(
        Axis::linear("way of the rim, down and forward", "m").within(0.0, 1.0),
        Axis::linear("force on the tyre", "MN"),
    )
    .with(Series::new("vertical", line(near, "z", 1.0)).colored(Color::Black))
    .with(Series::new("backward, 45°", line(near, "x", -1.0)).colored(Color::Blue))
    .with(Series::new("lateral", line(near, "y", -1.0)).colored(Color::Green))
    .with(Series::new("backward, 135°", dashed(far, "x", -1.0)).colored(Color::Blue))
    .with(Series::new("lateral", dashed(far, "y", -1.0)).colored(Color::Green))
    .with(Series::new("backward, isotropic", line(isotropic, "x", -1.0)).colored(Color::Grey))
}
