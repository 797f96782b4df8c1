//! `striae law --json`.

use serde_json::{Value, json};
use striae_law::friction::{Friction, Law, SlipSurface};

use super::analysed;

/// Numbers of a friction; angles in degrees.
pub fn of_friction(title: &str, friction: &Friction, theta: &[f64]) -> Value {
    if matches!(friction.law(), Law::Frictionless) {
        return json!({ "title": title, "law": friction.law().name() });
    }
    let surfaces = analysed(friction, theta).into_iter().map(|analysis| {
        let axes = match &analysis.surface {
            SlipSurface::Ellipse(ellipse) => {
                json!({ "A": ellipse.across, "P": ellipse.along, "h": ellipse.offset })
            }
            SlipSurface::Star(_) | SlipSurface::Oblique(_) => Value::Null,
        };
        json!({
            "theta": analysis.theta.to_degrees(),
            "axes": axes,
            "largest": analysis.extremes.traction,
            "largest_angle_to_slip": analysis.extremes.deviation.to_degrees(),
            "least_dissipation": analysis.least.dissipation(),
        })
    });
    let coefficient = friction.coefficient();
    let by_pressure = coefficient.by_pressure();
    let by_pressure = by_pressure.is_some().then(|| by_pressure.to_string());
    let by_slip = coefficient.by_slip();
    let by_slip = by_slip.is_some().then(|| by_slip.to_string());
    let by_state = coefficient.by_state();
    let by_state = by_state.is_some().then(|| by_state.to_string());
    let by_rate = coefficient.by_rate();
    let by_rate = by_rate.is_some().then(|| by_rate.to_string());
    json!({
        "title": title,
        "law": friction.law().name(),
        "mu": friction.coefficient().at_rest(),
        "by_pressure": by_pressure,
        "by_slip_rate": by_rate,
        "by_accumulated_slip": by_slip,
        "by_state": by_state,
        "shear_cap": friction.shear_cap(),
        "slip_surfaces": surfaces.collect::<Vec<_>>(),
    })
}
