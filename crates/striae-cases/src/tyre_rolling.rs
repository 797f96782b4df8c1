//! `tyre-rolling`: a tyre whose axle is guided rolls over a road and hardly drifts.
//!
//! The tread lies still on the road where it sticks, so the wheel turns by the way of
//! its axle over an effective radius, which is the free one times the stretch of the
//! tread along the travel.

use striae_contact::{side::Side, unknowns::Status};
use striae_figure::{Axis, Color, Content, Figure, Panel, Series, Width};
use striae_mesh::Vec3;
use striae_solve::state::State;

use super::{
    measure::{facets, surface_nodes},
    study::{Run, Study},
    tyre::{account, arrows, deck, drift, pressures, shapes},
    tyre_locked::path,
};
use crate::failure::Failure;

const DECKS: [(&str, &str); 1] = decks!("tyre-rolling": "deck");

/// Runs the case.
pub fn run(study: &mut Study) -> Result<(), Failure> {
    let [(name, text)] = DECKS;
    let deck = deck(study, name, text)?;
    let run = study.run(name, deck)?;
    let way = path(&run);
    let end = way[way.len() - 1];
    let locked = end[0] * drift().to_radians().tan();
    study.measured("drift.way", end[1]);
    study.measured("drift.over_locked", (end[1] / locked).abs());
    let (radius, stretched) = (radius(&run), stretched(&run));
    study.measured("radius.effective", radius);
    study.measured("radius.ratio", radius / stretched);
    study.measured("stick.share", sticking(&run));
    account(study, &run);
    let last = &run.finished.state;
    let states: Vec<&State> = run.finished.steps.iter().collect();
    let x = Axis::linear("x", "m").within(-0.6, 1.5);
    let figure = vec![shapes(&run, &states, x).titled("pressed, and after 0.9 m")];
    study.draw(&Figure::new(Width::Page, figure), "shapes")?;
    study.draw(
        &Figure::new(Width::Page, rolling(&run, locked, stretched)),
        "rolling",
    )?;
    let patch = vec![pressures(&run, last), arrows(&run, last)];
    study.draw(&Figure::new(Width::Page, patch), "patch")
}

/// Way of the axle over angle, in the second half of the way.
fn radius(run: &Run) -> f64 {
    let (way, angle) = (run.column("displacement.rim.x"), run.column("angle.rim.y"));
    let (middle, last) = (way.len() / 2, way.len() - 1);
    (way[last] - way[middle]) / (angle[last] - angle[middle]).to_radians()
}

/// Radius of the tread times its stretch along the travel, over the sticking nodes.
fn stretched(run: &Run) -> f64 {
    let nodes = surface_nodes(run, Side::A);
    let angle = |x: &Vec3| x.x.atan2(-x.z);
    let (mut ways, mut angles) = (0.0, 0.0);
    for facet in facets(run, Side::A) {
        for edge in 0..4 {
            let [from, to] = [edge, (edge + 1) % 4].map(|at| &nodes[facet[at]]);
            let both = [from, to].map(|node| node.result.status == Status::Stick);
            let along = (to.reference.y - from.reference.y).abs() < 1e-9;
            let turned = angle(&to.reference) - angle(&from.reference);
            if both == [true; 2] && along && turned.abs() < 1.0 {
                ways += (to.position.x - from.position.x).abs();
                angles += turned.abs();
            }
        }
    }
    ways / angles
}

/// Share of the nodes in contact that stick.
fn sticking(run: &Run) -> f64 {
    let nodes = surface_nodes(run, Side::A);
    let count = |status: Status| {
        let of = nodes.iter().filter(|node| node.result.status == status);
        of.count() as f64
    };
    let (stick, slip) = (count(Status::Stick), count(Status::Slip));
    stick / (stick + slip)
}

fn rolling(run: &Run, locked: f64, stretched: f64) -> Vec<Panel> {
    let way = run.column("displacement.rim.x");
    let angle = run.column("angle.rim.y");
    let end = way[way.len() - 1];
    let turned = way.iter().zip(angle).map(|(x, angle)| [*x, angle]);
    let line = |radius: f64| vec![[0.0, 0.0], [end, (end / radius).to_degrees()]];
    let x = || Axis::linear("way of the axle", "m").within(0.0, 0.9);
    let turning = Panel::new(
        x(),
        Axis::linear("angle of the wheel", "deg").within(0.0, 140.0),
    )
    .with(Series::new("wheel", Content::line(turned.collect())).colored(Color::Blue))
    .with(Series::new("stretched tread", Content::dashed(line(stretched))).colored(Color::Black))
    .with(Series::new("free radius", Content::dashed(line(0.5))).colored(Color::Grey));
    let drifting = Panel::new(x(), Axis::linear("drift", "m").within(-0.25, 0.05))
        .with(Series::new("rolling", Content::line(path(run))).colored(Color::Blue))
        .with(
            Series::new(
                "locked, w.y = 0",
                Content::dashed(vec![[0.0, 0.0], [end, locked]]),
            )
            .colored(Color::Grey),
        );
    vec![turning, drifting]
}
