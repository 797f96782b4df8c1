//! `o-ring-groove`: the section of an O-ring, squeezed into a groove and pressed by a fluid.
//!
//! With the squeeze `C` over the thickness `d` and the force `P` per length, `f = P/(E d)`:
//!
//! ```text
//! C = 4 f (1 - nu^2)/pi (ln(4 R/b) - 1/2) ,  b^2 = 4 P R (1 - nu^2)/(pi E)    Hertz, plane strain
//! f = (1.25 C^1.5 + 50 C^6)/(1 - nu^2)                                        Lindley, plane strain
//! ```
//!
//! Rubber in a closed space takes the pressure of the fluid on as water does, so that the
//! pressure on the lid is that of the squeeze and that of the fluid together: the ring seals
//! by itself. The forces of lid and groove across the section balance the fluid on the chord
//! between the ends of the bow that it wets.

use std::f64::consts::PI;

use striae_figure::{Axis, Color, Content, Figure, Marker, Panel, Series, Width};
use striae_mesh::Vec3;

use super::{
    curve::Curve,
    study::{Extent, Run, Study},
};
use crate::failure::Failure;

const DECKS: [(&str, &str); 2] = decks!("o-ring-groove": "everything", "named");
const SHEAR_MODULUS: f64 = 1.85;
const POISSONS_RATIO: f64 = 0.499;
/// Radius of the section, thickness of the slice, and place of the far wall, mm.
const SECTION: f64 = 1.765;
const SLICE: f64 = 0.2;
const WALL: f64 = 2.04;
/// Pressure of the fluid at the end, MPa.
const PRESSURE: f64 = 5.0;
/// Half of the bow that the fluid wets: ten of 64 facets around the section.
const WETTED: f64 = 10.0 * 2.0 * PI / 64.0;

/// Runs the case.
pub fn run(study: &mut Study) -> Result<(), Failure> {
    let seal = Seal::of(study, 0, 8)?;
    let named = Seal::of(study, 1, 8)?;
    study.measured("hertz.8", seal.hertz_error());
    study.measured("lindley", seal.lindley_error());
    study.measured("sealed", seal.sealed());
    study.measured("thrust", seal.unbalanced());
    study.measured("penetration", seal.penetration());
    study.measured("named.difference", seal.apart(&named));
    study.measured("energy.imbalance", seal.imbalance());
    let mut fine = None;
    if study.extent == Extent::Quick {
        study
            .left_out
            .extend(["hertz.16", "finer.force", "finer.peak"]);
    } else {
        let finer = Seal::of(study, 0, 16)?;
        study.measured("hertz.16", finer.hertz_error());
        let force = seal.squeeze.apart(&finer.squeeze, f64::INFINITY);
        study.measured("finer.force", force);
        let peak = seal.peaks().apart(&finer.peaks(), f64::INFINITY);
        study.measured("finer.peak", peak);
        fine = Some(finer);
    }
    study.draw(&figure(&seal, fine.as_ref()), "squeeze-and-seal")
}

/// Young's modulus.
fn youngs_modulus() -> f64 {
    2.0 * SHEAR_MODULUS * (1.0 + POISSONS_RATIO)
}

fn compliance() -> f64 {
    1.0 - POISSONS_RATIO * POISSONS_RATIO
}

/// `f` of a slice over the squeeze.
fn lindley_force(squeeze: f64) -> f64 {
    (1.25 * squeeze.powf(1.5) + 50.0 * squeeze.powi(6)) / compliance()
}

/// The squeeze at which a slice has the force `f`.
fn hertz_squeeze(f: f64) -> f64 {
    // b/R, with P = f E 2 R.
    let half_width = (8.0 * f * compliance() / PI).sqrt();
    4.0 * f * compliance() / PI * ((4.0 / half_width).ln() - 0.5)
}

/// A ring that was squeezed and pressed.
struct Seal {
    run: Run,
    /// Squeeze and `f` by increment, from zero.
    squeeze: Curve,
}

impl Seal {
    /// Runs a deck with this many elements over an eighth of the section.
    fn of(study: &mut Study, deck: usize, divisions: usize) -> Result<Self, Failure> {
        let (file, text) = DECKS[deck];
        let meshed = format!("divisions = [{divisions}, {divisions}, 1]");
        let deck = study.variant(file, text, &[["divisions = [8, 8, 1]", &meshed]])?;
        let run = study.run(&format!("{file}-{divisions}"), deck)?;
        let scale = 1.0 / (SLICE * youngs_modulus() * 2.0 * SECTION);
        let squeezing = run.column("step").into_iter();
        let squeezing = squeezing.take_while(|step| *step == 1.0).count();
        let ways = run.column("displacement.lid.z").into_iter();
        let forces = run.column("pair.seal-lid.resultant_a.z").into_iter();
        let squeeze = Curve::from_zero(
            ways.take(squeezing).map(|way| -way / SECTION).collect(),
            forces.map(|force| -force * scale).collect(),
        );
        Ok(Self { run, squeeze })
    }

    /// Largest difference of the squeeze from Hertz's from 0.02 to 0.05, over the latter.
    fn hertz_error(&self) -> f64 {
        let rows = self.squeeze.0.iter();
        let within = rows.filter(|row| (0.015..0.055).contains(&row[0]));
        let errors = within.map(|[c, f]| (c / hertz_squeeze(*f) - 1.0).abs());
        errors.fold(0.0, f64::max)
    }

    /// Difference of the force from Lindley's from 0.1 to 0.2, in the mean square.
    fn lindley_error(&self) -> f64 {
        let rows = self.squeeze.0.iter().filter(|row| row[0] > 0.095);
        let squares = rows.map(|[c, f]| (f / lindley_force(*c) - 1.0).powi(2));
        let squares: Vec<f64> = squares.collect();
        (squares.iter().sum::<f64>() / squares.len() as f64).sqrt()
    }

    /// Pressure of the fluid and largest pressure on the lid, from the end of the squeeze.
    fn peaks(&self) -> Curve {
        let times = self.run.column("time").into_iter();
        let peaks = self.run.column("pair.seal-lid.max_pressure");
        let rows = times
            .zip(peaks)
            .filter(|(time, _)| *time > 1.0 - 1e-9)
            .map(|(time, peak)| [PRESSURE * (time - 1.0), peak]);
        Curve(rows.collect())
    }

    /// Largest pressure on the lid at the end over that of the squeeze and of the fluid.
    fn sealed(&self) -> f64 {
        let peaks = self.peaks();
        peaks.last() / (peaks.0[0][1] + PRESSURE)
    }

    /// Forces of lid and groove across the section less that of the fluid, over the latter.
    fn unbalanced(&self) -> f64 {
        let [top, bottom] = [1.0, -1.0].map(|side| self.end_of_bow(side));
        let fluid = PRESSURE * SLICE * (top.z - bottom.z);
        let forces = ["groove", "lid"].map(|other| {
            self.run
                .at_end_of(2, &format!("pair.seal-{other}.resultant_a.x"))
        });
        (forces[0] + forces[1] + fluid).abs() / fluid
    }

    /// Position of an end of the bow that the fluid wets.
    fn end_of_bow(&self, side: f64) -> Vec3 {
        let (problem, state) = (&self.run.finished.problem, &self.run.finished.state);
        let rest = Vec3::new(-WETTED.cos(), 0.0, side * WETTED.sin()) * SECTION;
        let mut nodes = problem.reference.iter().zip(&state.positions);
        let node = nodes.find(|(place, _)| (**place - rest).norm() < 1e-6);
        node.map_or(Vec3::repeat(f64::NAN), |(_, now)| *now)
    }

    /// Largest depth of a node in floor, wall or lid at the end, over the thickness.
    fn penetration(&self) -> f64 {
        let [lid, floor] =
            ["lid", "groove"].map(|side| self.run.at_end_of(2, &format!("displacement.{side}.z")));
        let nodes = self.run.finished.state.positions.iter();
        let depths = nodes.map(|x| {
            let [above, below] = [x.z - SECTION - lid, floor - SECTION - x.z];
            above.max(below).max(x.x - WALL)
        });
        depths.fold(0.0, f64::max) / (2.0 * SECTION)
    }

    /// Largest difference of a force or largest pressure from another run, over the largest value.
    fn apart(&self, other: &Self) -> f64 {
        let columns = ["groove", "lid"].into_iter().flat_map(|pair| {
            ["resultant_a.x", "resultant_a.z", "max_pressure"]
                .map(|column| format!("pair.seal-{pair}.{column}"))
        });
        let differences = columns.map(|column| {
            let [one, other] = [self, other].map(|seal| seal.run.column(&column));
            if one.len() != other.len() || one.is_empty() {
                return f64::NAN;
            }
            let rows = one.iter().zip(&other);
            let difference = rows.map(|(one, other)| (one - other).abs());
            difference.fold(0.0, f64::max) / self.run.largest(&column)
        });
        // A difference that is not known is not small.
        differences.fold(
            0.0,
            |worst: f64, one| if one <= worst { worst } else { one },
        )
    }

    fn imbalance(&self) -> f64 {
        self.run.largest("energy.imbalance") / self.run.largest("energy.external")
    }
}

fn figure(seal: &Seal, fine: Option<&Seal>) -> Figure {
    let forces: Vec<f64> = (1..=40).map(|at| f64::from(at) * 0.16 / 40.0).collect();
    let hertz = forces.iter().map(|&f| [hertz_squeeze(f), f]).collect();
    let lindley = (1..=40).map(|at| f64::from(at) * 0.2 / 40.0);
    let lindley = lindley.map(|c| [c, lindley_force(c)]).collect();
    let peaks = seal.peaks();
    let sum = PRESSURE + peaks.0[0][1];
    let sum = vec![[0.0, peaks.0[0][1]], [PRESSURE, sum]];
    let circles = |curve: &Curve| {
        let marks = Content::markers(curve.0.clone(), Marker::Circle);
        Series::new("computed", marks).colored(Color::Blue)
    };
    let mut left = Panel::new(Axis::linear("squeeze", ""), Axis::linear("P/(E d)", ""))
        .with(Series::new("Hertz", Content::dashed(hertz)).colored(Color::Black))
        .with(Series::new("Lindley", Content::line(lindley)).colored(Color::Black))
        .with(circles(&seal.squeeze));
    let mut right = Panel::new(
        Axis::linear("pressure of the fluid", "MPa"),
        Axis::linear("largest pressure on the lid", "MPa"),
    )
    .with(Series::new("squeeze and fluid", Content::dashed(sum)).colored(Color::Black))
    .with(circles(&peaks));
    if let Some(fine) = fine {
        let crosses = |curve: Curve| {
            let marks = Content::markers(curve.0, Marker::Cross);
            Series::new("half the size", marks).colored(Color::Vermillion)
        };
        left = left.with(crosses(fine.squeeze.clone()));
        right = right.with(crosses(fine.peaks()));
    }
    Figure::new(Width::Page, vec![left, right])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hertz_and_lindley_are_close_for_small_squeezes() {
        let c = hertz_squeeze(lindley_force(0.05));
        assert!((c / 0.05 - 1.0).abs() < 0.1, "{c}");
    }
}
