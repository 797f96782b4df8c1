//! `tyre-belt`: a tyre with a belt of crossed cords is pressed onto a textured road and
//! dragged over it, beside the same tyre without cords.
//!
//! In full slip along the travel friction is, over the vertical force, `m_s cos^2 + m_a
//! sin^2` backward and `(m_a - m_s) sin cos` sideways, for grooves of the road at an angle to
//! the travel, whatever the tyre is made of. The patch is at most as long as the chord
//! `2 sqrt(2 R w - w^2)` that the road cuts from the circle when it is lowered by `w`.

use striae_contact::side::Side;
use striae_figure::{Axis, Color, Content, Figure, Panel, Series, Width};
use striae_mesh::Vec3;
use striae_solve::state::State;

use super::{
    measure::{law_error, surface_nodes_in},
    study::{Extent, Run, Study},
    tyre::{areas, shapes},
};
use crate::failure::Failure;

const DECKS: [(&str, &str); 1] = decks!("tyre-belt": "deck");
/// Elements in the deck and for a quick look.
const DIVISIONS: [&str; 2] = [
    "divisions = [6, 50, 4], radial_grading = { lengths = [7, 6, 6, 2, 2, 3] }",
    "divisions = [5, 40, 3], radial_grading = { lengths = [10, 9, 2, 2, 3] }",
];
/// Angle of the grooves to the travel.
const GROOVES: f64 = 45.0;
const RADIUS: f64 = 0.5;
const LOWERED: f64 = 0.05;
/// Radius in the middle of the belt.
const BELT: f64 = 0.4423;

/// Runs the case.
pub fn run(study: &mut Study) -> Result<(), Failure> {
    let belted = ran(study, "belted", None)?;
    let plain = ran(
        study,
        "plain",
        Some(["material = \"belt\"\nmesh", "material = \"rubber\"\nmesh"]),
    )?;
    let force = |run: &Run, axis: &str| run.at_end_of(2, &format!("pair.patch.resultant_a.{axis}"));
    let chord = 2.0 * (2.0 * RADIUS * LOWERED - LOWERED * LOWERED).sqrt();
    for (run, name) in [(&belted, "belted"), (&plain, "plain")] {
        let pressed = run.at_end_of(1, "pair.patch.resultant_a.z");
        study.measured(format!("{name}.force"), pressed);
        study.measured(format!("{name}.length"), length(run) / chord);
        study.measured(
            format!("{name}.backward"),
            -force(run, "x") / force(run, "z"),
        );
        study.measured(
            format!("{name}.sideways"),
            force(run, "y") / force(run, "z"),
        );
    }
    let stiffer = |name: &str| belted.at_end_of(1, name) / plain.at_end_of(1, name);
    study.measured("stiffer", stiffer("pair.patch.resultant_a.z"));
    let runs = [&belted, &plain];
    let worst = |of: fn(&Run) -> f64| runs.map(of).into_iter().fold(0.0, f64::max);
    study.measured("hoop", hoop(&belted) / hoop(&plain));
    study.measured("law", worst(|run| law_error(run, 0, Some(grooves()))));
    study.measured("balance", worst(balance));
    study.measured(
        "energy.imbalance",
        worst(|run| run.largest("energy.imbalance") / run.largest("energy.external")),
    );
    draw(study, &belted, &plain)
}

fn ran(study: &mut Study, name: &str, change: Option<[&str; 2]>) -> Result<Run, Failure> {
    let [(file, text)] = DECKS;
    let mut passages: Vec<[&str; 2]> = change.into_iter().collect();
    if study.extent == Extent::Quick {
        passages.push(DIVISIONS);
    }
    let deck = study.variant(file, text, &passages)?;
    study.run(name, deck)
}

fn grooves() -> Vec3 {
    let (sin, cos) = GROOVES.to_radians().sin_cos();
    Vec3::new(cos, sin, 0.0)
}

/// The state after pressing.
fn pressed_state(run: &Run) -> &State {
    &run.finished.steps[0]
}

/// Length of the patch: that of a uniform pressure with the same spread along the travel,
/// `sqrt(12)` of it in the mean square.
fn length(run: &Run) -> f64 {
    let state = pressed_state(run);
    let nodes = surface_nodes_in(run, state, Side::A);
    let shares = nodes.iter().zip(areas(run, state)).map(|(node, area)| {
        let force = area * node.result.mean_pressure().max(0.0);
        [
            force,
            force * node.position.x,
            force * node.position.x.powi(2),
        ]
    });
    let sum = shares.fold([0.0; 3], |sum, share| {
        [0, 1, 2].map(|at| sum[at] + share[at])
    });
    let [force, first, second] = sum;
    (12.0 * (second / force - (first / force).powi(2))).sqrt()
}

/// Strain around the axis in the middle of the belt.
fn hoop(run: &Run) -> f64 {
    let problem = &run.finished.problem;
    let state = pressed_state(run);
    let places = problem.reference.iter().zip(&state.positions);
    let of_belt = places.filter(|(rest, _)| (rest.x.hypot(rest.z) - BELT).abs() < 1e-3);
    let mut nodes: Vec<(Vec3, Vec3)> = of_belt.map(|(rest, x)| (*rest, *x)).collect();
    let middle = nodes
        .iter()
        .map(|(rest, _)| rest.y.abs())
        .fold(f64::INFINITY, f64::min);
    nodes.retain(|(rest, _)| (rest.y - middle).abs() < 1e-9);
    let angle = |(rest, _): &(Vec3, Vec3)| rest.z.atan2(rest.x);
    nodes.sort_by(|a, b| angle(a).total_cmp(&angle(b)));
    let next = nodes.iter().cycle().skip(1);
    let edges = nodes.iter().zip(next);
    let lengths = edges.map(|(a, b)| [(b.0 - a.0).norm(), (b.1 - a.1).norm()]);
    let [rest, now] = lengths.fold([0.0; 2], |sum, edge| [sum[0] + edge[0], sum[1] + edge[1]]);
    now / rest - 1.0
}

/// Difference of the force on the rim from that of the road, over the latter.
fn balance(run: &Run) -> f64 {
    let sum = ["x", "y", "z"].map(|axis| {
        run.at_end_of(2, &format!("reaction.rim.{axis}"))
            + run.at_end_of(2, &format!("pair.patch.resultant_a.{axis}"))
    });
    Vec3::from(sum).norm() / run.at_end_of(2, "pair.patch.resultant_a.z")
}

fn draw(study: &mut Study, belted: &Run, plain: &Run) -> Result<(), Failure> {
    let x = || Axis::linear("x", "m").within(-0.6, 1.2);
    let sides = [(belted, "with a belt"), (plain, "without")].map(|(run, title)| {
        let states: Vec<&State> = run.finished.steps.iter().collect();
        shapes(run, &states, x()).titled(title)
    });
    let mut figure = Figure::new(Width::Page, sides.to_vec());
    figure.columns = 2;
    study.draw(&figure, "shapes")?;
    let mut forces = Panel::new(
        Axis::linear("way of the rim, down and forward", "m"),
        Axis::linear("force on the tyre", "kN"),
    );
    let columns = [
        ("vertical", "z", 1e3),
        ("backward", "x", -1e3),
        ("sideways", "y", 1e3),
    ];
    for ((name, axis, sign), color) in
        columns
            .into_iter()
            .zip([Color::Black, Color::Blue, Color::Green])
    {
        for (run, dashed) in [(belted, false), (plain, true)] {
            let (x, z) = (
                run.column("displacement.rim.x"),
                run.column("displacement.rim.z"),
            );
            let ways = x.iter().zip(z).map(|(x, z)| x - z);
            let force = run.column(&format!("pair.patch.resultant_a.{axis}"));
            let points = ways
                .zip(force)
                .map(|(way, force)| [way, sign * force])
                .collect();
            let (name, line) = match dashed {
                true => ("", Content::dashed(points)),
                false => (name, Content::line(points)),
            };
            forces = forces.with(Series::new(name, line).colored(color));
        }
    }
    let forces = forces.titled("with a belt; dashed without");
    let figure = Figure::new(Width::Page, vec![forces, along(belted, plain)]);
    study.draw(&figure, "forces")
}

/// Mean pressure along the patch in its middle plane, after pressing.
fn along(belted: &Run, plain: &Run) -> Panel {
    let line = |run: &Run| {
        let nodes = surface_nodes_in(run, pressed_state(run), Side::A);
        let least = nodes
            .iter()
            .map(|node| node.reference.y.abs())
            .fold(f64::INFINITY, f64::min);
        let middle = nodes.iter().filter(|node| {
            node.reference.y >= 0.0 && node.reference.y < least + 1e-9 && node.reference.z < 0.0
        });
        let mut points: Vec<[f64; 2]> = middle
            .map(|node| [node.position.x, node.result.mean_pressure()])
            .collect();
        points.sort_by(|a, b| a[0].total_cmp(&b[0]));
        points
    };
    Panel::new(
        Axis::linear("x", "m").within(-0.3, 0.3),
        Axis::linear("pressure", "MPa"),
    )
    .titled("pressed")
    .with(Series::new("with a belt", Content::line(line(belted))).colored(Color::Blue))
    .with(Series::new("without", Content::dashed(line(plain))).colored(Color::Vermillion))
}
