//! `snake-scale`: a scaled block dragged forwards drifts sideways.
//!
//! Slip along `d = (cos delta, sin delta)` meets the friction `-varpi w(d)`. Free
//! sideways, the block takes the direction in which `w_y = 0`; held sideways,
//! `F_y/F_x = w_y/w_x` for `d = e_x`. Launched blocks follow the path of a point mass,
//!
//! ```text
//! dv/dt = -g (mu_2 + (mu_1 - mu_2) cos^2 phi),   v dphi/dt = g (mu_1 - mu_2) sin phi cos phi
//! ```
//!
//! with `phi` from the axis along which the coefficient is `mu_1`, or stop after
//! `v^2/(2 mu g)` where they are guided.

use striae_contact::side::Side;
use striae_figure::{Axis, Color, Content, Figure, Marker, Panel, Series, Width};
use striae_mesh::Vec3;
use striae_model::Increments;
use striae_solve::outcome::Ending;

use super::{
    measure::{MeasuredNode, surface_nodes},
    study::{Run, Study},
};
use crate::failure::Failure;

const DECKS: [(&str, &str); 4] = decks!("snake-scale": "drift", "held", "launched", "stop");
/// Coefficients along and across the texture under the launched block.
const ELLIPSE: [f64; 2] = [1.0, 0.5];
const LAUNCH: f64 = 60.0;
/// Name, direction of launch and coefficient of the nap.
const WAYS: [(&str, [f64; 2], f64); 3] = [
    ("forward", [0.0, 1.0], 0.3),
    ("backward", [0.0, -1.0], 0.6),
    ("lateral", [1.0, 0.0], 0.4),
];
const CONSTANTS: [f64; 3] = [0.1, 0.1, 0.5];
/// Angles of the scales as seen from the block, in degrees.
const SCALES: [f64; 2] = [0.0, 45.0];
/// Forward positions at which the path is drawn; the decks continue to 1.
const STATIONS: [f64; 5] = [0.1, 0.2, 0.4, 0.6, 0.8];

/// Runs the case.
pub fn run(study: &mut Study) -> Result<(), Failure> {
    study.measured("drift.closed_form", drift());
    let [drift, held] = [ran(study, DECKS[0])?, ran(study, DECKS[1])?];
    let slip = mean_slip(&drift);
    study.measured("drift.angle", slip.y.atan2(slip.x).to_degrees());
    let force = |axis: &str| {
        let force = held.at_end_of(2, &format!("pair.base.resultant_a.{axis}"));
        force / held.at_end_of(2, "pair.base.pressure_integral_a")
    };
    study.measured("held.ratio", force("y") / force("x"));
    let mut least = f64::INFINITY;
    for run in [&drift, &held] {
        let dissipated = run.column("pair.base.dissipated");
        let steps = dissipated.windows(2).map(|pair| pair[1] - pair[0]);
        least = steps.fold(least, f64::min);
    }
    study.measured("dissipation.least", least);
    let mut path = vec![[0.0, 0.0]];
    for way in STATIONS {
        path.push(middle(&ran_until(study, DECKS[0], way)?));
    }
    path.push(middle(&drift));
    let figure = Figure::new(Width::Page, vec![paths(path, &held), tractions(&drift)]);
    study.draw(&figure, "drift")?;
    launched(study)
}

/// Blocks that are launched and come to rest.
fn launched(study: &mut Study) -> Result<(), Failure> {
    let run = ran(study, DECKS[2])?;
    let (found, expected) = (path(&run), point_mass());
    let (end, rest) = (found[found.len() - 1], expected[expected.len() - 1]);
    study.measured("launched.x", end[1]);
    study.measured("launched.y", end[2]);
    study.measured("launched.time", stop(&found));
    let off = found.iter().map(|at| distance(at, &expected));
    let way = rest[1].hypot(rest[2]);
    study.measured("launched.deviation", off.fold(0.0, f64::max) / way);
    let mut accounts = vec![account(&run)];
    let mut speeds = Vec::new();
    for (name, [x, y], mu) in WAYS {
        let run = guided(study, name, [x, y])?;
        let path = path(&run);
        let end = path[path.len() - 1];
        study.measured(format!("stop.{name}"), end[1].hypot(end[2]));
        accounts.push(account(&run));
        speeds.push((name, path, mu));
    }
    let worst = |at: usize| {
        accounts
            .iter()
            .map(|account| account[at])
            .fold(0.0, f64::max)
    };
    study.measured("energy.imbalance", worst(0));
    study.measured("energy.growth", worst(1));
    let figure = Figure::new(
        Width::Page,
        vec![sliding(&found, &expected), stopping(&speeds)],
    );
    study.draw(&figure, "launched")
}

/// Largest imbalance of energy, and largest growth of mechanical energy in an
/// increment beyond the work done, over the launching energy.
fn account(run: &Run) -> [f64; 2] {
    let external = run.column("energy.external");
    let scale = run.largest("energy.external");
    let (kinetic, strain) = (run.column("energy.kinetic"), run.column("energy.strain"));
    let surplus: Vec<f64> = (0..external.len())
        .map(|at| kinetic[at] + strain[at] - external[at])
        .collect();
    let growth = surplus.windows(2).map(|pair| pair[1] - pair[0]);
    [
        run.largest("energy.imbalance") / scale,
        growth.fold(0.0, f64::max) / scale,
    ]
}

/// Time, x and y of the middle of the launched block since its launch.
fn path(run: &Run) -> Vec<[f64; 3]> {
    let (time, step) = (run.column("time"), run.column("step"));
    let (x, y) = (run.column("centre.block.x"), run.column("centre.block.y"));
    let start = step.iter().rposition(|&step| step == 1.0).unwrap_or(0);
    (start..time.len())
        .map(|at| [time[at] - time[start], x[at] - x[start], y[at] - y[start]])
        .collect()
}

/// Time at which the block comes to rest, by its deceleration from a tenth to a twentieth of the
/// launching speed, one: the very end is lost in vibrations of the elastic block.
fn stop(path: &[[f64; 3]]) -> f64 {
    let speeds: Vec<[f64; 2]> = path
        .windows(2)
        .map(|pair| {
            let [from, to] = [pair[0], pair[1]];
            let way = (to[1] - from[1]).hypot(to[2] - from[2]);
            [0.5 * (from[0] + to[0]), way / (to[0] - from[0])]
        })
        .collect();
    let reached = |speed: f64| {
        let pair = speeds.windows(2).find(|pair| pair[1][1] < speed);
        pair.map_or(f64::NAN, |pair| {
            let [[t, v], [next, slower]] = [pair[0], pair[1]];
            t + (next - t) * (v - speed) / (v - slower)
        })
    };
    2.0 * reached(0.05) - reached(0.1)
}

fn guided(study: &mut Study, name: &str, direction: [f64; 2]) -> Result<Run, Failure> {
    let (deck, text) = DECKS[3];
    let mut deck = study.deck(deck, text)?;
    let step = &mut deck.model.steps[1];
    step.velocities[0].velocity = Vec3::new(direction[0], direction[1], 0.0);
    step.displacements[0].components = match direction {
        [0.0, _] => [Some(0.0.into()), None, None],
        _ => [None, Some(0.0.into()), None],
    };
    study.run(name, deck)
}

/// Time, x and y of the point mass until it rests, by Heun's method in steps small
/// enough not to matter.
fn point_mass() -> Vec<[f64; 3]> {
    const STEP: f64 = 1e-4;
    let [along, across] = ELLIPSE;
    let rates = |[speed, angle]: [f64; 2]| {
        let (sin, cos) = angle.sin_cos();
        [
            -(across + (along - across) * cos * cos),
            (along - across) * sin * cos / speed,
        ]
    };
    let mut at = [1.0, LAUNCH.to_radians()];
    let mut path = vec![[0.0; 3]];
    while at[0] > STEP {
        let first = rates(at);
        let guess = [at[0] + STEP * first[0], at[1] + STEP * first[1]];
        let second = rates(guess);
        let next = [0, 1].map(|i| at[i] + 0.5 * STEP * (first[i] + second[i]));
        let [time, x, y] = path[path.len() - 1];
        let mean = |f: fn(f64) -> f64| 0.5 * STEP * (at[0] * f(at[1]) + next[0] * f(next[1]));
        path.push([time + STEP, x + mean(f64::cos), y + mean(f64::sin)]);
        at = next;
    }
    path
}

/// Distance of a place from where the point mass is at that time.
fn distance(at: &[f64; 3], path: &[[f64; 3]]) -> f64 {
    let next = path
        .partition_point(|known| known[0] < at[0])
        .min(path.len() - 1);
    (at[1] - path[next][1]).hypot(at[2] - path[next][2])
}

fn sliding(found: &[[f64; 3]], expected: &[[f64; 3]]) -> Panel {
    let points = |path: &[[f64; 3]], every: usize| {
        let kept = path.iter().step_by(every).chain(path.last());
        kept.map(|at| [at[1], at[2]]).collect::<Vec<_>>()
    };
    let axis = |label: &str| Axis::linear(label, "v²/g").within(-0.05, 0.9);
    Panel::plane(axis("x"), axis("y"))
        .titled("launched at 60 degrees")
        .with(Series::new("point mass", Content::line(points(expected, 50))).colored(Color::Grey))
        .with(
            Series::new("block", Content::markers(points(found, 20), Marker::Circle))
                .colored(Color::Blue),
        )
}

fn stopping(runs: &[(&str, Vec<[f64; 3]>, f64)]) -> Panel {
    let colors = [Color::Green, Color::Vermillion, Color::Blue];
    let mut panel = Panel::new(
        Axis::linear("time", "v/g").within(0.0, 4.0),
        Axis::linear("way", "v²/g").within(0.0, 1.8),
    )
    .titled("with, against and across the nap");
    for ((name, path, mu), color) in runs.iter().zip(colors) {
        let way = |time: f64| {
            let time = time.min(1.0 / mu);
            time - 0.5 * mu * time * time
        };
        let exact = (0..=100)
            .map(|at| 0.04 * f64::from(at))
            .map(|t| [t, way(t)]);
        let found = path
            .iter()
            .step_by(40)
            .map(|at| [at[0], at[1].hypot(at[2])]);
        panel = panel
            .with(Series::new("", Content::line(exact.collect())).colored(Color::Grey))
            .with(
                Series::new(*name, Content::markers(found.collect(), Marker::Circle))
                    .colored(color),
            );
    }
    panel
}

fn ran(study: &mut Study, (name, text): (&str, &str)) -> Result<Run, Failure> {
    let deck = study.deck(name, text)?;
    study.run(name, deck)
}

/// Runs the first increments of a deck, until the block has gone forward by
/// `way`. They are judged in the whole run.
fn ran_until(study: &mut Study, (name, text): (&str, &str), way: f64) -> Result<Run, Failure> {
    let mut deck = study.deck(name, text)?;
    let drag = &mut deck.model.steps[1];
    drag.displacements[0].components[0] = Some(way.into());
    let size = drag.increments.largest / way;
    drag.increments = Increments {
        initial: size,
        largest: size,
        ..drag.increments
    };
    let run = study.run_to_limit(&format!("{name}-{way}"), deck)?;
    match run.finished.ending {
        Ending::Completed => Ok(run),
        ending => Err(Failure::Ended(Box::new(ending))),
    }
}

/// `w(d)` for slip at an angle in degrees.
fn friction(degrees: f64) -> Vec3 {
    let [c_mag, c_ang, c_cen] = CONSTANTS;
    let d = along(degrees);
    let [own, opposite] = SCALES.map(along);
    let (sum, i0) = (own + opposite, own.dot(&opposite));
    d * (1.0 + c_mag * i0) + sum * (c_ang * (1.0 + i0) * (c_cen + sum.dot(&d)))
}

/// The angle in degrees at which `w_y = 0`, by bisection.
fn drift() -> f64 {
    let (mut low, mut high) = (-45.0, 0.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if friction(middle).y < 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    low
}

fn along(degrees: f64) -> Vec3 {
    let angle = degrees.to_radians();
    Vec3::new(angle.cos(), angle.sin(), 0.0)
}

/// Mean slip of the base in the last increment.
fn mean_slip(run: &Run) -> Vec3 {
    let nodes = surface_nodes(run, Side::A);
    let sum: Vec3 = nodes.iter().map(|node| node.result.slip).sum();
    sum / nodes.len() as f64
}

/// Way of the middle of the base.
fn middle(run: &Run) -> [f64; 2] {
    let nodes = surface_nodes(run, Side::A);
    let ways = nodes.iter().map(|node| node.position - node.reference);
    let mean = ways.sum::<Vec3>() / nodes.len() as f64;
    [mean.x, mean.y]
}

fn paths(path: Vec<[f64; 2]>, held: &Run) -> Panel {
    let way = |degrees: f64| vec![[0.0, 0.0], [1.0, degrees.to_radians().tan()]];
    let axis = |label: &str| Axis::linear(label, "");
    Panel::plane(axis("x").within(-0.05, 1.1), axis("y").within(-0.45, 0.45))
        .titled("path of the block")
        .with(Series::new("w.y = 0", Content::line(way(drift()))).colored(Color::Grey))
        .with(
            Series::new("free sideways", Content::markers(path, Marker::Circle))
                .colored(Color::Blue),
        )
        .with(
            Series::new(
                "held sideways",
                Content::markers(vec![middle(held)], Marker::Square),
            )
            .colored(Color::Vermillion),
        )
        .with(scales(SCALES[0], "scales of the block", Color::Green))
        .with(scales(
            SCALES[1],
            "of the plane, from the block",
            Color::Purple,
        ))
}

/// An arrow along scales, from the origin.
fn scales(degrees: f64, name: &str, color: Color) -> Series {
    let tip = along(degrees) * 0.3;
    let line = Content::line(vec![[0.1, 0.15], [0.1 + tip.x, 0.15 + tip.y]]);
    Series::new(name, line).colored(color)
}

fn tractions(drift: &Run) -> Panel {
    let nodes = surface_nodes(drift, Side::A);
    let back = middle(drift);
    let origins = |node: &MeasuredNode| [node.position.x - back[0], node.position.y - back[1]];
    let arrows = |vector: &dyn Fn(&MeasuredNode) -> Vec3| {
        let vectors = nodes.iter().map(vector);
        Content::Arrows {
            origins: nodes.iter().map(origins).collect(),
            vectors: vectors.map(|v| [v.x, v.y]).collect(),
            unit: String::new(),
        }
    };
    let axis = |label: &str| Axis::linear(label, "").within(-0.2, 1.2);
    Panel::plane(axis("x"), axis("y"))
        .titled("base at the end, free sideways")
        .with(Series::new("slip", arrows(&|node| node.result.slip)).colored(Color::Blue))
        .with(Series::new("friction", arrows(&|node| node.result.tau)).colored(Color::Vermillion))
}
