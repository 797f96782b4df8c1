//! `folded-strip`: a strip folded between plates, and pinched by jaws until its legs touch.
//!
//! Between frictionless plates at a distance `D`, taken from middle to middle of the legs, the
//! strip carries a force `F` across the fold alone, and no moment where it leaves the plates. With
//! the angle `theta` to the direction of the force, the natural curvature `k0` and the bending
//! stiffness `B = E/(1 - nu^2) t^3/12` of plane strain, the moment `B (k - k0)` changes by
//! `F sin(theta)` over the length, so that
//!
//! ```text
//! k^2 = k0^2 + 2 F/B cos(theta) ,  D/2 = int_0^(pi/2) cos(theta)/k dtheta
//! ```
//!
//! and without natural curvature `F D^2/B = 2 (int_0^(pi/2) sqrt(cos))^2 = 2.871` and `k D = 2.396`
//! in the middle (Matthewson, Kurkjian and Gulati 1986).

use std::f64::consts::FRAC_PI_2;

use striae_figure::{Axis, Color, Content, Figure, Marker, Panel, Series, Width};
use striae_mesh::Vec3;

use super::{
    curve::Curve,
    overlap,
    study::{Extent, Run, Study},
};
use crate::failure::Failure;

const DECKS: [(&str, &str); 2] = decks!("folded-strip": "plates", "jaws");
const YOUNGS_MODULUS: f64 = 1000.0;
const POISSONS_RATIO: f64 = 0.3;
/// Thickness of the strip, and distance of the plates at the start, mm.
const THICKNESS: f64 = 0.8;
const APART: f64 = 62.0;
/// Natural curvature: that of two layers that lengthen and shorten by 0.002.
const SET: f64 = 1.5 * 0.004 / THICKNESS;
/// Distance from which on the whole fold is between the lines where it leaves the plates.
const FOLDED: f64 = 25.0;
/// Way of each jaw at which the legs are about to lie flat on each other.
const FLAT: f64 = 30.0;

/// Runs the case.
pub fn run(study: &mut Study) -> Result<(), Failure> {
    let plates = Folded::of(study, 0, 2)?;
    let jaws = Folded::of(study, 1, 2)?;
    let distances = plates.over_distance();
    let ratios = distances.iter().map(|[d, f]| f / closed_form(*d)[0]);
    let ratios: Vec<f64> = ratios.collect();
    study.measured(
        "plates.force",
        ratios.iter().sum::<f64>() / ratios.len() as f64,
    );
    let largest = ratios.iter().map(|ratio| (ratio - 1.0).abs());
    study.measured("plates.force.largest", largest.fold(0.0, f64::max));
    study.measured("plates.curvature", plates.curvature());
    study.measured("jaws.overlap", jaws.overlap());
    study.measured("jaws.itself.sum", jaws.own_force());
    study.measured("energy.imbalance", plates.imbalance().max(jaws.imbalance()));
    let mut fine = None;
    if study.extent == Extent::Quick {
        study.left_out.extend([
            "plates.finer",
            "plates.finer.curvature",
            "jaws.finer.before",
            "jaws.finer.last",
        ]);
    } else {
        let finer = [Folded::of(study, 0, 4)?, Folded::of(study, 1, 4)?];
        let [finer_plates, finer_jaws] = &finer;
        let last = |one: &Folded| one.curve.last();
        study.measured(
            "plates.finer",
            (last(&plates) / last(finer_plates) - 1.0).abs(),
        );
        study.measured("plates.finer.curvature", finer_plates.curvature());
        let before = jaws.curve.apart(&finer_jaws.curve, FLAT);
        study.measured("jaws.finer.before", before);
        study.measured(
            "jaws.finer.last",
            (last(&jaws) / last(finer_jaws) - 1.0).abs(),
        );
        fine = Some(finer);
    }
    study.draw(&figure(&plates, &jaws, fine.as_ref()), "force-over-way")
}

/// Force per width and curvature in the middle at a distance.
fn closed_form(distance: f64) -> [f64; 2] {
    let modulus = YOUNGS_MODULUS / (1.0 - POISSONS_RATIO * POISSONS_RATIO);
    let bending = modulus * THICKNESS.powi(3) / 12.0;
    let [load, curvature] = elastica(distance, SET);
    [load * bending, curvature]
}

/// `F/B` and curvature in the middle, by bisection.
fn elastica(distance: f64, set: f64) -> [f64; 2] {
    let scale = 2.871 / (distance * distance);
    let [mut low, mut high] = [0.1 * scale, 10.0 * scale];
    for _ in 0..60 {
        let load = (low * high).sqrt();
        if half_width(load, set) > distance / 2.0 {
            low = load;
        } else {
            high = load;
        }
    }
    [low, (set * set + 2.0 * low).sqrt()]
}

/// Integral of `cos(theta)/k`, with `theta = pi/2 - u^2`, which is smooth where `k` vanishes.
fn half_width(load: f64, set: f64) -> f64 {
    const PARTS: usize = 2000;
    let step = FRAC_PI_2.sqrt() / PARTS as f64;
    let parts = (0..PARTS).map(|part| {
        let u = (part as f64 + 0.5) * step;
        let cosine = (u * u).sin();
        cosine * 2.0 * u / (set * set + 2.0 * load * cosine).sqrt()
    });
    parts.sum::<f64>() * step
}

/// A strip that was folded.
struct Folded {
    run: Run,
    /// Way of a plate or jaw and force in the last step.
    curve: Curve,
}

impl Folded {
    /// Runs a deck with elements through the strip, 30 times as many along it.
    fn of(study: &mut Study, deck: usize, through: usize) -> Result<Self, Failure> {
        let (file, text) = DECKS[deck];
        let meshed = format!("divisions = [{}, 1, {through}]", 30 * through);
        let deck = study.variant(file, text, &[["divisions = [60, 1, 2]", &meshed]])?;
        let run = study.run(&format!("{file}-{through}"), deck)?;
        let ways = run.column("displacement.right.x").into_iter();
        let forces = run.column("pair.strip-right.resultant_a.x").into_iter();
        let steps = run.column("step").into_iter();
        let rows = ways.zip(forces).zip(steps).filter(|(_, step)| *step == 4.0);
        let curve = Curve(rows.map(|((way, force), _)| [-way, force.abs()]).collect());
        Ok(Self { run, curve })
    }

    /// Distance from middle to middle of the legs and force, where these leave the plates.
    fn over_distance(&self) -> Vec<[f64; 2]> {
        let rows = self.curve.0.iter();
        rows.map(|[way, force]| [APART - 2.0 * way - THICKNESS, *force])
            .filter(|[distance, _]| *distance < FOLDED)
            .collect()
    }

    /// Curvature in the middle at the end over that of the closed form, by the circle through
    /// three nodes.
    fn curvature(&self) -> f64 {
        let (problem, state) = (&self.run.finished.problem, &self.run.finished.state);
        let [left, middle, right] = [-1.0, 0.0, 1.0].map(|x| {
            let place = Vec3::new(x, 0.0, 0.0);
            let mut nodes = problem.reference.iter().zip(&state.positions);
            let node = nodes.find(|(rest, _)| (**rest - place).norm() < 1e-6);
            node.map_or(Vec3::repeat(f64::NAN), |(_, now)| *now)
        });
        let (one, other, chord) = (left - middle, right - middle, right - left);
        let found = 2.0 * one.cross(&other).norm() / (one.norm() * other.norm() * chord.norm());
        let distance = APART - 2.0 * self.curve.0.last().map_or(f64::NAN, |row| row[0]);
        found / closed_form(distance - THICKNESS)[1]
    }

    /// Depth of nodes in elements of the other leg over the thickness.
    fn overlap(&self) -> f64 {
        overlap::depth(&self.run, |x| x.y < 0.5, |x| [x.x, x.z]) / THICKNESS
    }

    /// Sum of the forces of the strip on itself over the last force on it.
    fn own_force(&self) -> f64 {
        let sum = ["x", "y", "z"].map(|axis| {
            self.run
                .largest(&format!("pair.strip-strip.resultant_a.{axis}"))
        });
        sum.into_iter().fold(0.0, f64::max) / self.curve.last()
    }

    fn imbalance(&self) -> f64 {
        self.run.largest("energy.imbalance") / self.run.largest("energy.external")
    }
}

fn figure(plates: &Folded, jaws: &Folded, fine: Option<&[Folded; 2]>) -> Figure {
    let places = |count: usize| (0..=count).map(move |at| 12.0 + 13.0 * at as f64 / count as f64);
    let known = places(40).map(|distance| [distance, closed_form(distance)[0]]);
    let circles = Content::markers(plates.over_distance(), Marker::Circle);
    let mut left = Panel::new(
        Axis::linear("distance of the middles of the legs", "mm"),
        Axis::linear("force", "N"),
    )
    .with(Series::new("closed form", Content::dashed(known.collect())).colored(Color::Black))
    .with(Series::new("plates", circles).colored(Color::Blue));
    let line = Content::line(jaws.curve.0.clone());
    let mut right = Panel::new(
        Axis::linear("way of a jaw", "mm"),
        Axis::logarithmic("force", "N"),
    )
    .with(Series::new("jaws", line).colored(Color::Blue));
    if let Some([plates, jaws]) = fine {
        let crosses = |points| {
            let marks = Content::markers(points, Marker::Cross);
            Series::new("half the size", marks).colored(Color::Black)
        };
        left = left.with(crosses(plates.over_distance()));
        right = right.with(crosses(jaws.curve.0.clone()));
    }
    Figure::new(Width::Page, vec![left, right])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_straight_strip_has_the_published_constants() {
        let [load, curvature] = elastica(10.0, 0.0);
        assert!((load * 100.0 - 2.871).abs() < 1e-3);
        assert!((curvature * 10.0 - 2.396).abs() < 1e-3);
    }
}
