//! `stack`: blocks in a T and in a pile, everything in contact beside named pairs.

use striae_figure::{Axis, Content, Figure, Marker, Panel, Series, Width};

use super::study::{Run, Study};
use crate::failure::Failure;

const DECKS: [(&str, &str); 4] = decks!("stack": "tee", "tee-named", "pile", "pile-named");
/// Couples that meet, by scene.
const COUPLES: [&[&str]; 2] = [
    &["left-right", "left-top", "right-top"],
    &[
        "first-second",
        "second-third",
        "third-fourth",
        "fourth-fifth",
    ],
];
const COMPONENTS: [&str; 3] = ["x", "y", "z"];

/// Runs the case.
pub fn run(study: &mut Study) -> Result<(), Failure> {
    let mut panels = Vec::new();
    for (scene, couples) in COUPLES.into_iter().enumerate() {
        let [all, named] = [DECKS[2 * scene], DECKS[2 * scene + 1]];
        let all = ran(study, all)?;
        let named = ran(study, named)?;
        let name = DECKS[2 * scene].0;
        study.measured(
            format!("{name}.difference"),
            difference(&all, &named, couples),
        );
        study.measured(format!("{name}.others"), others(&all, &named, couples));
        let mismatch = couples
            .iter()
            .map(|couple| all.largest(&format!("pair.{couple}.mismatch")));
        study.measured(format!("{name}.mismatch"), mismatch.fold(0.0, f64::max));
        panels.push(panel(name, &all, &named, couples));
    }
    study.draw(&Figure::new(Width::Page, panels), "forces")
}

fn ran(study: &mut Study, (name, text): (&str, &str)) -> Result<Run, Failure> {
    let deck = study.deck(name, text)?;
    study.run(name, deck)
}

/// Columns of the force on the first side of a pair.
fn force(run: &Run, pair: &str) -> [Vec<f64>; 3] {
    COMPONENTS.map(|axis| run.column(&format!("pair.{pair}.resultant_a.{axis}")))
}

/// Largest force of a couple in any increment.
fn largest(run: &Run, couples: &[&str]) -> f64 {
    let forces = couples.iter().flat_map(|couple| force(run, couple));
    let sizes = forces.flatten().map(f64::abs);
    sizes.fold(0.0, f64::max)
}

/// Largest difference of a component of a couple's force, over the largest force.
fn difference(all: &Run, named: &Run, couples: &[&str]) -> f64 {
    let mut most = 0.0_f64;
    for couple in couples {
        for (one, other) in force(all, couple).iter().zip(force(named, couple)) {
            // Increments that were cut would not be beside each other.
            if one.len() != other.len() {
                return f64::NAN;
            }
            let apart = one
                .iter()
                .zip(&other)
                .map(|(one, other)| (one - other).abs());
            most = apart.fold(most, f64::max);
        }
    }
    most / largest(named, couples)
}

/// Largest force of any other pair, over that of the couples.
fn others(all: &Run, named: &Run, couples: &[&str]) -> f64 {
    let pairs = all.finished.problem.model.pairs.iter();
    let names = pairs.map(|pair| pair.name.as_str());
    let others: Vec<&str> = names.filter(|name| !couples.contains(name)).collect();
    largest(all, &others) / largest(named, couples)
}

/// Size of the force of each couple over time.
fn panel(scene: &str, all: &Run, named: &Run, couples: &[&str]) -> Panel {
    let sizes = |run: &Run, couple: &str| -> Vec<[f64; 2]> {
        let [x, y, z] = force(run, couple);
        let times = run.column("time").into_iter().enumerate();
        let size = |row: usize| {
            let of = |column: &[f64]| column.get(row).copied().unwrap_or(f64::NAN);
            (of(&x).powi(2) + of(&y).powi(2) + of(&z).powi(2)).sqrt() / 1e3
        };
        times.map(|(row, time)| [time, size(row)]).collect()
    };
    let panel = Panel::new(Axis::linear("time", ""), Axis::linear("force", "kN")).titled(scene);
    couples.iter().fold(panel, |panel, couple| {
        let crosses = Content::markers(sizes(named, couple), Marker::Cross);
        panel
            .with(Series::new(*couple, Content::line(sizes(all, couple))))
            .with(Series::new("", crosses))
    })
}
