//! `slip-surface`: the slip surface of two textured surfaces, by the slip rule and as published.

use striae_deck as deck;
use striae_figure::{Axis, Figure, Panel, Series, Width};
use striae_law::friction::{Law, Published, SlipSample, TwoTextures};

use striae::figures::law::{
    Curve, SAMPLES, deviation_panel, over_slip, slip_axis, slip_surface_panel,
};

use super::{failure::Failure, study::Study};

const FRICTION: &str = embedded!("slip-surface", "/friction.toml");

/// Angles between the textures that are measured, and those that are drawn, in degrees.
const MEASURED: [f64; 5] = [0.0, 45.0, 90.0, 135.0, 180.0];
const DRAWN: [f64; 3] = [0.0, 90.0, 180.0];

/// Runs the case.
pub fn run(study: &mut Study) -> Result<(), Failure> {
    let friction = deck::friction(FRICTION, "cases/slip-surface/friction.toml");
    let friction = friction.map_err(striae::Error::from)?;
    let Law::TwoTextures(law) = friction.law() else {
        unreachable!("the friction of this case is that of two textured surfaces");
    };
    for theta in MEASURED {
        let surface = law.slip_surface(theta.to_radians());
        let extremes = surface.extremes();
        for (name, value) in [
            ("A", surface.across),
            ("P", surface.along),
            ("h", surface.offset),
            ("largest", extremes.traction),
            ("angle", extremes.deviation.to_degrees()),
        ] {
            study.measured(format!("theta-{theta}.{name}"), value);
        }
    }
    measure_erratum(study, law);
    study.make_folder()?;
    study.draw(&surfaces(law), "slip-surface")?;
    study.draw(&angles(law), "angle")
}

/// Sizes of the traction along and against `a_ba` of aligned textures, and how far
/// the two apart for opposed ones.
fn measure_erratum(study: &mut Study, law: &TwoTextures) {
    let size = |sample: SlipSample| sample.traction.norm();
    let (exact, published) = (law.slip_surface(0.0), Published::new(law, 0.0));
    for (name, angle) in [("along", 0.0), ("against", std::f64::consts::PI)] {
        study.measured(format!("exact.{name}"), size(exact.at(angle)));
        study.measured(format!("published.{name}"), size(published.at(angle)));
    }
    let opposed = ratios(law, 180.0).map(|(_, ratio)| (ratio - 1.0).abs());
    study.measured("disagreement-180", opposed.fold(0.0, f64::max));
    study.measured("least-dissipation", law.least_dissipation().value);
}

/// The slip surfaces of figure 5, by the slip rule and as published.
fn surfaces(law: &TwoTextures) -> Figure {
    let (exact, published) = (exact(law), published(law));
    let all = exact.iter().chain(&published);
    let sizes = all.flat_map(|curve| curve.samples.iter().map(|sample| sample.traction.norm()));
    let largest = sizes.fold(0.0, f64::max);
    let panels = vec![
        slip_surface_panel(&exact, largest).titled("slip rule (36), exact"),
        slip_surface_panel(&published, largest).titled("slip function (37), published"),
    ];
    Figure::new(Width::Page, panels)
}

/// The angle of figure 6, and how far the published sizes are off.
fn angles(law: &TwoTextures) -> Figure {
    let y = Axis::linear("|τ| by (37) over |τ| by (36)", "").within(0.7, 1.05);
    let series = DRAWN.map(|theta| {
        let samples: Vec<SlipSample> = ratios(law, theta).map(|(sample, _)| sample).collect();
        let published = Published::new(law, theta.to_radians());
        let ratio = move |sample: &SlipSample| published.gauge(&sample.traction).recip();
        Series::new(name(theta), over_slip(&samples, ratio))
    });
    let off = series
        .into_iter()
        .fold(Panel::new(slip_axis(), y), Panel::with);
    let panels = vec![
        deviation_panel(&exact(law)).titled("direction of friction, both"),
        off.titled("size of friction"),
    ];
    Figure::new(Width::Page, panels)
}

/// Samples of the slip rule, with the size of the published traction over theirs.
fn ratios(law: &TwoTextures, theta: f64) -> impl Iterator<Item = (SlipSample, f64)> {
    let theta = theta.to_radians();
    let published = Published::new(law, theta);
    let samples = law.slip_surface(theta).sampled(SAMPLES);
    let sizes = published
        .sampled(SAMPLES)
        .into_iter()
        .map(|sample| sample.traction.norm());
    let ratio = |(sample, size): (SlipSample, f64)| (sample, size / sample.traction.norm());
    samples.into_iter().zip(sizes).map(ratio)
}

fn exact(law: &TwoTextures) -> Vec<Curve> {
    let samples = |theta: f64| law.slip_surface(theta.to_radians()).sampled(SAMPLES);
    curves(samples)
}

fn published(law: &TwoTextures) -> Vec<Curve> {
    curves(|theta| Published::new(law, theta.to_radians()).sampled(SAMPLES))
}

fn curves(samples: impl Fn(f64) -> Vec<SlipSample>) -> Vec<Curve> {
    let curve = |theta| Curve {
        name: name(theta),
        samples: samples(theta),
    };
    DRAWN.map(curve).into()
}

fn name(theta: f64) -> String {
    format!("θ = {theta}°")
}
