//! `sipes`: a tread block of one piece with two slits, everything in contact beside named walls.

use striae_figure::{Axis, Content, Figure, Marker, Panel, Series, Width};

use super::study::{Run, Study};
use crate::failure::Failure;

const DECKS: [(&str, &str); 2] = decks!("sipes": "tread", "tread-named");
/// Pair of the block and the road, pairs of the named walls, and that of the block and itself.
const ROAD: &str = "tread-road";
const SLITS: [&str; 2] = ["first-slit", "second-slit"];
const ITSELF: &str = "tread-tread";

/// Runs the case.
pub fn run(study: &mut Study) -> Result<(), Failure> {
    let [all, named] = DECKS;
    let all = ran(study, all)?;
    let named = ran(study, named)?;
    let scale = named.largest(&format!("pair.{ROAD}.resultant_a.z"));
    for axis in ["x", "z"] {
        let [one, other] =
            [&all, &named].map(|run| run.column(&format!("pair.{ROAD}.resultant_a.{axis}")));
        let difference = apart(&one, &other) / scale;
        study.measured(format!("road.{axis}.difference"), difference);
    }
    let itself = all.column(&format!("pair.{ITSELF}.pressure_integral_a"));
    let walls = SLITS.map(|slit| named.column(&format!("pair.{slit}.pressure_integral_a")));
    let walls: Vec<f64> = walls[0]
        .iter()
        .zip(&walls[1])
        .map(|(one, other)| one + other)
        .collect();
    study.measured("slits.difference", apart(&itself, &walls) / scale);
    let sums =
        ["x", "y", "z"].map(|axis| all.largest(&format!("pair.{ITSELF}.resultant_a.{axis}")));
    study.measured("itself.sum", sums.into_iter().fold(0.0, f64::max) / scale);
    study.draw(&figure(&all, &named, &itself, &walls), "forces")
}

fn ran(study: &mut Study, (name, text): (&str, &str)) -> Result<Run, Failure> {
    let deck = study.deck(name, text)?;
    study.run(name, deck)
}

/// Largest difference of two columns, NaN where increments were cut in one run.
fn apart(one: &[f64], other: &[f64]) -> f64 {
    if one.len() != other.len() || one.is_empty() {
        return f64::NAN;
    }
    let apart = one
        .iter()
        .zip(other)
        .map(|(one, other)| (one - other).abs());
    apart.fold(0.0, f64::max)
}

fn figure(all: &Run, named: &Run, itself: &[f64], walls: &[f64]) -> Figure {
    let over_time = |run: &Run, values: &[f64]| -> Vec<[f64; 2]> {
        let rows = run.column("time").into_iter().zip(values);
        rows.map(|(time, value)| [time, *value]).collect()
    };
    let road = |run: &Run, axis: &str| {
        let force = run.column(&format!("pair.{ROAD}.resultant_a.{axis}"));
        over_time(
            run,
            &force.iter().map(|force| force.abs()).collect::<Vec<_>>(),
        )
    };
    let mut panel = Panel::new(Axis::linear("time", ""), Axis::linear("force", "N"));
    for (axis, name) in [
        ("z", "normal force on the road"),
        ("x", "friction on the road"),
    ] {
        let crosses = Content::markers(road(named, axis), Marker::Cross);
        let line = Content::line(road(all, axis));
        panel = panel
            .with(Series::new(name, line))
            .with(Series::new("", crosses));
    }
    let crosses = Content::markers(over_time(named, walls), Marker::Cross);
    let line = Content::line(over_time(all, itself));
    panel = panel
        .with(Series::new("between the walls", line))
        .with(Series::new("", crosses));
    Figure::new(Width::Column, vec![panel])
}
