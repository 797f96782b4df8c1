//! `hertz-mindlin`: a block with a spherical face on a rigid plane.
//!
//! Pressed without friction and then sheared with it, on a family of meshes. Pressure and friction
//! are compared with Mindlin's closed form, evaluated with the computed resultants `P` and `Q`,
//! around the computed centre of pressure.
//!
//! Effects that the closed form neglects are removed one by one: a sphere of a hundred times the
//! radius under a hundredth of the depth has a contact zone of equal size and a hundredth of the
//! strains, and is only pressed, without friction; a block of twice the edges is closer to a half
//! space. Away from the edge of the contact zone, where the pressure is smooth, little else is
//! left.

use striae_contact::side::Side;
use striae_figure::{Axis, Color, Content, Figure, Line, Marker, Panel, Series, Width};
use striae_mesh::Vec3;
use striae_verify::closed_forms::{PartialSlip, PointContact, contact_modulus};

use super::{
    comparison::{
        Sample, centre, convergence, difference, difference_of_means, limit, nodal_samples, rate,
        samples,
    },
    study::{Extent, Run, Study},
};
use crate::failure::Failure;

const DECKS: [(&str, &str); 1] = decks!("hertz-mindlin": "deck");
/// Element sizes, coarsest first; a quick look takes the first two.
const SIZES: [f64; 4] = [0.8, 0.4, 0.2, 0.1];
/// Element sizes of the ideal contact, those that resolve the zone.
const IDEAL_SIZES: [f64; 3] = [0.4, 0.2, 0.1];
/// Sizes of hexahedra that are divided into ten-node tetrahedra of the ideal contact; nodes
/// are half as far apart.
const TETRAHEDRAL_SIZES: [f64; 3] = [0.8, 0.56, 0.4];
/// Meshes of about 3 000 and 13 000 unknowns that show what forces cost: name of the
/// quantity, element size and half width of the fine part.
const ECONOMICAL: [(&str, f64, f64); 2] = [("3k", 0.5, 1.4), ("13k", 0.25, 1.6)];
/// Element size at which parts of the difference are separated.
const PARTED: f64 = 0.2;
/// Radius within which the pressure is smooth, over that of the contact zone.
const INNER: f64 = 0.7;
/// Quantities that the quick run omits.
const FULL_ONLY: [&str; 21] = [
    "force.error.0.4",
    "force.error.3k",
    "force.error.13k",
    "force.error.0.2",
    "pressure.error",
    "pressure.rate",
    "pressure.rate.to_limit",
    "pressure.limit",
    "friction.error",
    "friction.rate",
    "friction.limit",
    "peak.ratio.limit",
    "inner.error",
    "shallow.inner.error",
    "ideal.inner.error",
    "ideal.pressure.error",
    "ideal.pressure.rate",
    "ideal.field.error",
    "ideal.field.rate",
    "tetrahedra.pressure.error",
    "tetrahedra.pressure.rate",
];
const MU: f64 = 0.1;
const RADIUS: f64 = 12.0;
const SHALLOW_RADIUS: f64 = 1200.0;
/// Deck with an equal contact zone and a hundredth of the strains, only pressed.
const SHALLOW: [[&str; 2]; 4] = [
    ["radius = 12,", "radius = 1200,"],
    ["increments = 5", "increments = 10"],
    ["z = -0.15 }", "z = -0.0015 }"],
    [
        r#"[[step]]
name = "shear"
increments = 10
friction = [{ pair = "contact", law = "coulomb", mu = 0.1 }]
displacement = [{ body = "block", nodes = "zmax", x = 0.015 }]"#,
        "",
    ],
];
/// A block of twice the edges.
const WIDE: [&str; 2] = [
    "size = [10, 10], height = 6.5",
    "size = [20, 20], height = 13",
];
/// Decks with ten-node tetrahedra instead of hexahedra.
const TETRAHEDRA: [&str; 2] = [
    "radius = 1200,",
    r#"radius = 1200, cells = "composite-tetrahedra","#,
];
const LAMBDA: f64 = 0.657;
const SHEAR_MODULUS: f64 = 0.164;

/// Results on one mesh.
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
        let run = ran(study, &format!("h-{size}"), size, &[])?;
        if size == PARTED {
            let error = pressure_error(&run, RADIUS, INNER);
            study.measured("inner.error", error);
        }
        family.push(measured(&run, size));
    }
    let mut errors = judged(study, &family);
    if study.extent == Extent::Quick {
        study.left_out.extend(FULL_ONLY);
    } else {
        economical(study, &family[family.len() - 1])?;
        errors.push(("pressure, ideal".to_owned(), ideal(study)?));
        let tetrahedra = tetrahedra(study)?;
        errors.push(("means, ideal, tetrahedra".to_owned(), tetrahedra));
    }
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
    for m in &family[..family.len() - 1] {
        study.measured(format!("force.error.{}", m.size), m.force_error(finest));
    }
    let ratio = over_size(&|m| m.peaks[0] / m.exact.contact.peak_pressure);
    study.measured("peak.ratio.limit", limit(&ratio));
    all
}

/// Forces on the meshes of about 3 000 and 13 000 unknowns beside those of the finest.
fn economical(study: &mut Study, finest: &Measured) -> Result<(), Failure> {
    for (name, size, half_width) in ECONOMICAL {
        let width = format!("fine_half_width = {half_width}");
        let passages = [["fine_half_width = 1.6", width.as_str()]];
        let run = ran(study, name, size, &passages)?;
        let off = measured(&run, size).force_error(finest);
        study.measured(format!("force.error.{name}"), off);
    }
    Ok(())
}

/// Errors of the pressure over the element size as the closed form has it: under
/// small strains and in a larger block.
fn ideal(study: &mut Study) -> Result<Vec<[f64; 2]>, Failure> {
    let run = ran(study, &format!("shallow-h-{PARTED}"), PARTED, &SHALLOW)?;
    let error = pressure_error(&run, SHALLOW_RADIUS, INNER);
    study.measured("shallow.inner.error", error);
    let mut passages = SHALLOW.to_vec();
    passages.push(WIDE);
    let (mut errors, mut means) = (Vec::new(), Vec::new());
    for size in IDEAL_SIZES {
        let run = ran(study, &format!("ideal-h-{size}"), size, &passages)?;
        errors.push([size, pressure_error(&run, SHALLOW_RADIUS, f64::INFINITY)]);
        means.push([size, error_of_means(&run, SHALLOW_RADIUS)]);
        if size == PARTED {
            let error = pressure_error(&run, SHALLOW_RADIUS, INNER);
            study.measured("ideal.inner.error", error);
        }
    }
    for (name, errors) in [("pressure", &means), ("field", &errors)] {
        study.measured(format!("ideal.{name}.error"), errors[errors.len() - 1][1]);
        study.measured(format!("ideal.{name}.rate"), rate(errors));
    }
    Ok(errors)
}

/// Errors of the means around nodes of ten-node tetrahedra over half the element size, where
/// the closed form holds.
fn tetrahedra(study: &mut Study) -> Result<Vec<[f64; 2]>, Failure> {
    let mut passages = SHALLOW.to_vec();
    passages.extend([WIDE, TETRAHEDRA]);
    let mut means = Vec::new();
    for size in TETRAHEDRAL_SIZES {
        let run = ran(study, &format!("tetrahedra-h-{size}"), size, &passages)?;
        means.push([0.5 * size, error_of_means(&run, SHALLOW_RADIUS)]);
    }
    study.measured("tetrahedra.pressure.error", means[means.len() - 1][1]);
    study.measured("tetrahedra.pressure.rate", rate(&means));
    Ok(means)
}

/// Runs the deck with an element size and passages replaced.
fn ran(study: &mut Study, name: &str, size: f64, passages: &[[&str; 2]]) -> Result<Run, Failure> {
    let [(of, text)] = DECKS;
    let wanted = format!("element_size = {size}");
    let mut passages = passages.to_vec();
    passages.push(["element_size = 0.8", &wanted]);
    let deck = study.variant(of, text, &passages)?;
    study.run(name, deck)
}

/// Relative difference of the pressure from Hertz's at the end of a run, up to a
/// distance from the middle over the radius of the contact zone.
fn pressure_error(run: &Run, radius: f64, within: f64) -> f64 {
    let mut samples = samples(run, Side::A);
    let middle = centre(&samples).x;
    let history = history(run);
    let [_, normal, _] = history[history.len() - 1];
    let exact = PointContact::new(normal, radius, modulus());
    let distance = |sample: &Sample| (sample.place.x - middle).hypot(sample.place.y);
    samples.retain(|sample| distance(sample) < within * exact.radius);
    let along = |value: f64| Vec3::new(value, 0.0, 0.0);
    difference(
        &samples,
        |s| along(s.pressure),
        |s| along(exact.pressure(distance(s))),
    )
}

/// Error of the means around nodes, compared with those of Hertz's pressure.
fn error_of_means(run: &Run, radius: f64) -> f64 {
    let middle = centre(&samples(run, Side::A)).x;
    let history = history(run);
    let [_, normal, _] = history[history.len() - 1];
    let exact = PointContact::new(normal, radius, modulus());
    difference_of_means(run, Side::A, |place| {
        exact.pressure((place.x - middle).hypot(place.y))
    })
}

impl Measured {
    /// Relative difference of the normal force at the end.
    fn force_error(&self, finest: &Self) -> f64 {
        let force = |m: &Self| m.history.last().map_or(f64::NAN, |row| row[1]);
        (force(self) / force(finest) - 1.0).abs()
    }
}

fn measured(run: &Run, size: f64) -> Measured {
    let samples = samples(run, Side::A);
    let middle = centre(&samples).x;
    let history = history(run);
    let exact = closed_form(history[history.len() - 1]);
    let distance = |sample: &Sample| (sample.place.x - middle).hypot(sample.place.y);
    let along = |value: f64| Vec3::new(value, 0.0, 0.0);
    let mut nodes = nodal_samples(run, Side::A);
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
    let contact = PointContact::new(normal, RADIUS, modulus());
    PartialSlip::new(contact, MU, tangential)
}

fn modulus() -> f64 {
    let poissons_ratio = 0.5 * LAMBDA / (LAMBDA + SHEAR_MODULUS);
    let youngs_modulus = 2.0 * SHEAR_MODULUS * (1.0 + poissons_ratio);
    contact_modulus(&[[youngs_modulus, poissons_ratio]])
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
        let friction = Axis::linear("friction", "MPa").within(-1.0, 4.0);
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
