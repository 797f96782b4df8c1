//! `two-blocks`: a soft block pressed onto a stiff one and slid over it.
//!
//! Measures the resultants beside those of two other codes and of finer meshes, their
//! balance, the ratios of forces and of the integrals of friction and pressure in full
//! slip, the law at the kept nodes that slip, and the indifference to the order of
//! sides and bodies.

use striae_contact::{side::Side, unknowns::Status};
use striae_figure::{Axis, Color, Content, Figure, Marker, Panel, Series, Width};

use super::{
    measure::{mesh_lines, pressure_map},
    study::{Extent, Run, Study},
};
use crate::failure::Failure;

const DECKS: [(&str, &str); 4] = decks!("two-blocks": "deck", "collocated", "exchanged", "refined");
const NORMAL: &str = "pair.interface.resultant_b.z";
const TANGENTIAL: &str = "pair.interface.resultant_a.x";
const MU: f64 = 0.3;
/// Quantities that the quick run omits.
const FULL_ONLY: [&str; 4] = [
    "refined.press.normal",
    "refined.slide.normal",
    "refined.slide.fall",
    "refined.slide.forces",
];

/// Runs the case.
pub fn run(study: &mut Study) -> Result<(), Failure> {
    let [given, collocated, exchanged, refined] = DECKS;
    let given = ran(study, given)?;
    forces(study, "", &given);
    for quantity in ["mismatch", "moment_mismatch"] {
        study.measured(
            quantity,
            given.largest(&format!("pair.interface.{quantity}")),
        );
    }
    study.measured("law.slipping", law_error(&given));
    let collocated = ran(study, collocated)?;
    for side in ["a", "b"] {
        study.measured(format!("slide.ratio.{side}"), ratio(&given, side));
        let ratio = ratio(&collocated, side);
        study.measured(format!("collocated.ratio.{side}"), ratio);
    }
    let exchanged = ran(study, exchanged)?;
    study.measured("exchanged.difference", difference(&given, &exchanged));
    if study.extent == Extent::Full {
        let refined = ran(study, refined)?;
        forces(study, "refined.", &refined);
    } else {
        study.left_out.extend(FULL_ONLY);
    }
    study.draw(&reactions(&given), "reactions")?;
    study.draw(&pressures(&given), "pressure")
}

fn ran(study: &mut Study, (name, text): (&str, &str)) -> Result<Run, Failure> {
    let deck = study.deck(name, text)?;
    study.run(name, deck)
}

/// Normal forces after pressing and at the end, how much is left in between, and the
/// tangential force over the normal one at the end.
fn forces(study: &mut Study, prefix: &str, run: &Run) {
    let [pressed, slid] = [1, 2].map(|step| run.at_end_of(step, NORMAL));
    study.measured(format!("{prefix}press.normal"), pressed);
    study.measured(format!("{prefix}slide.normal"), slid);
    study.measured(format!("{prefix}slide.fall"), slid / pressed);
    let tangential = run.at_end_of(2, TANGENTIAL);
    study.measured(format!("{prefix}slide.forces"), tangential / slid);
}

/// `integral |tau| da / integral p da` at the end.
fn ratio(run: &Run, side: &str) -> f64 {
    let at_end = |name: &str| run.at_end_of(2, &format!("pair.interface.{name}_integral_{side}"));
    at_end("friction") / at_end("pressure")
}

/// Largest `||tau| - mu p| / mu p` of the kept nodes that slip at the end.
fn law_error(run: &Run) -> f64 {
    let pair = &run.finished.state.pairs[0];
    let mut largest = 0.0_f64;
    for side in Side::BOTH {
        for (node, kept) in pair.nodes[side].iter().zip(&pair.kept[side]) {
            if *kept && node.status == Status::Slip {
                let limit = MU * node.pressure;
                largest = largest.max((node.tau.norm() - limit).abs() / limit);
            }
        }
    }
    largest
}

/// Largest relative difference of the resultants on the lower block over all increments.
fn difference(given: &Run, exchanged: &Run) -> f64 {
    let components = ["x", "y", "z"];
    let columns = |run: &Run, side: &str| {
        components.map(|axis| run.column(&format!("pair.interface.resultant_{side}.{axis}")))
    };
    let (ours, theirs) = (columns(given, "a"), columns(exchanged, "b"));
    let mut largest = 0.0_f64;
    for row in 0..ours[0].len() {
        let of = |columns: &[Vec<f64>; 3], axis: usize| {
            columns[axis].get(row).copied().unwrap_or(f64::NAN)
        };
        let size = (0..3)
            .map(|axis| of(&ours, axis).powi(2))
            .sum::<f64>()
            .sqrt();
        for axis in 0..3 {
            let off = (of(&ours, axis) - of(&theirs, axis)).abs() / size;
            largest = if off.is_nan() { off } else { largest.max(off) };
        }
    }
    largest
}

fn reactions(given: &Run) -> Figure {
    let over_time = |name: &str| {
        let forces = given.column(name).into_iter().map(|force| force / 1e3);
        let rows = given.column("time").into_iter().zip(forces);
        let mut points = vec![[0.0, 0.0]];
        points.extend(rows.map(|(time, force)| [time, force]));
        points
    };
    let others = |points: &[[f64; 2]]| Content::markers(points.to_vec(), Marker::Cross);
    let panel = Panel::new(Axis::linear("time", ""), Axis::linear("force", "kN"))
        .with(Series::new("normal", Content::line(over_time(NORMAL))))
        .with(Series::new(
            "tangential",
            Content::line(over_time(TANGENTIAL)),
        ))
        .with(
            Series::new(
                "two other codes",
                others(&[
                    [1.0, 15.712],
                    [1.0, 15.714],
                    [2.0, 15.147],
                    [2.0, 15.213],
                    [2.0, 4.520],
                    [2.0, 4.549],
                ]),
            )
            .colored(Color::Black),
        );
    Figure::new(Width::Column, vec![panel])
}

fn pressures(given: &Run) -> Figure {
    let panel = |side: Side, title: &str| {
        let bar = Axis::linear("pressure", "kPa").within(0.0, 90.0);
        let mut map = pressure_map(given, side, 8, bar);
        if let Content::Facets { values, .. } = &mut map {
            values.iter_mut().for_each(|value| *value /= 1e3);
        }
        let axis = |label: &str| Axis::linear(label, "m").within(0.0, 1.0);
        Panel::plane(axis("x"), axis("y"))
            .titled(title)
            .with(Series::new("", map))
            .with(mesh_lines(given, Side::A, "lower block", Color::Grey))
            .with(mesh_lines(given, Side::B, "upper block", Color::Black))
    };
    let panels = vec![
        panel(Side::A, "on the lower block"),
        panel(Side::B, "on the upper block"),
    ];
    Figure::new(Width::Page, panels)
}
