//! `patch-stick`: an oblique interface sticks up to the load of a closed form.
//!
//! Two blocks of height 1 and one linear material with Poisson's ratio 0 carry
//! the uniform stress
//!
//! ```text
//! sigma = [[0, 0, s], [0, 0, 0], [s, 0, -p]],
//! grad u = H = [[0, 0, s/G], [0, 0, 0], [0, 0, -p/E]],   G = E/2.
//! ```
//!
//! Tractions per reference area on the interface of reference normal `N` are
//! `t = sigma N`; its current normal is along `n = F^-T N`, `F = I + H`. The
//! interface gives way where `|t - n n.t| = mu |n.t|`.

use nalgebra::Matrix3;
use striae_figure::{Axis, Color, Content, Figure, Marker, Panel, Series, Width};
use striae_mesh::Vec3;

use super::{
    measure::stress_error,
    study::{Run, Study},
};
use crate::failure::Failure;

const DECKS: [(&str, &str); 4] =
    decks!("patch-stick": "matching", "three-to-four", "four-to-three", "turned");
const YOUNGS_MODULUS: f64 = 1000.0;
const PRESSURE: f64 = 10.0;
const MU: f64 = 0.3;
const SLOPES: [f64; 2] = [0.2, 0.1];
const HEIGHT: f64 = 2.0;
const AREA: f64 = 4.0;
/// Share of the limit that is reached at the end of the step `shear`.
const BEFORE: f64 = 0.99;

/// Runs the case.
pub fn run(study: &mut Study) -> Result<(), Failure> {
    let limit = limit();
    study.measured("limit.closed_form", limit);
    let mut worst = [0.0_f64; 2];
    let mut curves = Vec::new();
    for (name, text) in DECKS {
        let mut sticking = study.deck(name, text)?;
        sticking.model.steps.truncate(2);
        let sticking = study.run(&format!("{name}-sticking"), sticking)?;
        let stress = stress_error(&sticking, &stress(BEFORE * limit));
        let displacement = displacement_error(&sticking, BEFORE * limit);
        worst = [worst[0].max(stress), worst[1].max(displacement)];

        let deck = study.deck(name, text)?;
        let slipping = study.run(name, deck)?;
        let departure = Departure::of(&slipping);
        study.measured(format!("{name}.left_behind"), departure.left_behind);
        study.measured(format!("{name}.last_stick"), departure.last_stick / limit);
        study.measured(format!("{name}.first_slip"), departure.first_slip / limit);
        let carried = slipping.at_end_of(3, SHEAR) / AREA;
        study.measured(format!("{name}.carried"), carried / limit);
        curves.push((name, slipping));
    }
    study.measured("stick.stress", worst[0]);
    study.measured("stick.displacement", worst[1]);
    study.draw(&figure(&curves, limit), "stick-to-slip")
}

const SHEAR: &str = "reaction.upper.zmax.x";

fn strain(s: f64) -> Matrix3<f64> {
    let mut strain = Matrix3::zeros();
    strain[(0, 2)] = s / (YOUNGS_MODULUS / 2.0);
    strain[(2, 2)] = -PRESSURE / YOUNGS_MODULUS;
    strain
}

fn stress(s: f64) -> Matrix3<f64> {
    Matrix3::new(0.0, 0.0, s, 0.0, 0.0, 0.0, s, 0.0, -PRESSURE)
}

/// `|t - n n.t| / |n.t|` on the interface.
fn inclination(s: f64) -> f64 {
    let normal = Vec3::new(-SLOPES[0], -SLOPES[1], 1.0);
    let gradient = Matrix3::identity() + strain(s);
    let inverse = gradient.try_inverse().unwrap_or_else(Matrix3::zeros);
    let n = (inverse.transpose() * normal).normalize();
    let traction = stress(s) * normal;
    let pressure = -n.dot(&traction);
    (traction + n * pressure).norm() / pressure
}

/// The shear stress at which the interface gives way, by bisection: between the
/// shear that undoes the slope and the pressure the inclination rises.
fn limit() -> f64 {
    let (mut low, mut high) = (0.3 * PRESSURE, PRESSURE);
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        if inclination(middle) < MU {
            low = middle;
        } else {
            high = middle;
        }
    }
    low
}

/// Largest `|x - F X|` over the largest displacement.
fn displacement_error(run: &Run, s: f64) -> f64 {
    let gradient = strain(s);
    let (problem, state) = (&run.finished.problem, &run.finished.state);
    let nodes = problem.reference.iter().zip(&state.positions);
    let (mut error, mut size) = (0.0_f64, 0.0_f64);
    for (reference, position) in nodes {
        let expected = gradient * reference;
        error = error.max((position - reference - expected).norm());
        size = size.max(expected.norm());
    }
    error / size
}

/// Departure of the interface from stick.
struct Departure {
    /// Nodes that still stick in the first increment with slip.
    left_behind: f64,
    /// Shear stress of the last increment without slip.
    last_stick: f64,
    /// Shear stress that would be reached elastically in the first increment with slip.
    first_slip: f64,
}

impl Departure {
    fn of(run: &Run) -> Self {
        let column = |name: &str| run.column(name);
        let (stick, slip) = (
            column("pair.interface.stick"),
            column("pair.interface.slip"),
        );
        let elastic = elastic_shear(run);
        let first = slip.iter().position(|&count| count > 0.0);
        let at = |values: &[f64], row: Option<usize>| {
            row.and_then(|row| values.get(row).copied())
                .unwrap_or(f64::NAN)
        };
        Self {
            left_behind: at(&stick, first),
            last_stick: at(&elastic, first.and_then(|row| row.checked_sub(1))),
            first_slip: at(&elastic, first),
        }
    }
}

/// `G u/h` of every increment, `u` the displacement of the upper face.
fn elastic_shear(run: &Run) -> Vec<f64> {
    let limit = limit();
    let times = run.column("time").into_iter();
    times
        .map(|time| match time {
            t if t <= 1.0 => 0.0,
            t if t <= 2.0 => BEFORE * limit * (t - 1.0),
            t => limit * (BEFORE + 2.0 * (1.0 - BEFORE) * (t - 2.0)),
        })
        .collect()
}

fn figure(curves: &[(&str, Run)], limit: f64) -> Figure {
    let exact = vec![[0.0, 0.0], [limit, limit], [1.01 * limit, limit]];
    let displacement = |shear: f64| 1e3 * shear / (YOUNGS_MODULUS / 2.0) * HEIGHT;
    let scaled = |points: Vec<[f64; 2]>| -> Vec<[f64; 2]> {
        points
            .into_iter()
            .map(|[x, y]| [displacement(x), y])
            .collect()
    };
    let x = || Axis::linear("displacement of the upper face", "1e-3");
    let near = [0.985, 1.012].map(|share| displacement(share * limit));
    let mut forces = Panel::new(
        x().within(near[0], near[1]),
        Axis::linear("shear stress", "").within(0.985 * limit, 1.005 * limit),
    )
    .with(Series::new("closed form", Content::line(scaled(exact))).colored(Color::Grey));
    let mut counts = Panel::new(
        x().within(near[0], near[1]),
        Axis::linear("share of sticking nodes", "").within(-0.1, 1.1),
    );
    let looks = [
        (Marker::Circle, Color::Blue),
        (Marker::Square, Color::Vermillion),
        (Marker::Triangle, Color::Green),
        (Marker::Cross, Color::Black),
    ];
    for ((name, run), (marker, color)) in curves.iter().zip(looks) {
        let elastic = elastic_shear(run);
        let shear = run.column(SHEAR).into_iter().map(|force| force / AREA);
        let points = elastic.iter().copied().zip(shear).map(|(x, y)| [x, y]);
        let name = name.replace('-', " ");
        let content = Content::markers(scaled(points.collect()), marker);
        forces = forces.with(Series::new(name.clone(), content).colored(color));
        let (stick, slip) = (
            run.column("pair.interface.stick"),
            run.column("pair.interface.slip"),
        );
        let shares = stick
            .iter()
            .zip(&slip)
            .map(|(stick, slip)| stick / (stick + slip));
        let points = elastic.iter().copied().zip(shares).map(|(x, y)| [x, y]);
        let content = Content::markers(scaled(points.collect()), marker);
        counts = counts.with(Series::new(name, content).colored(color));
    }
    let at_limit = [[displacement(limit), -1.0], [displacement(limit), 2.0]];
    counts = counts
        .with(Series::new("closed form", Content::dashed(at_limit.to_vec())).colored(Color::Grey));
    Figure::new(Width::Page, vec![forces, counts])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_decks_carry_the_limit_of_the_closed_form() {
        let limit = limit();
        assert!((inclination(limit) - MU).abs() < 1e-14);
        for (name, text) in DECKS {
            let moved = |share: f64| share * displacement_at(limit);
            for number in [BEFORE * limit, limit, moved(BEFORE), moved(2.0 - BEFORE)] {
                let digits = format!("{number:.12}");
                assert!(
                    text.contains(&digits[..digits.len() - 1]),
                    "{name}: {digits}"
                );
            }
        }
    }

    fn displacement_at(shear: f64) -> f64 {
        shear / (YOUNGS_MODULUS / 2.0) * HEIGHT
    }
}
