//! `o-ring`: rings of rubber are squeezed between plates and dragged across grooves.
//!
//! With the squeeze `C` over the thickness `d` and the force `P` per length, `f = P/(E d)`:
//!
//! ```text
//! C = 4 f (1 - nu^2)/pi (ln(4 R/b) - 1/2) ,  b^2 = 4 P R (1 - nu^2)/(pi E)    Hertz, plane strain
//! f = 1.25 C^1.5 + 50 C^6                                                     Lindley, rings
//! ```
//!
//! A ring is free to give way along its circumference, a slice in plane strain is not: it
//! takes `1/(1 - nu^2)` of the force. In full slip along `x` friction is `m_s cos^2 + m_a
//! sin^2` of the force on the counterface along the motion and `(m_a - m_s) sin cos` sideways,
//! for grooves at an angle to it.

use std::f64::consts::PI;

use striae_figure::{Axis, Color, Content, Figure, Marker, Panel, Series, Width};
use striae_mesh::Vec3;
use striae_surface::texture::{Field, Lines, Paint};

use super::{
    measure::law_error,
    study::{Extent, Run, Study},
};
use crate::failure::Failure;

const DECKS: [(&str, &str); 2] = decks!("o-ring": "slice", "ring");
const SHEAR_MODULUS: f64 = 1.85;
const POISSONS_RATIO: f64 = 0.499;
/// Radius of the section, of the ring, and thickness of the slice, mm.
const SECTION: f64 = 1.765;
const RING: f64 = 11.085;
const SLICE: f64 = 0.2;
/// Coefficients along and across the grooves.
const MU: [f64; 2] = [0.2, 0.4];

/// Runs the case.
pub fn run(study: &mut Study) -> Result<(), Failure> {
    let quick = study.extent == Extent::Quick;
    let coarse = squeezed_slice(study, 8)?;
    study.measured("slice.8", hertz_error(&coarse));
    let mut slice = coarse;
    if quick {
        study.left_out.extend(["slice.16", "0.along", "90.along"]);
    } else {
        slice = squeezed_slice(study, 16)?;
        study.measured("slice.16", hertz_error(&slice));
    }
    let angles: &[u32] = if quick { &[45] } else { &[0, 45, 90] };
    let mut rings = Vec::new();
    for &angle in angles {
        rings.push(ring(study, angle, quick)?);
    }
    let lindley = rings[0].squeezed.iter().filter(|[c, _]| *c > 0.09);
    let squares = lindley.map(|[c, f]| (f / lindley_force(*c) - 1.0).powi(2));
    let squares: Vec<f64> = squares.collect();
    let mean = squares.iter().sum::<f64>() / squares.len() as f64;
    study.measured("ring.lindley", mean.sqrt());
    for one in &rings {
        let [along, sideways] = one.friction(one.run.column("time").len() - 1);
        study.measured(format!("{}.along", one.angle), along);
        if one.angle == 45 {
            study.measured("45.sideways", sideways);
        }
    }
    let worst = |of: fn(&Ring) -> f64| rings.iter().map(of).fold(0.0, f64::max);
    let law = |one: &Ring| law_error(&one.run, 0, Some(grooves(one.angle)));
    study.measured("law", rings.iter().map(law).fold(0.0, f64::max));
    study.measured("hub", worst(Ring::balance));
    study.measured("energy.imbalance", worst(Ring::imbalance));
    draw(study, &slice, &rings)
}

/// Young's modulus.
fn youngs_modulus() -> f64 {
    2.0 * SHEAR_MODULUS * (1.0 + POISSONS_RATIO)
}

/// `f` of rings over the squeeze.
fn lindley_force(squeeze: f64) -> f64 {
    1.25 * squeeze.powf(1.5) + 50.0 * squeeze.powi(6)
}

/// The squeeze at which a slice in plane strain has the force `f`.
fn hertz_squeeze(f: f64) -> f64 {
    let compliance = 1.0 - POISSONS_RATIO * POISSONS_RATIO;
    // b/R, with P = f E 2 R.
    let half_width = (8.0 * f * compliance / PI).sqrt();
    4.0 * f * compliance / PI * ((4.0 / half_width).ln() - 0.5)
}

/// Squeeze and force `f` by increment.
type Curve = Vec<[f64; 2]>;

fn squeezed_slice(study: &mut Study, divisions: usize) -> Result<Curve, Failure> {
    let (file, text) = DECKS[0];
    let meshed = format!("divisions = [{divisions}, {divisions}, 1]");
    let deck = study.variant(file, text, &[["divisions = [16, 16, 1]", &meshed]])?;
    let run = study.run(&format!("slice-{divisions}"), deck)?;
    let ways = run.column("displacement.plate.z").into_iter();
    let forces = run.column("pair.line.resultant_a.z");
    let scale = 2.0 / (SLICE * youngs_modulus() * 2.0 * SECTION);
    let rows = ways.zip(forces);
    Ok(rows
        .map(|(way, force)| [way / SECTION, force * scale])
        .collect())
}

/// Largest difference of the squeeze from Hertz's up to 0.05, over the latter.
fn hertz_error(curve: &Curve) -> f64 {
    let within = curve.iter().filter(|[c, _]| (0.015..0.055).contains(c));
    let errors = within.map(|[c, f]| (c / hertz_squeeze(*f) - 1.0).abs());
    errors.fold(0.0, f64::max)
}

/// A ring that was squeezed and dragged.
struct Ring {
    angle: u32,
    run: Run,
    squeezed: Curve,
}

/// Direction of the grooves.
fn grooves(angle: u32) -> Vec3 {
    let (sin, cos) = f64::from(angle).to_radians().sin_cos();
    Vec3::new(cos, sin, 0.0)
}

fn ring(study: &mut Study, angle: u32, quick: bool) -> Result<Ring, Failure> {
    let (file, text) = DECKS[1];
    let coarser = ["divisions = [2, 2, 24]", "divisions = [2, 1, 12]"];
    let passages: &[[&str; 2]] = if quick { &[coarser] } else { &[] };
    let mut deck = study.variant(file, text, passages)?;
    deck.model.pairs[0].textures[1] = Some(Paint::Field(Field {
        lines: Lines::Uniform(grooves(angle)),
        turn: 0.0,
    }));
    let run = study.run(&format!("ring-{angle}"), deck)?;
    let length = 2.0 * PI * RING;
    let scale = 1.0 / (length * youngs_modulus() * 2.0 * SECTION);
    let ways = run.column("displacement.counterface.z").into_iter();
    let forces = run.column("pair.slider.resultant_a.z");
    let rows = run.column("step").into_iter().zip(ways.zip(forces));
    let squeezed = rows.filter(|(step, _)| *step == 1.0);
    Ok(Ring {
        angle,
        squeezed: squeezed
            .map(|(_, (way, force))| [way / SECTION, force * scale])
            .collect(),
        run,
    })
}

/// Friction along and across the motion over the force on the counterface, by the law.
fn known(angle: f64) -> [f64; 2] {
    let (sin, cos) = angle.to_radians().sin_cos();
    let [along, across] = MU;
    [
        along * cos * cos + across * sin * sin,
        (across - along) * sin * cos,
    ]
}

impl Ring {
    /// Friction along and across the motion over the force on the counterface.
    fn friction(&self, row: usize) -> [f64; 2] {
        let of = |axis: &str| {
            let column = self.run.column(&format!("pair.slider.resultant_a.{axis}"));
            column.get(row).copied().unwrap_or(f64::NAN)
        };
        [-of("x") / of("z"), of("y") / of("z")]
    }

    /// Forces on hub, counterface and lid at the end that do not cancel, over the squeeze.
    fn balance(&self) -> f64 {
        let sum = |axis: &str| {
            let hub = self.run.at_end_of(3, &format!("reaction.seal.hub.{axis}"));
            let of = |pair: &str| format!("pair.{pair}.resultant_a.{axis}");
            let pairs = ["slider", "smooth"].map(|pair| self.run.at_end_of(3, &of(pair)));
            hub + pairs[0] + pairs[1]
        };
        let force = self.run.at_end_of(3, "pair.slider.resultant_a.z");
        Vec3::new(sum("x"), sum("y"), sum("z")).norm() / force
    }

    fn imbalance(&self) -> f64 {
        self.run.largest("energy.imbalance") / self.run.largest("energy.external")
    }
}

fn draw(study: &mut Study, slice: &Curve, rings: &[Ring]) -> Result<(), Failure> {
    let squeezes = || (1..=100).map(|step| 0.002 * f64::from(step));
    let lindley = squeezes().map(|c| [100.0 * c, lindley_force(c)]);
    let hertz = (0..=100).map(|step| 0.0015 * f64::from(step));
    let hertz = hertz.map(|f| [100.0 * hertz_squeeze(f.max(1e-9)), f]);
    let percent = |curve: &Curve| -> Curve { curve.iter().map(|[c, f]| [100.0 * c, *f]).collect() };
    let squeezing = Panel::new(
        Axis::linear("squeeze", "%").within(0.0, 20.0),
        Axis::linear("force / (E d length)", "").within(0.0, 0.16),
    )
    .with(Series::new("Hertz", Content::line(hertz.collect())).colored(Color::Black))
    .with(
        Series::new("slice", Content::markers(percent(slice), Marker::Circle))
            .colored(Color::Black),
    )
    .with(Series::new("Lindley", Content::line(lindley.collect())).colored(Color::Blue))
    .with(
        Series::new(
            "ring",
            Content::markers(percent(&rings[0].squeezed), Marker::Square),
        )
        .colored(Color::Blue),
    );
    let mut dragging = Panel::new(
        Axis::linear("way of the hub", "mm").within(0.0, 5.0),
        Axis::linear("friction / force", "").within(-0.05, 0.45),
    );
    for (one, color) in rings
        .iter()
        .zip([Color::Blue, Color::Green, Color::Vermillion])
    {
        let steps = one.run.column("step");
        let times = one.run.column("time");
        let way = |row: usize| match steps[row] {
            2.0 => 0.9 * (times[row] - 1.0),
            _ => 0.9 + 4.1 * (times[row] - 2.0),
        };
        let rows = || (0..steps.len()).filter(|row| steps[*row] > 1.0);
        let law = known(f64::from(one.angle));
        for (at, name) in [
            (0, format!("grooves at {}°", one.angle)),
            (1, String::new()),
        ] {
            let found = rows()
                .map(|row| [way(row), one.friction(row)[at]])
                .collect();
            let limit = Content::dashed(vec![[0.0, law[at]], [5.0, law[at]]]);
            dragging = dragging
                .with(Series::new(name, Content::line(found)).colored(color))
                .with(Series::new("", limit).colored(color));
        }
    }
    let figure = Figure::new(Width::Page, vec![squeezing, dragging]);
    study.draw(&figure, "squeeze-and-drag")
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;
    use striae_deck as deck;

    #[test]
    fn the_decks_have_the_constants_of_the_closed_forms() {
        for (name, text) in DECKS {
            let deck = deck::parse(text, name, Path::new("")).unwrap();
            let top = deck.model.bodies[0].mesh.positions.iter();
            let top = top.map(|x| x.z.abs()).fold(0.0, f64::max);
            assert!((top - SECTION).abs() < 1e-12, "{name}: {top}");
            assert!(text.contains("shear_modulus = 1.85\npoissons_ratio = 0.499"));
        }
        let [along, across] = MU;
        assert!(
            DECKS[1]
                .1
                .contains(&format!("mu_along = {along}, mu_across = {across}"))
        );
    }
}
