//! Printed reference numbers.

use super::assert_reads;
use crate::friction::{Ellipse, Friction, SlipRule, Textures, TwoTextures};
use nalgebra::{Rotation2, Vector3};

/// `theta` in degrees, then `A`, `P`, `h`, the largest `|w|` and the largest angle
/// between slip and `-tau` in degrees, each with its number of decimals.
type Row = (f64, [(f64, i32); 5]);

const TABLE: [Row; 5] = [
    (0.0, [(1.1, 4), (1.9, 4), (0.2, 4), (2.10, 2), (20.4, 1)]),
    (
        45.0,
        [(1.0707, 4), (1.6536, 4), (0.1577, 4), (1.811, 3), (16.7, 1)],
    ),
    (
        90.0,
        [(1.0, 4), (1.2, 4), (0.0707, 4), (1.271, 3), (7.8, 1)],
    ),
    (
        135.0,
        [(0.9293, 4), (0.9464, 4), (0.0112, 4), (0.958, 3), (1.05, 2)],
    ),
    (180.0, [(0.9, 4), (0.9, 4), (0.0, 4), (0.9, 3), (0.0, 1)]),
];

fn surface(theta_in_degrees: f64) -> Ellipse {
    let law = TwoTextures::new(0.1, 0.1, 0.5).unwrap();
    law.slip_surface(theta_in_degrees.to_radians())
}

#[test]
fn slip_surface_has_the_reference_axes_and_extremes() {
    for (theta, row) in TABLE {
        let surface = surface(theta);
        let extremes = surface.extremes();
        let values = [
            surface.across,
            surface.along,
            surface.offset,
            extremes.traction,
            extremes.deviation.to_degrees(),
        ];
        for (value, (printed, decimals)) in values.into_iter().zip(row) {
            assert_reads(value, printed, decimals);
        }
    }
}

#[test]
fn fixed_lateral_motion_feels_the_reference_lateral_force() {
    // Textures 45 degrees apart, their bisector 22.5 degrees off the travel along x.
    let bisector = Rotation2::new(22.5f64.to_radians());
    let w = bisector * surface(45.0).at(-22.5f64.to_radians()).traction;
    assert_reads(w.y / w.x, 0.155, 3);
}

#[test]
fn free_lateral_motion_drifts_at_the_reference_angle() {
    let tilt = 22.5f64.to_radians();
    let lateral = |drift: f64| (Rotation2::new(tilt) * surface(45.0).at(drift - tilt).traction).y;
    let (mut low, mut high) = (-1.0, 0.0);
    assert!(lateral(low) < 0.0 && lateral(high) > 0.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        *(if lateral(middle) < 0.0 {
            &mut low
        } else {
            &mut high
        }) = middle;
    }
    assert_reads(-low.to_degrees(), 13.05, 2);
}

#[test]
fn point_mass_stops_where_and_when_the_closed_form_says() {
    // A = .5, P = 1, h = 0, mu g = v0 = 1, launched at 60 degrees to the texture.
    let friction = Friction::orthotropic(0.5, 1.0, SlipRule::Opposing).unwrap();
    let textures = Textures {
        own: Some(Vector3::x()),
        opposite: None,
    };
    let kernel = friction.kernel(&Vector3::z(), &textures);
    let acceleration = |v: &Vector3<f64>| kernel.traction(1.0, &v.normalize());
    let launch = 60f64.to_radians();
    let mut v = Vector3::new(launch.cos(), launch.sin(), 0.0);
    let (mut x, mut t, h) = (Vector3::zeros(), 0.0, 2e-4);
    while v.norm() > 2e-3 {
        let k1 = acceleration(&v);
        let k2 = acceleration(&(v + k1 * (0.5 * h)));
        let k3 = acceleration(&(v + k2 * (0.5 * h)));
        let k4 = acceleration(&(v + k3 * h));
        x += v * h + (k1 + k2 + k3) * (h * h / 6.0);
        v += (k1 + k2 * 2.0 + k3 * 2.0 + k4) * (h / 6.0);
        t += h;
    }
    let rest = v.norm() / acceleration(&v).norm();
    x += v * (0.5 * rest);
    assert_reads(t + rest, 1.823959, 6);
    assert!((1.0 + 0.75 * 3f64.ln() - t - rest).abs() < 1e-7);
    assert_reads(x.x, 0.316015, 6);
    assert_reads(x.y, 0.809401, 6);
}
