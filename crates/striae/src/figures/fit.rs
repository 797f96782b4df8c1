//! Measured friction and the law that was fitted to it.
//!
//! Friction against slip over the direction of slip, friction across slip where it was
//! measured, and both as a polar curve: the size of friction over the direction of slip.
//! Measurements are marks, the law is a line; of two textured surfaces there is one for each
//! angle between the textures.

use nalgebra::Vector2;
use striae_figure::{Axis, Content, Figure, Marker, Panel, Series, Width};
use striae_law::{
    fit::{Fit, Reading},
    friction::{RequiredTextures, SlipSample},
};

use super::law::{SAMPLES, degrees, over_slip, slip_axis};

/// Marks, by the angle between the textures.
const MARKERS: [Marker; 5] = [
    Marker::Circle,
    Marker::Square,
    Marker::Triangle,
    Marker::Diamond,
    Marker::Cross,
];

/// Measurements and law.
pub fn figure(fit: &Fit, readings: &[Reading]) -> Figure {
    let groups = groups(fit, readings);
    let is_directed = readings.iter().any(|reading| reading.across.is_some());
    let against = Axis::linear("−τ · d / p", "");
    let mut panels = vec![
        panel(
            slip_axis(),
            against,
            &groups,
            &|one| Some(one.against),
            &SlipSample::dissipation,
        )
        .titled("friction against slip"),
    ];
    if is_directed {
        let across = Axis::linear("−τ · d⊥ / p", "");
        let of_law = |sample: &SlipSample| sample.slip.perp(&sample.traction);
        let panel = panel(slip_axis(), across, &groups, &|one| one.across, &of_law);
        panels.push(panel.titled("friction across slip"));
    }
    panels.push(polar(&groups));
    Figure::new(Width::Page, panels)
}

/// Readings at one angle between the textures, and the law there.
struct Group {
    name: String,
    readings: Vec<Reading>,
    law: Vec<SlipSample>,
}

fn groups(fit: &Fit, readings: &[Reading]) -> Vec<Group> {
    let two = fit.friction.required_textures() == RequiredTextures::Both;
    let mut angles: Vec<f64> = match two {
        true => readings.iter().map(|reading| reading.theta).collect(),
        false => vec![0.0],
    };
    angles.sort_by(f64::total_cmp);
    angles.dedup();
    let mu = fit.friction.coefficient().at_rest();
    let group = |theta: f64| {
        let mut law = fit.friction.slip_surface(theta).sampled(SAMPLES);
        for sample in &mut law {
            sample.traction *= mu;
        }
        let at = readings
            .iter()
            .filter(|reading| !two || reading.theta == theta);
        let name = match two {
            true => format!("θ = {}°", degrees(theta)),
            false => fit.friction.law().name().to_owned(),
        };
        Group {
            name,
            readings: at.copied().collect(),
            law,
        }
    };
    angles.into_iter().map(group).collect()
}

/// Marks and lines of a quantity over the direction of slip.
fn panel(
    x: Axis,
    y: Axis,
    groups: &[Group],
    measured: &dyn Fn(&Reading) -> Option<f64>,
    of_law: &dyn Fn(&SlipSample) -> f64,
) -> Panel {
    let mut panel = Panel::new(x, y);
    for (number, group) in groups.iter().enumerate() {
        let points = group.readings.iter().filter_map(|reading| {
            let turned = (degrees(reading.slip) + 180.0).rem_euclid(360.0) - 180.0;
            Some([turned, measured(reading)?])
        });
        let marks = Content::markers(points.collect(), MARKERS[number % MARKERS.len()]);
        let line = over_slip(&group.law, of_law);
        panel = panel.with(Series::new(measured_name(group, groups), marks));
        panel = panel.with(Series::new(&group.name, line));
    }
    panel
}

/// The size of friction, of what was measured of it, over the direction of slip.
fn polar(groups: &[Group]) -> Panel {
    let size = |reading: &Reading| match reading.across {
        Some(across) => Vector2::new(reading.against, across).norm(),
        None => reading.against,
    };
    let is_directed = |group: &Group| group.readings.iter().any(|one| one.across.is_some());
    let sizes = groups
        .iter()
        .flat_map(|group| group.readings.iter().map(size));
    let law = groups.iter().flat_map(|group| &group.law);
    let largest = law
        .map(|sample| sample.traction.norm())
        .chain(sizes)
        .fold(0.0, f64::max);
    let radius = Axis::linear("friction / p over the direction of slip", "");
    let mut panel = Panel::polar(radius.within(0.0, 1.05 * largest));
    for (number, group) in groups.iter().enumerate() {
        let points = group
            .readings
            .iter()
            .map(|one| [one.slip, size(one).max(0.0)]);
        let marks = Content::markers(points.collect(), MARKERS[number % MARKERS.len()]);
        let closed = group.law.iter().chain(group.law.first());
        let line = closed.map(|sample| {
            let of_law = match is_directed(group) {
                true => sample.traction.norm(),
                false => sample.dissipation(),
            };
            [sample.slip.y.atan2(sample.slip.x), of_law]
        });
        panel = panel.with(Series::new(measured_name(group, groups), marks));
        panel = panel.with(Series::new(&group.name, Content::line(line.collect())));
    }
    panel.titled("rosette")
}

fn measured_name(group: &Group, groups: &[Group]) -> String {
    match groups.len() {
        1 => "measured".to_owned(),
        _ => format!("measured, {}", group.name),
    }
}
