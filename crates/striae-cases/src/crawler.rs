//! `crawler`: a worm that shortens and lengthens crawls with its nap.
//!
//! A stiff bar of length `L` whose strain goes from 0 to `-e` and back comes forward in a cycle by
//!
//! ```text
//! e L (mu_b - mu_f)/(mu_b + mu_f)
//! ```
//!
//! as the forces of the parts that slide forward and backward are opposite.
//!
//! A bar along which a wave of strain travels has parts that slide at many rates `w` beside each
//! other. Equilibrium asks for the part `q = mu_f/(mu_f + mu_b)` of its length to slide backward,
//! so that it moves at the rate at which the `q`-quantile of all `w` is at rest. With the
//! wavelength `L` and the amplitude `e` it crawls in a cycle by `e L cos(pi q)`.

use std::f64::consts::PI;

use striae_figure::{Axis, Content, Figure, Panel, Series, Width};

use striae_output::summary::Summary;

use super::study::{Run, Study};
use crate::failure::Failure;

const DECKS: [(&str, &str); 3] = decks!("crawler": "forward", "mirrored", "smooth");
const WAVE: &str = embedded!("crawler/wave.toml");
/// A replacement of the deck of the wave by a name.
type Variant = (&'static str, &'static [[&'static str; 2]]);
const VARIANTS: [Variant; 4] = [
    ("wave", &[]),
    ("wave-backward", &[["wave = 1 ", "wave = -1 "]]),
    (
        "wave-mirrored",
        &[["wave = 1 ", "wave = -1 "], ["nap = 1 ", "nap = -1 "]],
    ),
    (
        "wave-smooth",
        &[[
            "law = \"nap\", mu_forward = 0.1, mu_backward = 0.4, mu_lateral = 0.25",
            "law = \"coulomb\", mu = 0.25",
        ]],
    ),
];
/// Parts of the worm along the wave.
const SEGMENTS: usize = 12;
/// Points of each of them in the stiff bar.
const POINTS: usize = 200;
/// Increments in a cycle of the wave.
const INCREMENTS: usize = 36;
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
    wave(study)?;
    let off = runs
        .iter()
        .map(|run| run.largest("energy.imbalance") / run.at_end_of(3, "energy.actuation").abs());
    study.measured("energy.imbalance", off.fold(0.0, f64::max));
    study.draw(&figure(&runs), "way")
}

/// Runs worms along which a wave travels, to the head or to the tail.
fn wave(study: &mut Study) -> Result<(), Failure> {
    let mut runs = Vec::new();
    for (name, passages) in VARIANTS {
        let deck = study.variant(name, WAVE, passages)?;
        runs.push(study.run_unjudged(name, deck)?);
    }
    let ways: Vec<f64> = runs.iter().map(way).collect();
    let [wave, backward, mirrored, smooth] = [0, 1, 2, 3].map(|at| ways[at]);
    let [easy, hard] = COEFFICIENTS;
    let part = easy / (easy + hard);
    study.measured("wave.over_stiff_bar", wave / stiff_bar(part));
    let continuous = STRAIN * LENGTH * (PI * part).cos();
    study.measured("wave.over_closed_form", wave / continuous);
    study.measured("wave.backward", backward / wave);
    study.measured("wave.mirrored.off", ((wave + mirrored) / wave).abs());
    study.measured("wave.smooth.off", (smooth / wave).abs());
    let summaries: Vec<_> = runs.iter().map(|run| &run.finished.summary).collect();
    let worst = |of: &dyn Fn(&Summary) -> f64| summaries.iter().map(|s| of(s)).fold(0.0, f64::max);
    study.measured("wave.newton.median", worst(&|s| s.newton_median));
    study.measured("wave.newton.max", worst(&|s| s.newton_max as f64));
    study.measured("wave.cutbacks", worst(&|s| s.cutbacks as f64));
    let panel = panel(VARIANTS.iter().map(|(name, _)| *name).zip(&runs));
    study.draw(&Figure::new(Width::Column, vec![panel]), "wave")
}

/// Way in a cycle of a stiff bar of as many segments and increments, of which the given part slides
/// backward at all times.
fn stiff_bar(part: f64) -> f64 {
    let middle = (SEGMENTS - 1) as f64 / 2.0;
    let length = LENGTH / SEGMENTS as f64;
    let places = |time: f64| -> Vec<f64> {
        let mut start = 0.0;
        let mut places = Vec::new();
        for segment in 0..SEGMENTS {
            let phase = (segment as f64 - middle) / SEGMENTS as f64;
            let longer = STRAIN * length * (2.0 * PI * (time - phase)).sin();
            let points = (0..POINTS).map(|at| (at as f64 + 0.5) / POINTS as f64);
            places.extend(points.map(|share| start + share * longer));
            start += longer;
        }
        places
    };
    let moves = (0..INCREMENTS).map(|increment| {
        let [before, after] =
            [increment, increment + 1].map(|at| places(at as f64 / INCREMENTS as f64));
        let mut moved: Vec<f64> = before.iter().zip(&after).map(|(b, a)| a - b).collect();
        let mean = moved.iter().sum::<f64>() / moved.len() as f64;
        moved.sort_by(f64::total_cmp);
        mean - moved[(part * moved.len() as f64) as usize]
    });
    moves.sum()
}

/// Way of the centre of mass in the second cycle.
fn way(run: &Run) -> f64 {
    let [start, end] = [2, 3].map(|step| run.at_end_of(step, "centre.worm.x"));
    end - start
}

/// Ways over time.
fn figure(runs: &[Run]) -> Figure {
    let names = DECKS.iter().map(|(name, _)| *name);
    Figure::new(Width::Column, vec![panel(names.zip(runs))])
}

fn panel<'a>(runs: impl Iterator<Item = (&'static str, &'a Run)>) -> Panel {
    let panel = Panel::new(Axis::linear("time", "s"), Axis::linear("way", "mm"));
    runs.fold(panel, |panel, (name, run)| {
        let places = run.column("centre.worm.x");
        let start = places.first().copied().unwrap_or(0.0);
        let points = run.column("time").into_iter().zip(places);
        let points: Vec<[f64; 2]> = points.map(|(time, x)| [time, x - start]).collect();
        panel.with(Series::new(name, Content::line(points)))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_stiff_bar_crawls_by_the_cosine_and_not_at_all_without_a_nap() {
        let [easy, hard] = COEFFICIENTS;
        let part = easy / (easy + hard);
        let continuous = STRAIN * LENGTH * (PI * part).cos();
        // Segments of a twelfth of the wave take a hundredth of it.
        let error = stiff_bar(part) / continuous - 1.0;
        assert!(error < 0.0 && error > -0.015, "{error}");
        assert!((stiff_bar(0.5) / continuous).abs() < 1.0 / POINTS as f64);
    }
}
