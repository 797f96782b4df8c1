//! `tyre-locked`: a tyre with a locked wheel slides over a road and drifts.
//!
//! Free sideways it takes the direction in which friction has no lateral part,
//! `w . y = 0`.

use striae_figure::{Axis, Color, Content, Figure, Panel, Series, Width};

use super::{
    study::{Run, Study},
    tyre::{account, arrows, deck, drift, pressures},
};
use crate::failure::Failure;

const DECKS: [(&str, &str); 1] = decks!("tyre-locked": "deck");

/// Runs the case.
pub fn run(study: &mut Study) -> Result<(), Failure> {
    let [(name, text)] = DECKS;
    let deck = deck(study, name, text)?;
    let run = study.run(name, deck)?;
    let closed = drift();
    study.measured("drift.closed_form", closed);
    study.measured("drift.angle", terminal(&path(&run)));
    study.measured("drift.way", path(&run).last().map_or(f64::NAN, |at| at[1]));
    account(study, &run);
    let last = &run.finished.state;
    let figure = vec![paths(&run, closed)];
    study.draw(&Figure::new(Width::Page, figure), "path")?;
    let patch = vec![pressures(&run, last), arrows(&run, last)];
    study.draw(&Figure::new(Width::Page, patch), "patch")
}

/// Way of the axle since it moves forward.
pub fn path(run: &Run) -> Vec<[f64; 2]> {
    let (x, y) = (
        run.column("displacement.rim.x"),
        run.column("displacement.rim.y"),
    );
    let steps = run.column("step");
    let start = steps.iter().rposition(|&step| step == 1.0).unwrap_or(0);
    x.into_iter()
        .zip(y)
        .skip(start)
        .map(|(x, y)| [x, y])
        .collect()
}

/// Direction of the path over its last quarter, in degrees.
fn terminal(path: &[[f64; 2]]) -> f64 {
    let (from, to) = (path[3 * path.len() / 4], path[path.len() - 1]);
    (to[1] - from[1]).atan2(to[0] - from[0]).to_degrees()
}

fn paths(run: &Run, closed: f64) -> Panel {
    let points = path(run);
    let end = points[points.len() - 1];
    let back = end[0] * closed.to_radians().tan();
    let expected = vec![[0.0, end[1] - back], end];
    Panel::plane(
        Axis::linear("x", "m").within(-0.05, 0.95),
        Axis::linear("y", "m").within(-0.3, 0.1),
    )
    .with(Series::new("axle", Content::line(points)).colored(Color::Blue))
    .with(Series::new("w.y = 0", Content::dashed(expected)).colored(Color::Grey))
}
