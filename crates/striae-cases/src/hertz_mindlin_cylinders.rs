//! `hertz-mindlin-cylinders`: two half cylinders in plane strain, pressed and sheared.
//!
//! Half widths of the contact and stick zones are those of ellipses fitted to the pressure, and to
//! what the friction falls short of `mu p` in the stick zone; the largest friction is `mu` times
//! the fitted pressure at its edge. Errors are separated into those around the edges of both zones
//! and the rest.

use striae_contact::{side::Side, unknowns::Status};
use striae_figure::{Axis, Color, Content, Figure, Marker, Panel, Series, Width};
use striae_mesh::Vec3;
use striae_verify::closed_forms::{LineContact, LinePartialSlip, contact_modulus};

use super::{
    comparison::{
        Sample, centre, convergence, difference, fitted_ellipse, nodal_samples, rate, samples,
    },
    study::{Extent, Run, Study},
};
use crate::failure::Failure;

const DECKS: [(&str, &str); 1] = decks!("hertz-mindlin-cylinders": "deck");
/// Element sizes of the lower half, the first two for a quick look; those of the
/// upper half are smaller by a fifth.
const SIZES: [f64; 3] = [0.1, 0.05, 0.025];
/// The mesh of the deck, which is judged.
const GIVEN: usize = 1;
const MU: f64 = 0.2;
const RADIUS: f64 = 8.0;
const ELASTIC: [f64; 2] = [200.0, 0.3];
/// Loads: pressure and shear over the diameter.
const LOADS: [f64; 2] = [0.625, 0.05851];

/// Distance up to which errors are counted as those of an edge: an element of the
/// coarsest mesh; the contact zone is 1.4 wide.
const NEAR: f64 = 0.1;

/// Results on one mesh.
struct Measured {
    size: f64,
    /// Place, pressure and friction of the nodes.
    trace: Vec<[f64; 3]>,
    half_width: f64,
    stick_half_width: f64,
    peak_pressure: f64,
    peak_friction: f64,
    /// Relative errors of pressure and friction.
    errors: [f64; 2],
    /// Relative errors away from the edges of the contact zone and, for friction, of the stick
    /// zone.
    away: [f64; 2],
}

/// Runs the case.
pub fn run(study: &mut Study) -> Result<(), Failure> {
    let exact = closed_form();
    let sizes = match study.extent {
        Extent::Full => &SIZES[..],
        Extent::Quick => &SIZES[..=GIVEN],
    };
    let mut family = Vec::new();
    for &size in sizes {
        let run = ran(study, size)?;
        if size == SIZES[GIVEN] {
            let force = -run.at_end_of(2, "pair.contact.resultant_b.z") / THICKNESS;
            study.measured("force", force);
            let mismatch = run.largest("pair.contact.mismatch");
            study.measured("mismatch", mismatch);
        }
        family.push(measured(&run, size, &exact));
    }
    let given = &family[GIVEN];
    study.measured("a", given.half_width);
    study.measured("c", given.stick_half_width);
    study.measured("p0", given.peak_pressure);
    study.measured("friction.peak", given.peak_friction);
    study.measured("pressure.away", given.away[0]);
    study.measured("friction.away", given.away[1]);
    let over_size =
        |of: usize| -> Vec<[f64; 2]> { family.iter().map(|m| [m.size, m.errors[of]]).collect() };
    study.measured("pressure.rate", rate(&over_size(0)));
    study.measured("friction.rate", rate(&over_size(1)));
    if study.extent == Extent::Quick {
        study.left_out.extend(["pressure.rate", "friction.rate"]);
    }
    study.draw(&traces(&family, &exact), "traces")?;
    let errors = ["pressure", "friction"]
        .into_iter()
        .enumerate()
        .map(|(of, name)| (name.to_owned(), over_size(of)))
        .collect::<Vec<_>>();
    study.draw(&convergence("", &errors), "convergence")
}

const THICKNESS: f64 = 0.1;

fn closed_form() -> LinePartialSlip {
    let [pressing, shearing] = LOADS.map(|load| 2.0 * RADIUS * load);
    let modulus = contact_modulus(&[ELASTIC; 2]);
    LinePartialSlip::new(
        LineContact::new(pressing, 0.5 * RADIUS, modulus),
        MU,
        shearing,
    )
}

fn ran(study: &mut Study, size: f64) -> Result<Run, Failure> {
    let [(name, text)] = DECKS;
    let size_of = |size: f64| format!("element_size = {size}");
    let scale = size / SIZES[GIVEN];
    let [lower, upper] = [size_of(0.05 * scale), size_of(0.04 * scale)];
    let passages = [
        ["element_size = 0.05", &lower],
        ["element_size = 0.04", &upper],
    ];
    let deck = study.variant(name, text, &passages)?;
    study.run(&format!("h-{size}"), deck)
}

fn measured(run: &Run, size: f64, exact: &LinePartialSlip) -> Measured {
    let samples = samples(run, Side::A);
    let middle = centre(&samples).x;
    let mut nodes = nodal_samples(run, Side::A);
    nodes.retain(|node| node.place.y == 0.0);
    nodes.sort_by(|a, b| a.place.x.total_cmp(&b.place.x));
    let at = |s: &Sample| [s.place.x - middle, s.pressure, -s.tau.x];
    let trace: Vec<[f64; 3]> = nodes.iter().map(at).collect();
    let pressures: Vec<[f64; 2]> = trace.iter().map(|[x, p, _]| [*x, *p]).collect();
    let contact = fitted_ellipse(&pressures);
    let sticking = nodes.iter().filter(|node| node.status == Status::Stick);
    let reserves: Vec<[f64; 2]> = sticking.map(at).map(|[x, p, q]| [x, MU * p - q]).collect();
    let stick_half_width = fitted_ellipse(&reserves).half_width;
    let place = |sample: &Sample| sample.place.x - middle;
    let errors = |near: f64| {
        let off = |sample: &Sample, edge: f64| (place(sample).abs() - edge).abs() > near;
        let pressure = |s: &Sample| Vec3::new(exact.contact.pressure(place(s)), 0.0, 0.0);
        let friction = |s: &Sample| Vec3::new(-exact.traction(place(s)), 0.0, 0.0);
        let (edge, kink) = (exact.contact.half_width, exact.stick_half_width);
        [
            difference(
                &samples,
                |s| {
                    let computed = Vec3::new(s.pressure, 0.0, 0.0);
                    if off(s, edge) { computed } else { pressure(s) }
                },
                pressure,
            ),
            difference(
                &samples,
                |s| {
                    let away = off(s, edge) && off(s, kink);
                    if away { s.tau } else { friction(s) }
                },
                friction,
            ),
        ]
    };
    Measured {
        size,
        half_width: contact.half_width,
        stick_half_width,
        peak_pressure: contact.peak,
        peak_friction: MU * contact.at(stick_half_width),
        errors: errors(0.0),
        away: errors(NEAR),
        trace,
    }
}

fn traces(family: &[Measured], exact: &LinePartialSlip) -> Figure {
    let curve = |value: &dyn Fn(f64) -> f64| {
        let places = (-200..=200).map(|i| 0.8 * f64::from(i) / 200.0);
        Content::line(places.map(|x| [x, value(x)]).collect())
    };
    let nodes = |measured: &Measured, of: usize, marker: Marker| {
        let points = measured.trace.iter().map(|point| [point[0], point[of]]);
        Content::markers(points.collect(), marker)
    };
    let panel = |label: &str, of: usize, top: f64, exact: Content| {
        let x = Axis::linear("x", "").within(-0.8, 0.8);
        let mut panel = Panel::new(x, Axis::linear(label, "").within(0.0, top))
            .with(Series::new("closed form", exact).colored(Color::Black));
        let markers = [Marker::Triangle, Marker::Circle];
        for (measured, marker) in family.iter().zip(markers) {
            let name = format!("h = {}", measured.size);
            panel = panel.with(Series::new(name, nodes(measured, of, marker)));
        }
        panel
    };
    let panels = vec![
        panel("pressure", 1, 10.0, curve(&|x| exact.contact.pressure(x))),
        panel("friction", 2, 1.5, curve(&|x| exact.traction(x))),
    ];
    Figure::new(Width::Page, panels)
}
