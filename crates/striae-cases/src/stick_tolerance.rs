//! `stick-tolerance`: the strategy of the paper's Table 1 beside the default one.
//!
//! A tolerance lets sticking nodes exceed the law, so in partial slip the
//! tangential force is too large by about that much.

use striae_figure::{Axis, Color, Content, Figure, Panel, Series, Width};

use super::study::{Run, Study};
use crate::failure::Failure;

const DECKS: [(&str, &str); 1] = decks!("stick-tolerance": "deck");
const DEFAULT: &str = r#"method = "semismooth""#;
const TOLERANCES: [f64; 3] = [0.1, 0.01, 0.001];

/// Runs the case.
pub fn run(study: &mut Study) -> Result<(), Failure> {
    let [(name, text)] = DECKS;
    let deck = study.deck(name, text)?;
    let default = study.run("default", deck)?;
    study.measured("default.iterations", iterations(&default));
    study.measured("slide.ratio", slide_ratio(&default));
    let mut runs = Vec::new();
    for tolerance in TOLERANCES {
        let table_1 = format!("method = \"table-1\", stick_tolerance = {tolerance}");
        let deck = study.variant(name, text, &[[DEFAULT, &table_1]])?;
        let run = study.run_unjudged(&format!("tolerance-{tolerance}"), deck)?;
        study.measured(format!("{tolerance}.deviation"), deviation(&run, &default));
        study.measured(format!("{tolerance}.iterations"), iterations(&run));
        runs.push((tolerance, run));
    }
    study.draw(&figure(&default, &runs), "reactions")
}

/// Newton iterations of all increments.
fn iterations(run: &Run) -> f64 {
    run.column("iterations").iter().sum()
}

/// Tangential over normal force at the end.
fn slide_ratio(run: &Run) -> f64 {
    let force = |axis: &str| run.at_end_of(2, &format!("pair.contact.resultant_b.{axis}"));
    -force("x") / force("z")
}

/// Tangential force on the foundation of the whole block in the second step, MN.
fn tangential(run: &Run) -> Vec<[f64; 2]> {
    let force = run.column("pair.contact.resultant_b.x");
    let rows = run.column("time").into_iter().zip(force);
    rows.filter(|(time, _)| *time >= 1.0)
        .map(|(time, force)| [time, 2e3 * force])
        .collect()
}

/// Largest difference of the tangential forces over the largest of the default.
fn deviation(run: &Run, default: &Run) -> f64 {
    let (ours, theirs) = (tangential(run), tangential(default));
    if ours.len() != theirs.len() {
        return f64::NAN;
    }
    let largest = theirs
        .iter()
        .map(|[_, force]| force.abs())
        .fold(0.0, f64::max);
    let apart = ours.iter().zip(&theirs).map(|(a, b)| (a[1] - b[1]).abs());
    apart.fold(0.0, f64::max) / largest
}

fn figure(default: &Run, runs: &[(f64, Run)]) -> Figure {
    let forces = Panel::new(
        Axis::linear("time", ""),
        Axis::linear("tangential force", "MN"),
    );
    let counts = Panel::new(Axis::linear("time", ""), Axis::linear("iterations", ""));
    let counted = |run: &Run| {
        let counts = run.column("iterations");
        let rows = run.column("time").into_iter().zip(counts);
        let sheared = rows.filter(|(time, _)| *time > 1.0);
        Content::line(sheared.map(|(time, count)| [time, count]).collect())
    };
    let colors = [Color::Vermillion, Color::Green, Color::Blue];
    let mut panels = [forces, counts];
    for ((tolerance, run), color) in runs.iter().zip(colors) {
        let name = format!("tolerance {tolerance}");
        let contents = [Content::line(tangential(run)), counted(run)];
        panels = add(panels, &name, contents, color);
    }
    let contents = [Content::dashed(tangential(default)), counted(default)];
    panels = add(panels, "default", contents, Color::Black);
    Figure::new(Width::Page, panels.into())
}

fn add(panels: [Panel; 2], name: &str, contents: [Content; 2], color: Color) -> [Panel; 2] {
    let [forces, counts] = panels;
    let [force, count] = contents.map(|content| Series::new(name, content).colored(color));
    [forces.with(force), counts.with(count)]
}
