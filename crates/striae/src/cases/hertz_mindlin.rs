//! `hertz-mindlin`: a block with a spherical face on a rigid plane.
//!
//! Pressed without friction and then sheared with it, on a family of meshes.
//! Pressure and friction are held against Mindlin's closed form, evaluated with
//! the computed resultants `P` and `Q`, around the computed centre of pressure.

use striae_io::figure::{Axis, Color, Content, Figure, Line, Marker, Panel, Series, Width};
use striae_mesh::Vec3;
use striae_verify::closed_forms::{PartialSlip, PointContact, contact_modulus};

use super::{
    comparison::{Sample, centre, convergence, difference, limit, nodal_samples, rate, samples},
    study::{Extent, Run, Study},
};
use crate::failure::Failure;

const DECKS: [(&str, &str); 1] = decks!("hertz-mindlin": "deck");
/// Element sizes, coarsest first; a quick look takes the first two.
const SIZES: [f64; 4] = [0.8, 0.4, 0.2, 0.1];
/// What a quick look does not give.
const FULL_ONLY: [&str; 8] = [
    "pressure.error",
    "pressure.rate",
    "pressure.rate.to_limit",
    "pressure.limit",
    "friction.error",
    "friction.rate",
    "friction.limit",
    "peak.ratio.limit",
];
const MU: f64 = 0.1;
const RADIUS: f64 = 12.0;
const LAMBDA: f64 = 0.657;
const SHEAR_MODULUS: f64 = 0.164;

/// What a mesh gives.
struct Measured {
    size: f64,
    exact: PartialSlip,
    /// Normal and tangential force over the steps, in GN of the whole block.
    history: Vec<[f64; 3]>,
    /// Place, pressure and friction of the nodes in the plane of symmetry.
    trace: Vec<[f64; 3]>,
    /// Largest nodal pressure and friction.
    peaks: [f64; 2],
    /// Relative errors of pressure and friction.
    errors: [f64; 2],
}

/// Runs the case.
pub fn run(study: &mut Study) -> Result<(), Failure> {
    let sizes = match study.extent {
        Extent::Full => &SIZES[..],
        Extent::Quick => &SIZES[..2],
    };
    let mut family = Vec::new();
    for &size in sizes {
        let run = ran(study, size)?;
        family.push(measured(&run, size));
    }
    if study.extent == Extent::Quick {
        study.left_out.extend(FULL_ONLY);
    }
    let errors = judged(study, &family);
    study.draw(&traces(&family), "traces")?;
    study.draw(&convergence("m", &errors), "convergence")?;
    study.draw(&reactions(&family), "reactions")
}

/// Errors by name over the element size.
fn judged(study: &mut Study, family: &[Measured]) -> Vec<(String, Vec<[f64; 2]>)> {
    let over_size = |value: &dyn Fn(&Measured) -> f64| -> Vec<[f64; 2]> {
        family.iter().map(|m| [m.size, value(m)]).collect()
    };
    let finest = &family[family.len() - 1];
    let mut all = Vec::new();
    for (of, name) in ["pressure", "friction"].into_iter().enumerate() {
        let errors = over_size(&|m| m.errors[of]);
        let limit = limit(&errors);
        let rest: Vec<[f64; 2]> = errors.iter().map(|[h, e]| [*h, e - limit]).collect();
        study.measured(format!("{name}.peak"), finest.peaks[of]);
        study.measured(format!("{name}.error"), finest.errors[of]);
        study.measured(format!("{name}.rate"), rate(&errors));
        study.measured(format!("{name}.limit"), limit);
        study.measured(format!("{name}.rate.to_limit"), rate(&rest));
        all.push((name.to_owned(), errors));
    }
    let ratio = over_size(&|m| m.peaks[0] / m.exact.contact.peak_pressure);
    study.measured("peak.ratio.limit", limit(&ratio));
    all
}

fn ran(study: &mut Study, size: f64) -> Result<Run, Failure> {
    let [(name, text)] = DECKS;
    let wanted = format!("element_size = {size}");
    let deck = study.variant(name, text, &[["element_size = 0.8", &wanted]])?;
    study.run(&format!("h-{size}"), deck)
}

fn measured(run: &Run, size: f64) -> Measured {
    let samples = samples(run, 0);
    let middle = centre(&samples).x;
    let history = history(run);
    let exact = closed_form(history[history.len() - 1]);
    let distance = |sample: &Sample| (sample.place.x - middle).hypot(sample.place.y);
    let along = |value: f64| Vec3::new(value, 0.0, 0.0);
    let mut nodes = nodal_samples(run, 0);
    let largest = |values: &mut dyn Iterator<Item = f64>| values.fold(0.0, f64::max);
    let peaks = [
        largest(&mut nodes.iter().map(|node| node.pressure)),
        largest(&mut nodes.iter().map(|node| node.tau.norm())),
    ];
    nodes.retain(|node| node.place.y == 0.0);
    nodes.sort_by(|a, b| a.place.x.total_cmp(&b.place.x));
    let at = |s: &Sample| [s.place.x - middle, s.pressure, -s.tau.x];
    Measured {
        size,
        trace: nodes.iter().map(at).collect(),
        peaks,
        errors: [
            difference(
                &samples,
                |s| along(s.pressure),
                |s| along(exact.contact.pressure(distance(s))),
            ),
            difference(&samples, |s| s.tau, |s| along(-exact.traction(distance(s)))),
        ],
        exact,
        history,
    }
}

/// Time, normal and tangential force on the foundation of the whole block.
fn history(run: &Run) -> Vec<[f64; 3]> {
    let force = |axis: &str| run.column(&format!("pair.contact.resultant_b.{axis}"));
    let (normal, tangential) = (force("z"), force("x"));
    let times = run.column("time").into_iter().enumerate();
    times
        .map(|(row, time)| [time, -2.0 * normal[row], 2.0 * tangential[row]])
        .collect()
}

fn closed_form([_, normal, tangential]: [f64; 3]) -> PartialSlip {
    let poissons_ratio = 0.5 * LAMBDA / (LAMBDA + SHEAR_MODULUS);
    let youngs_modulus = 2.0 * SHEAR_MODULUS * (1.0 + poissons_ratio);
    let modulus = contact_modulus(&[[youngs_modulus, poissons_ratio]]);
    PartialSlip::new(PointContact::new(normal, RADIUS, modulus), MU, tangential)
}

/// Pressure and friction in the plane of symmetry, a row a mesh.
fn traces(family: &[Measured]) -> Figure {
    let x = || Axis::linear("x", "m").within(-1.8, 1.8);
    let mut panels = Vec::new();
    for measured in family {
        let exact = &measured.exact;
        let curve = |value: &dyn Fn(f64) -> f64| {
            let places = (-400..=400).map(|i| f64::from(i) / 200.0);
            let points = places.map(|x| [x, 1e3 * value(x.abs())]);
            Series::new("Mindlin", Content::line(points.collect())).colored(Color::Black)
        };
        let nodes = |of: usize| {
            let points = measured
                .trace
                .iter()
                .map(|point| [point[0], 1e3 * point[of]]);
            let content = Content::Curve {
                points: points.collect(),
                line: Line::None,
                marker: Marker::Circle,
            };
            Series::new("computed", content).colored(Color::Vermillion)
        };
        let title = format!("h = {} m", measured.size);
        let pressure = Axis::linear("pressure", "MPa").within(0.0, 50.0);
        let friction = Axis::linear("friction", "MPa").within(0.0, 4.0);
        panels.push(
            Panel::new(x(), pressure)
                .titled(title.clone())
                .with(curve(&|r| exact.contact.pressure(r)))
                .with(nodes(1)),
        );
        panels.push(
            Panel::new(x(), friction)
                .titled(title)
                .with(curve(&|r| exact.traction(r)))
                .with(nodes(2)),
        );
    }
    let columns = 2;
    Figure {
        columns,
        ..Figure::new(Width::Page, panels)
    }
}

/// Forces over time.
fn reactions(family: &[Measured]) -> Figure {
    let panel = |label: &str, of: usize| {
        let panel = Panel::new(Axis::linear("time", ""), Axis::linear(label, "MN"));
        family.iter().fold(panel, |panel, measured| {
            let rows = measured.history.iter().map(|row| [row[0], 1e3 * row[of]]);
            let points = std::iter::once([0.0, 0.0]).chain(rows).collect();
            let name = format!("h = {} m", measured.size);
            panel.with(Series::new(name, Content::line(points)))
        })
    };
    let panels = vec![panel("normal force", 1), panel("tangential force", 2)];
    Figure::new(Width::Page, panels)
}
