//! `crawler`: a worm that shortens and lengthens crawls with its nap.
//!
//! A stiff bar of length `L` whose strain goes from 0 to `-e` and back comes forward in a cycle by
//!
//! ```text
//! e L (mu_b - mu_f)/(mu_b + mu_f)
//! ```
//!
//! as the forces of the parts that slide forward and backward are opposite.

use striae_figure::{Axis, Content, Figure, Panel, Series, Width};

use super::study::{Run, Study};
use crate::failure::Failure;

const DECKS: [(&str, &str); 3] = decks!("crawler": "forward", "mirrored", "smooth");
const LENGTH: f64 = 60.0;
const STRAIN: f64 = 0.1;
/// Coefficients of friction forward and backward.
const COEFFICIENTS: [f64; 2] = [0.1, 0.4];

/// Runs the case.
pub fn run(study: &mut Study) -> Result<(), Failure> {
    let mut runs = Vec::new();
    for (name, text) in DECKS {
        let deck = study.deck(name, text)?;
        runs.push(study.run(name, deck)?);
    }
    let ways: Vec<f64> = runs.iter().map(way).collect();
    let [forward, mirrored, smooth] = [ways[0], ways[1], ways[2]];
    let [easy, hard] = COEFFICIENTS;
    let closed_form = STRAIN * LENGTH * (hard - easy) / (hard + easy);
    study.measured("forward.over_closed_form", forward / closed_form);
    study.measured("mirrored.off", ((forward + mirrored) / forward).abs());
    study.measured("smooth.off", (smooth / forward).abs());
    let cycle = |column: &str| {
        let [start, end] = [2, 3].map(|step| runs[0].at_end_of(step, column));
        end - start
    };
    let spent = cycle("energy.friction") / cycle("energy.actuation");
    study.measured("friction.over_actuation", spent);
    let off = runs
        .iter()
        .map(|run| run.largest("energy.imbalance") / run.at_end_of(3, "energy.actuation").abs());
    study.measured("energy.imbalance", off.fold(0.0, f64::max));
    study.draw(&figure(&runs), "way")
}

/// Way of the centre of mass in the second cycle.
fn way(run: &Run) -> f64 {
    let [start, end] = [2, 3].map(|step| run.at_end_of(step, "centre.worm.x"));
    end - start
}

/// Ways over time.
fn figure(runs: &[Run]) -> Figure {
    let axes = [Axis::linear("time", "s"), Axis::linear("way", "mm")];
    let [time, way] = axes;
    let panel = runs
        .iter()
        .zip(DECKS)
        .fold(Panel::new(time, way), |panel, (run, (name, _))| {
            let places = run.column("centre.worm.x");
            let start = places.first().copied().unwrap_or(0.0);
            let points = run.column("time").into_iter().zip(places);
            let points: Vec<[f64; 2]> = points.map(|(time, x)| [time, x - start]).collect();
            panel.with(Series::new(name, Content::line(points)))
        });
    Figure::new(Width::Column, vec![panel])
}
