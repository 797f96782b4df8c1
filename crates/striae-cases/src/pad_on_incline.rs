//! `pad-on-incline`: a pad holds below the limit of friction and slides above it.

use striae_figure::{Axis, Color, Content, Figure, Line, Marker, Panel, Series, Width};
use striae_solve::outcome::Ending;

use super::study::{Run, Study};
use crate::failure::Failure;

const DECKS: [(&str, &str); 2] = decks!("pad-on-incline": "hold", "slide");
/// Normal of the slope.
const NORMAL: [f64; 2] = [-0.5, 0.866_025_403_784_438_6];
const MU: f64 = 0.3;
/// Pressure on the end face at the end of the deck `slide`.
const SLIDES: f64 = 181.8;

/// Runs the case.
pub fn run(study: &mut Study) -> Result<(), Failure> {
    let [(hold, hold_text), (slide, slide_text)] = DECKS;
    let deck = study.deck(hold, hold_text)?;
    let held = study.run(hold, deck)?;
    for axis in ["x", "z"] {
        let force = held.at_end_of(1, &format!("pair.sole.resultant_a.{axis}"));
        study.measured(format!("pressed.force.{axis}"), force);
    }
    study.measured("hold.stick", held.at_end_of(2, "pair.sole.stick"));
    let deck = study.deck(slide, slide_text)?;
    let slid = study.run_to_limit(slide, deck)?;
    let limit = match slid.finished.ending {
        Ending::Stopped { time, .. } => SLIDES * (time - 1.0),
        _ => f64::INFINITY,
    };
    study.measured("slide.limit", limit);
    study.draw(&figure(&slid), "friction")
}

/// Friction over normal force and share of slipping nodes, over the pressure on the end face.
fn figure(slid: &Run) -> Figure {
    let load = || Axis::linear("pressure on the end face", "MPa").within(0.0, 200.0);
    let limit = |height: f64| {
        let points = vec![[180.0, 0.0], [180.0, height]];
        Series::new("limit, 180 MPa", Content::dashed(points)).colored(Color::Grey)
    };
    let law = vec![[0.0, MU], [200.0, MU]];
    let computed = |value| Content::Curve {
        points: over_load(slid, value),
        line: Line::Solid,
        marker: Marker::Circle,
    };
    let ratio = Panel::new(
        load(),
        Axis::linear("friction / normal force", "").within(0.0, 0.35),
    )
    .with(Series::new("coefficient", Content::dashed(law)).colored(Color::Black))
    .with(limit(0.35))
    .with(Series::new("computed", computed(friction)).colored(Color::Blue));
    let share = Panel::new(
        load(),
        Axis::linear("share of slipping nodes", "").within(0.0, 1.0),
    )
    .with(limit(1.0))
    .with(Series::new("computed", computed(slipping)).colored(Color::Blue));
    Figure::new(Width::Page, vec![ratio, share])
}

/// A quantity of every increment of the push, over its load.
fn over_load(run: &Run, value: fn(&Run, usize) -> f64) -> Vec<[f64; 2]> {
    let times = run.column("time").into_iter().enumerate();
    times
        .filter(|(_, time)| *time >= 1.0)
        .map(|(row, time)| [SLIDES * (time - 1.0), value(run, row)])
        .collect()
}

fn friction(run: &Run, row: usize) -> f64 {
    let at = |axis: &str| run.column(&format!("pair.sole.resultant_a.{axis}"))[row];
    let (x, z) = (at("x"), at("z"));
    let normal = x * NORMAL[0] + z * NORMAL[1];
    let along = x * NORMAL[1] - z * NORMAL[0];
    along.abs() / normal
}

fn slipping(run: &Run, row: usize) -> f64 {
    let count = |name: &str| run.column(&format!("pair.sole.{name}"))[row];
    count("slip") / (count("slip") + count("stick"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_limit_is_that_of_the_loads() {
        let normal_force = 300.0 * 40.0 * 20.0;
        let end_face = 20.0 * 20.0;
        assert!((MU * normal_force / end_face - 180.0).abs() < 1e-12);
        for (text, pressure) in [(DECKS[0].1, 178.2), (DECKS[1].1, SLIDES)] {
            let vector = format!("[-{:.11}", pressure * NORMAL[1]);
            assert!(text.contains(&vector[..vector.len() - 1]), "{vector}");
        }
    }
}
