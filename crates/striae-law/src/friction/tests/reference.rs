//! Printed reference numbers.

use super::assert_reads;
use crate::friction::{SlipSurface, TwoTextures};
use nalgebra::Rotation2;

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

fn surface(theta_in_degrees: f64) -> SlipSurface {
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
