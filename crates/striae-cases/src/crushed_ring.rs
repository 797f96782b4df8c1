//! `crushed-ring`: a thick ring between planes, and between jaws until its inner walls touch.
//!
//! Two opposite forces `P` per width shorten the diameter of a ring of mean radius `R` and
//! thickness `t` in plane strain by
//!
//! ```text
//! w = P R^3/(E' I) (k1 pi/4 - 2 k2^2/pi) ,  E' = E/(1 - nu^2) ,  I = t^3/12
//! k1 = 1 - a + b ,  k2 = 1 - a ,  a = I/(t R^2) ,  b = 6/5 E' I/(G t R^2)
//! ```
//!
//! with the shortening of the wall in `a` and its shear in `b` (Young and Budynas, *Roark's
//! Formulas for Stress and Strain*, 7th edition, table 9.2, case 1).

use std::f64::consts::PI;

use striae_figure::{Axis, Color, Content, Figure, Marker, Panel, Series, Width};

use super::study::{Extent, Run, Study};
use crate::failure::Failure;

const DECKS: [(&str, &str); 2] = decks!("crushed-ring": "planes", "jaws");
const YOUNGS_MODULUS: f64 = 3.0;
const POISSONS_RATIO: f64 = 0.3;
/// Inner and outer radius, mm.
const RADII: [f64; 2] = [8.0, 10.0];

/// Runs the case.
pub fn run(study: &mut Study) -> Result<(), Failure> {
    let mut curves = Vec::new();
    for (file, text) in DECKS {
        let coarse = Crushed::of(study, (file, text), 2)?;
        study.measured(format!("{file}.energy.imbalance"), coarse.imbalance());
        if file == "planes" {
            let stiffness = coarse.first_stiffness() / stiffness();
            study.measured("planes.stiffness", stiffness);
        } else {
            study.measured("jaws.touch", coarse.touch());
            study.measured("jaws.itself.sum", coarse.own_force());
        }
        let mut fine = None;
        if study.extent == Extent::Quick {
            study.left_out.push(match file {
                "planes" => "planes.finer",
                _ => "jaws.finer",
            });
        } else {
            let finer = Crushed::of(study, (file, text), 4)?;
            let difference = (coarse.last_force() / finer.last_force() - 1.0).abs();
            study.measured(
                format!("{file}.finer"),
                difference.max(apart(&coarse, &finer)),
            );
            fine = Some(finer);
        }
        curves.push((coarse, fine));
    }
    study.draw(&figure(&curves), "force-over-way")
}

/// Force per width and approach at the start, of two planes, by the closed form.
fn stiffness() -> f64 {
    let [inner, outer] = RADII;
    let thickness = outer - inner;
    let radius = (outer + inner) / 2.0;
    let inertia = thickness.powi(3) / 12.0;
    let modulus = YOUNGS_MODULUS / (1.0 - POISSONS_RATIO * POISSONS_RATIO);
    let shear_modulus = YOUNGS_MODULUS / (2.0 * (1.0 + POISSONS_RATIO));
    let wall = thickness * radius * radius;
    let shortened = inertia / wall;
    let sheared = 1.2 * modulus * inertia / (shear_modulus * wall);
    let [k1, k2] = [1.0 - shortened + sheared, 1.0 - shortened];
    modulus * inertia / (radius.powi(3) * (k1 * PI / 4.0 - 2.0 * k2 * k2 / PI))
}

/// A ring that was crushed.
struct Crushed {
    run: Run,
    /// Approach over the inner diameter and force by increment, from zero.
    curve: Vec<[f64; 2]>,
}

impl Crushed {
    /// Runs a deck with elements through the wall, 48 times as many around.
    fn of(study: &mut Study, (file, text): (&str, &str), through: usize) -> Result<Self, Failure> {
        let meshed = format!("divisions = [{through}, {}, 1]", 48 * through);
        let deck = study.variant(file, text, &[["divisions = [2, 96, 1]", &meshed]])?;
        let run = study.run(&format!("{file}-{through}"), deck)?;
        let ways = run.column("displacement.lid.z").into_iter();
        let forces = run.column("pair.ring-lid.resultant_a.z").into_iter();
        let rows = ways.zip(forces);
        let rows = rows.map(|(way, force)| [-way / RADII[0], force.abs()]);
        let curve = std::iter::once([0.0; 2]).chain(rows).collect();
        Ok(Self { run, curve })
    }

    /// Force over the approach at zero, from two equal increments.
    fn first_stiffness(&self) -> f64 {
        let [_, [way, first], [_, second], ..] = self.curve[..] else {
            return f64::NAN;
        };
        (4.0 * first - second) / (2.0 * way * 2.0 * RADII[0])
    }

    /// Approach over the inner diameter of the increment in which the walls meet, NaN if they do not.
    fn touch(&self) -> f64 {
        let pressed = self.run.column("pair.ring-ring.pressure_integral_a");
        let met = pressed.iter().position(|force| *force > 1e-6);
        met.map_or(f64::NAN, |row| self.curve[row + 1][0])
    }

    /// Sum of the forces of the ring on itself over the last force on it.
    fn own_force(&self) -> f64 {
        let sum = ["x", "y", "z"].map(|axis| {
            self.run
                .largest(&format!("pair.ring-ring.resultant_a.{axis}"))
        });
        sum.into_iter().fold(0.0, f64::max) / self.last_force()
    }

    fn last_force(&self) -> f64 {
        self.curve[self.curve.len() - 1][1]
    }

    fn imbalance(&self) -> f64 {
        self.run.largest("energy.imbalance") / self.run.largest("energy.external")
    }

    /// Force at an approach, linear between increments.
    fn force(&self, way: f64) -> f64 {
        let next = self.curve.partition_point(|row| row[0] < way);
        let next = next.clamp(1, self.curve.len() - 1);
        let [from, to] = [self.curve[next - 1], self.curve[next]];
        from[1] + (to[1] - from[1]) * (way - from[0]) / (to[0] - from[0])
    }
}

/// Largest difference of the forces before walls meet, over the largest one there: once they
/// meet the force grows so fast that it depends on where increments end.
fn apart(one: &Crushed, other: &Crushed) -> f64 {
    let met = one.touch().min(other.touch());
    let ways = one.curve.iter().map(|row| row[0]);
    let ways: Vec<f64> = ways.take_while(|way| met.is_nan() || *way < met).collect();
    let differences = ways
        .iter()
        .map(|&way| (one.force(way) - other.force(way)).abs());
    let forces = ways.iter().map(|&way| one.force(way));
    differences.fold(0.0, f64::max) / forces.fold(0.0, f64::max)
}

fn figure(curves: &[(Crushed, Option<Crushed>)]) -> Figure {
    let panels = curves.iter().zip(DECKS).map(|((coarse, fine), (name, _))| {
        let mut panel = Panel::new(
            Axis::linear("approach / inner diameter", ""),
            Axis::linear("force", "N"),
        )
        .with(Series::new(name, Content::line(coarse.curve.clone())).colored(Color::Blue));
        if let Some(fine) = fine {
            let marks = Content::markers(fine.curve.clone(), Marker::Cross);
            panel = panel.with(Series::new("half the size", marks).colored(Color::Black));
        }
        if name == "planes" {
            let upto = 0.3;
            let line = vec![[0.0; 2], [upto, stiffness() * upto * 2.0 * RADII[0]]];
            panel =
                panel.with(Series::new("closed form", Content::dashed(line)).colored(Color::Black));
        }
        panel
    });
    Figure::new(Width::Page, panels.collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_thin_ring_has_the_stiffness_of_bending_alone() {
        // 0.149 P R^3/(E I), as in every table of rings.
        let bending = PI / 4.0 - 2.0 / PI;
        assert!((bending - 0.1488).abs() < 1e-4);
        let thick = YOUNGS_MODULUS / 0.91 * (8.0 / 12.0) / (729.0 * bending);
        assert!((stiffness() / thick - 1.0).abs() < 0.1);
    }
}
