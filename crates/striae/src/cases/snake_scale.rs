//! `snake-scale`: a scaled block dragged forwards drifts sideways.
//!
//! Slip along `d = (cos delta, sin delta)` meets the friction `-varpi w(d)`. Free
//! sideways, the block takes the direction in which `w_y = 0`; held sideways,
//! `F_y/F_x = w_y/w_x` for `d = e_x`.

use striae_io::figure::{Axis, Color, Content, Figure, Marker, Panel, Series, Width};
use striae_mesh::Vec3;
use striae_solve::{model::Increments, outcome::Ending};

use super::{
    measure::{SurfaceNode, surface_nodes},
    study::{Run, Study},
};
use crate::failure::Failure;

const DECKS: [(&str, &str); 2] = decks!("snake-scale": "drift", "held");
const CONSTANTS: [f64; 3] = [0.1, 0.1, 0.5];
/// Angles of the scales as seen from the block, in degrees.
const SCALES: [f64; 2] = [0.0, 45.0];
/// Forward ways at which the path is drawn; the decks go on to 1.
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
    study.draw(&figure, "drift")
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
    drag.displacements[0].components[0] = Some(way);
    let size = drag.increments.largest / way;
    drag.increments = Increments {
        initial: size,
        largest: size,
        ..drag.increments
    };
    let run = study.run_to_limit(&format!("{name}-{way}"), deck)?;
    match run.simulation.ending {
        Ending::Completed => Ok(run),
        ending => Err(Failure::Ended(ending)),
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
    let nodes = surface_nodes(run, 0);
    let sum: Vec3 = nodes.iter().map(|node| node.result.slip).sum();
    sum / nodes.len() as f64
}

/// Way of the middle of the base.
fn middle(run: &Run) -> [f64; 2] {
    let nodes = surface_nodes(run, 0);
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
    let nodes = surface_nodes(drift, 0);
    let back = middle(drift);
    let origins = |node: &SurfaceNode| [node.position.x - back[0], node.position.y - back[1]];
    let arrows = |vector: &dyn Fn(&SurfaceNode) -> Vec3| {
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
