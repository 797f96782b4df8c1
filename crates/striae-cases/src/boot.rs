//! `boot`: a bellows with three convolutions, compressed until they touch and pushed sideways.
//!
//! The wall, of the thickness `t`, is made of half circles of the radius `a` around crowns and
//! roots, and of flat rings of the length `h` between them. While it is compressed, a half circle
//! turns by `2 phi` more and the rings lean by `phi`. If the length of the bows stays as it is and
//! each of them stays round, with the radius `b`, the length of a convolution is
//!
//! ```text
//! l = 4 b cos(phi) - 2 h sin(phi) ,  b = pi a/(pi + 2 phi)
//! ```
//!
//! and neighbouring crowns meet, as do neighbouring roots, when `l = 2 b + t`.

use std::f64::consts::PI;

use striae_figure::{Axis, Color, Content, Figure, Marker, Panel, Series, Width};
use striae_mesh::Vec3;

use super::{
    curve::Curve,
    overlap,
    study::{Extent, Run, Study},
};
use crate::failure::Failure;

const DECKS: [(&str, &str); 3] = decks!("boot": "slice", "slice-fine", "half");
/// Convolutions, radius of the bows, length of the flat rings and thickness, mm.
const CONVOLUTIONS: f64 = 3.0;
const BOW: f64 = 2.0;
const RING: f64 = 4.0;
const THICKNESS: f64 = 1.0;
/// Slices of a whole boot.
const SLICES: f64 = 90.0;

/// Runs the case.
pub fn run(study: &mut Study) -> Result<(), Failure> {
    let coarse = Pressed::of(study, 0, SLICES)?;
    let half = Pressed::of(study, 2, 2.0)?;
    study.measured("slice.touch", coarse.touch() / way_at_touch());
    study.measured("slice.overlap", coarse.overlap());
    let met = coarse.touch();
    study.measured("half.alike", half.curve.apart(&coarse.curve, met - 1e-9));
    let worst = |of: fn(&Pressed) -> f64| of(&coarse).max(of(&half));
    study.measured("itself.sum", worst(Pressed::own_force));
    study.measured("energy.imbalance", worst(Pressed::imbalance));
    let mut fine = None;
    if study.extent == Extent::Quick {
        study
            .left_out
            .extend(["slice.finer.before", "slice.finer.after"]);
    } else {
        let finer = Pressed::of(study, 1, SLICES)?;
        let met = met.min(finer.touch());
        let before = coarse.curve.apart(&finer.curve, met - 1e-9);
        study.measured("slice.finer.before", before);
        let after = coarse.curve.apart(&finer.curve, f64::INFINITY);
        study.measured("slice.finer.after", after);
        fine = Some(finer);
    }
    study.draw(&figure(&coarse, fine.as_ref(), &half), "force-over-way")
}

/// Compression at which convolutions touch.
fn way_at_touch() -> f64 {
    let bow = |lean: f64| PI * BOW / (PI + 2.0 * lean);
    let length = |lean: f64| 4.0 * bow(lean) * lean.cos() - 2.0 * RING * lean.sin();
    let [mut open, mut closed] = [0.0, 1.0];
    for _ in 0..60 {
        let lean = (open + closed) / 2.0;
        if length(lean) > 2.0 * bow(lean) + THICKNESS {
            open = lean;
        } else {
            closed = lean;
        }
    }
    CONVOLUTIONS * (4.0 * BOW - length(open))
}

/// A boot that was compressed.
struct Pressed {
    run: Run,
    /// Compression and force of the whole boot by increment, from zero, without sideways motion.
    curve: Curve,
    /// Parts of this size in a whole boot.
    parts: f64,
}

impl Pressed {
    fn of(study: &mut Study, deck: usize, parts: f64) -> Result<Self, Failure> {
        let (name, text) = DECKS[deck];
        let deck = study.deck(name, text)?;
        let way = if name == "half" { 11.2 } else { 12.0 };
        let run = study.run(name, deck)?;
        let times = run.column("time").into_iter();
        let ways: Vec<f64> = times
            .take_while(|time| *time < 1.0 + 1e-9)
            .map(|time| way * time)
            .collect();
        let forces = run.column("reaction.boot.lower.z").into_iter();
        let curve = Curve::from_zero(ways, forces.map(|force| force * parts).collect());
        Ok(Self { run, curve, parts })
    }

    /// Compression of the increment in which convolutions meet, NaN if they do not.
    fn touch(&self) -> f64 {
        let pressed = self.run.column("pair.boot-boot.pressure_integral_a");
        let met = pressed.iter().position(|force| *force > 1e-9);
        met.and_then(|row| self.curve.0.get(row + 1))
            .map_or(f64::NAN, |row| row[0])
    }

    /// Depth of nodes of a slice in elements of others, over the thickness of the wall.
    fn overlap(&self) -> f64 {
        let front = |place: &Vec3| place.y < 0.0;
        overlap::depth(&self.run, front, |x| [x.x.hypot(x.y), x.z]) / THICKNESS
    }

    /// Sum of the forces of the boot on itself over the pressure between its faces.
    fn own_force(&self) -> f64 {
        let sum = ["x", "y", "z"].map(|axis| {
            self.run
                .largest(&format!("pair.boot-boot.resultant_a.{axis}"))
        });
        let pressed = self.run.largest("pair.boot-boot.pressure_integral_a");
        sum.into_iter().fold(0.0, f64::max) / pressed
    }

    fn imbalance(&self) -> f64 {
        self.run.largest("energy.imbalance") / self.run.largest("energy.external")
    }

    /// Force of the whole boot along an axis over the sideways motion.
    fn sideways(&self, axis: &str) -> Vec<[f64; 2]> {
        let times = self.run.column("time").into_iter();
        let forces = self.run.column(&format!("reaction.boot.lower.{axis}"));
        let rows = times.zip(forces).filter(|(time, _)| *time > 1.0 - 1e-9);
        rows.map(|(time, force)| [4.0 * (time - 1.0), force.abs() * self.parts])
            .collect()
    }
}

fn figure(coarse: &Pressed, fine: Option<&Pressed>, half: &Pressed) -> Figure {
    let force = || Axis::linear("force", "N");
    let touch = vec![[way_at_touch(), 0.0], [way_at_touch(), coarse.curve.last()]];
    let circles = Content::markers(half.curve.0.clone(), Marker::Circle);
    let mut panel = Panel::new(Axis::linear("compression", "mm"), force())
        .with(Series::new("slice", Content::line(coarse.curve.0.clone())).colored(Color::Blue))
        .with(Series::new("half boot", circles).colored(Color::Vermillion));
    if let Some(fine) = fine {
        let marks = Content::markers(fine.curve.0.clone(), Marker::Cross);
        panel = panel.with(Series::new("half the size", marks).colored(Color::Black));
    }
    panel =
        panel.with(Series::new("touch, closed form", Content::dashed(touch)).colored(Color::Black));
    let motion = Axis::linear("sideways motion", "mm");
    let mut sideways = Panel::new(motion, force());
    for (axis, name, color) in [
        ("z", "along the axis", Color::Blue),
        ("x", "sideways", Color::Vermillion),
    ] {
        let line = Content::line(half.sideways(axis));
        sideways = sideways.with(Series::new(name, line).colored(color));
    }
    Figure::new(Width::Page, vec![panel, sideways])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn convolutions_touch_later_than_stiff_crowns() {
        let stiff = CONVOLUTIONS * (4.0 * BOW - 2.0 * BOW - THICKNESS);
        assert!(way_at_touch() > stiff && way_at_touch() < stiff + CONVOLUTIONS);
    }
}
