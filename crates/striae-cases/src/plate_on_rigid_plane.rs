//! `plate-on-rigid-plane`: partial slip under a plate that is pushed along a floor.

use striae_contact::{side::Side, unknowns::Status};
use striae_figure::{Axis, Color, Content, Figure, Marker, Panel, Series, Width};

use super::{
    measure::{MeasuredNode, surface_nodes},
    study::{Run, Study},
};
use crate::failure::Failure;

const DECKS: [(&str, &str); 1] = decks!("plate-on-rigid-plane": "deck");
/// Published displacements: place in mm, displacement in micrometres.
const PUBLISHED: [[f64; 2]; 5] = [
    [0.0, 28.6],
    [1.25, 27.2],
    [5.0, 22.8],
    [7.5, 19.8],
    [11.25, 15.0],
];

/// Runs the case.
pub fn run(study: &mut Study) -> Result<(), Failure> {
    let [(name, text)] = DECKS;
    let deck = study.deck(name, text)?;
    let run = study.run(name, deck)?;
    let floor = along_floor(&run);
    for [place, _] in PUBLISHED {
        study.measured(format!("ux.{place}"), displacement(&floor, place));
    }
    study.measured("stick.from", stick_from(&floor));
    study.draw(&figure(&floor), "along-the-floor")
}

/// Nodes of the front edge on the floor, from left to right.
fn along_floor(run: &Run) -> Vec<MeasuredNode<'_>> {
    let mut nodes = surface_nodes(run, Side::A);
    nodes.retain(|node| node.reference.y == 0.0);
    nodes.sort_by(|a, b| a.reference.x.total_cmp(&b.reference.x));
    nodes
}

/// Displacement in micrometres at a place between two nodes.
fn displacement(floor: &[MeasuredNode], place: f64) -> f64 {
    let moved = |node: &MeasuredNode| 1e3 * (node.position.x - node.reference.x);
    let pair = floor
        .windows(2)
        .find(|pair| (pair[0].reference.x..=pair[1].reference.x).contains(&place));
    pair.map_or(f64::NAN, |pair| {
        let [left, right] = [&pair[0], &pair[1]];
        let share = (place - left.reference.x) / (right.reference.x - left.reference.x);
        (1.0 - share) * moved(left) + share * moved(right)
    })
}

/// Middle between the last slipping and the first sticking node.
fn stick_from(floor: &[MeasuredNode]) -> f64 {
    let first = floor
        .iter()
        .position(|node| node.result.status == Status::Stick);
    match first {
        Some(at) if at > 0 => 0.5 * (floor[at - 1].reference.x + floor[at].reference.x),
        _ => f64::NAN,
    }
}

fn figure(floor: &[MeasuredNode]) -> Figure {
    let along = |value: fn(&MeasuredNode) -> f64| {
        let points = floor.iter().map(|node| [node.reference.x, value(node)]);
        Content::line(points.collect())
    };
    let x = || Axis::linear("x", "mm").within(0.0, 40.0);
    let displacements = Panel::new(x(), Axis::linear("displacement", "µm").within(0.0, 30.0))
        .with(Series::new(
            "computed",
            along(|node| 1e3 * (node.position.x - node.reference.x)),
        ))
        .with(
            Series::new(
                "SSNV128",
                Content::markers(PUBLISHED.to_vec(), Marker::Circle),
            )
            .colored(Color::Black),
        );
    let tractions = Panel::new(x(), Axis::linear("traction", "MPa").within(0.0, 100.0))
        .with(Series::new("pressure", along(|node| node.result.pressure)))
        .with(Series::new(
            "friction",
            along(|node| node.result.tau.norm()),
        ))
        .with(
            Series::new(
                "published start of stick",
                Content::dashed(vec![[29.4, 0.0], [29.4, 100.0]]),
            )
            .colored(Color::Grey),
        );
    Figure::new(Width::Page, vec![displacements, tractions])
}
