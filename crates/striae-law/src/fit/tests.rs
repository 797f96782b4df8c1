//! Fits of readings whose law is known.

mod specimens;

use std::f64::consts::PI;

use nalgebra::{DVector, Vector2};
use striae_verify::Random;

use super::basis::Shape;
use super::{ConstantName, Fit, FitError, Reading, Sought, Standing, fit};
use crate::friction::{Direction, Friction, SlipRule, SlipSurface};

fn sought(name: &str) -> Sought {
    Sought::named(name).unwrap()
}

/// Laws that are sought, and one of each.
fn laws() -> Vec<(Sought, Friction, Vec<f64>)> {
    let [opposing, associated] = [SlipRule::Opposing, SlipRule::Associated];
    let two = [0.5, 0.2, 0.15, 0.8];
    let mu = [0.31, 0.22, 0.14, 0.12, 0.18, 0.3];
    let angles: Vec<f64> = (0..6).map(|i| f64::from(i) * PI / 3.0).collect();
    vec![
        (sought("coulomb"), Friction::coulomb(0.3), vec![0.3]),
        (
            sought("orthotropic"),
            Friction::orthotropic(0.2, 0.35, opposing),
            vec![0.2, 0.35],
        ),
        (
            sought("orthotropic").with("slip_rule", "associated"),
            Friction::orthotropic(0.2, 0.35, associated),
            vec![0.2, 0.35],
        ),
        (
            sought("nap"),
            Friction::nap(0.11, 0.14, 0.2),
            vec![0.11, 0.14, 0.2],
        ),
        (
            sought("two-textures"),
            Friction::two_textures(two[0], two[1], two[2], two[3]),
            two.to_vec(),
        ),
        (
            sought("tabulated"),
            Friction::tabulated(&angles, &mu),
            mu.to_vec(),
        ),
    ]
    .into_iter()
    .map(|(sought, friction, constants)| (sought, friction.unwrap(), constants))
    .collect()
}

/// `-tau/p` of slip in a direction.
fn friction_at(friction: &Friction, theta: f64, slip: f64) -> Vector2<f64> {
    let surface = friction.slip_surface(theta);
    let angle = match surface {
        // The associated rule has d ~ (cos/P, sin/A).
        SlipSurface::Ellipse(ellipse) if ellipse.rule == SlipRule::Associated => {
            (ellipse.across * slip.sin()).atan2(ellipse.along * slip.cos())
        }
        _ => slip,
    };
    surface.at(angle).traction * friction.coefficient().at_rest()
}

/// A rosette: slip all around in steps of 15 degrees, twice; of tables in steps of 60 degrees,
/// eight times. Textures of two surfaces at four angles.
fn rosette(sought: &Sought) -> Vec<[f64; 2]> {
    let (count, step) = match sought.law().name {
        "tabulated" => (48, PI / 3.0),
        _ => (48, PI / 12.0),
    };
    let texture = |i: u32| f64::from(i % 4) * PI / 5.0;
    (0..count)
        .map(|i| [texture(i + i / 24), f64::from(i) * step])
        .collect()
}

/// The rosette of a law, with noise by `noise(reading, friction)` and, if wanted, friction
/// across slip.
fn measured(
    sought: &Sought,
    friction: &Friction,
    directed: Option<()>,
    mut noise: impl FnMut(f64) -> (f64, f64),
) -> Vec<Reading> {
    let reading = |[theta, slip]: [f64; 2]| {
        let w = friction_at(friction, theta, slip);
        let d = Vector2::new(slip.cos(), slip.sin());
        let (error, spread) = noise(w.dot(&d));
        let across = directed.map(|()| d.perp(&w) + noise(w.dot(&d)).0);
        Reading {
            slip,
            against: w.dot(&d) + error,
            across,
            theta,
            spread,
            specimen: 0,
        }
    };
    rosette(sought).into_iter().map(reading).collect()
}

/// Coverage of the constants by their intervals, one by one and all together.
fn covered(found: &Fit, constants: &[f64]) -> (Vec<bool>, bool) {
    let inside = |(constant, value): (&super::Constant, &f64)| {
        let [low, high] = constant.interval.unwrap();
        low <= *value && *value <= high
    };
    let each: Vec<bool> = found.constants.iter().zip(constants).map(inside).collect();
    let all = each.iter().all(|inside| *inside);
    (each, all)
}

#[test]
fn the_sum_is_the_law() {
    let mut random = Random::new(5);
    for (sought, friction, constants) in laws() {
        let readings = measured(&sought, &friction, None, |_| (0.0, 1.0));
        let shape = Shape::new(&sought, &readings);
        let q = match sought.law().name {
            "two-textures" => {
                let [mu, mag, ang, cen] = constants[..] else {
                    unreachable!()
                };
                DVector::from_vec(vec![mu, mu * mag, mu * ang, mu * ang * cen])
            }
            _ => DVector::from_vec(constants),
        };
        for (number, reading) in readings.iter().enumerate() {
            let (theta, slip) = match sought.law().name {
                "tabulated" => (reading.theta, reading.slip),
                _ => (random.uniform(0.0, PI), random.uniform(0.0, 6.0)),
            };
            let basis = shape.basis(number, Direction::new(theta, slip), &q);
            let sum: Vector2<f64> = basis.iter().zip(&q).map(|(w, q)| w * *q).sum();
            let exact = friction_at(&friction, theta, slip);
            assert!((sum - exact).norm() < 1e-15, "{sought:?} {sum} {exact}");
        }
    }
}

#[test]
fn exact_readings_give_the_constants() {
    for (sought, friction, constants) in laws() {
        for directed in [None, Some(())] {
            let readings = measured(&sought, &friction, directed, |_| (0.0, 1.0));
            let found = fit(&sought, &readings, 0.95).unwrap();
            assert_eq!(found.standing, Standing::Free);
            for (constant, value) in found.constants.iter().zip(&constants) {
                let error = (constant.value - value).abs();
                assert!(error < 1e-13, "{sought:?} {directed:?} {constant:?}");
            }
            let knows = directed.is_some() && Shape::new(&sought, &readings).knows_across();
            let numbers = if knows { 96 } else { 48 };
            assert_eq!(found.degrees_of_freedom, numbers - constants.len());
        }
    }
}

/// Intervals hold what they promise: with noise of 5 % of the largest coefficient a 99 %
/// interval holds its constant in at least 95 of 100 rosettes (the chance of six misses or
/// more is 0.05 %), and so do all intervals together at the level of Bonferroni.
#[test]
fn constants_lie_in_their_intervals_in_95_of_100_rosettes() {
    for (sought, friction, constants) in laws() {
        let size = 0.05 * friction.coefficient().at_rest();
        let joint = 1.0 - 0.01 / constants.len() as f64;
        for directed in [None, Some(())] {
            let mut each = vec![0; constants.len()];
            let mut together = 0;
            for seed in 0..100 {
                let mut random = Random::new(seed);
                let noise = |_| (size * random.normal(), 1.0);
                let readings = measured(&sought, &friction, directed, noise);
                let found = fit(&sought, &readings, 0.99).unwrap();
                for (count, inside) in each.iter_mut().zip(covered(&found, &constants).0) {
                    *count += usize::from(inside);
                }
                let found = fit(&sought, &readings, joint).unwrap();
                together += usize::from(covered(&found, &constants).1);
            }
            assert!(each.iter().all(|count| *count >= 95), "{sought:?} {each:?}");
            assert!(together >= 95, "{sought:?} {together}");
        }
    }
}

/// Of 2000 rosettes 95 % intervals hold 1900 +- 4 sqrt(2000 .95 .05) = 1861 to 1939, with
/// noise in proportion to the friction that is measured, and the spread saying so.
#[test]
fn intervals_are_neither_too_wide_nor_too_narrow() {
    for (sought, friction, constants) in laws() {
        let mut each = vec![0; constants.len()];
        for seed in 0..2000 {
            let mut random = Random::new(1000 + seed);
            let noise = |w: f64| (0.05 * w * random.normal(), w);
            let readings = measured(&sought, &friction, None, noise);
            let found = fit(&sought, &readings, 0.95).unwrap();
            for (count, inside) in each.iter_mut().zip(covered(&found, &constants).0) {
                *count += usize::from(inside);
            }
        }
        let good = each.iter().all(|count| (1861..=1939).contains(count));
        assert!(good, "{sought:?} {each:?}");
    }
}

/// Readings that no law without energy of its own has: the fit is admissible, and no
/// admissible law nearby is closer.
#[test]
fn the_closest_admissible_law_is_found() {
    let readings: Vec<Reading> = (0..24)
        .map(|i| {
            let slip = f64::from(i) * PI / 12.0;
            let (s, c) = slip.sin_cos();
            // A nap of .05, .6 and .05, which creates energy.
            let w = Vector2::new(0.275 + 0.325 * c, 0.05 * s);
            Reading::directed(slip, w.norm(), w.y.atan2(w.x))
        })
        .collect();
    let nap = sought("nap");
    let found = fit(&nap, &readings, 0.95).unwrap();
    assert_eq!(found.standing, Standing::AtBound);
    assert!(found.constants.iter().all(|one| one.interval.is_none()));
    let q = DVector::from_iterator(3, found.constants.iter().map(|one| one.value));
    let shape = Shape::new(&nap, &readings);
    let square = |q: &DVector<f64>| {
        super::equations(&shape, &readings, q)
            .residuals(q)
            .norm_squared()
    };
    let least = square(&q);
    let mean = readings.iter().map(|one| one.against).sum::<f64>() / 24.0;
    let mut random = Random::new(8);
    let mut compared = 0;
    for _ in 0..10_000 {
        let other = DVector::from_fn(3, |k, _| q[k] + random.uniform(-0.02, 0.02));
        let bounds = super::bounds(&shape, &other) * &other;
        if bounds
            .iter()
            .all(|value| *value >= super::LEAST_DISSIPATION * mean)
        {
            compared += 1;
            assert!(square(&other) > least * (1.0 - 1e-9));
        }
    }
    assert!(compared > 500, "{compared}");
}

#[test]
fn tables_average_readings_at_one_angle() {
    let reading = |degrees: f64, mu| Reading::against(degrees.to_radians(), mu);
    let readings = [
        reading(-90.0, 0.3),
        reading(0.0, 0.2),
        reading(120.0, 0.5),
        reading(270.0, 0.4),
        reading(360.0, 0.2),
    ];
    let found = fit(&sought("tabulated"), &readings, 0.95).unwrap();
    let names: Vec<String> = found.constants.iter().map(|c| c.name.to_string()).collect();
    assert_eq!(
        names,
        ["mu at 0 degrees", "mu at 120 degrees", "mu at 270 degrees"]
    );
    let values: Vec<f64> = found.constants.iter().map(|one| one.value).collect();
    let expected = [0.2, 0.5, 0.35];
    assert!(
        values
            .iter()
            .zip(expected)
            .all(|(one, other)| (one - other).abs() < 1e-15)
    );
    assert_eq!(found.degrees_of_freedom, 2);
}

#[test]
fn what_measurements_leave_open_is_said() {
    let one = [Reading::against(0.0, 0.2), Reading::against(0.0, 0.3)];
    for name in ["orthotropic", "nap", "two-textures"] {
        let refused = fit(&sought(name), &one, 0.95).unwrap_err();
        assert!(
            matches!(refused, FitError::Undetermined { .. }),
            "{refused}"
        );
    }
    assert!(matches!(
        fit(&sought("coulomb"), &[], 0.95),
        Err(FitError::Undetermined { .. })
    ));
    // The sine of 180 degrees is round-off, not zero.
    let along = [(0.0, 0.3), (0.0, 0.2), (180.0, 0.25)];
    let across = [(90.0, 0.3), (270.0, 0.31), (-90.0, 0.29)];
    let not_backward = [(90.0, 0.3), (270.0, 0.31), (180.0, 0.2), (180.0, 0.22)];
    for (name, readings) in [
        ("orthotropic", &along[..]),
        ("orthotropic", &across),
        ("nap", &not_backward),
    ] {
        let readings = readings.iter();
        let readings: Vec<_> = readings
            .map(|&(angle, mu): &(f64, f64)| Reading::against(angle.to_radians(), mu))
            .collect();
        let refused = fit(&sought(name), &readings, 0.95).unwrap_err();
        assert!(
            matches!(refused, FitError::Undetermined { .. }),
            "{refused}"
        );
    }
    // All textures at one angle leave mu and c_mag open.
    let around = |i: u32| Reading::against(f64::from(i), 0.3 + 0.01 * f64::from(i % 3));
    let readings: Vec<Reading> = (0..12).map(around).collect();
    let refused = fit(&sought("two-textures"), &readings, 0.95).unwrap_err();
    assert!(
        refused.to_string().contains("two or more angles `theta`"),
        "{refused}"
    );
    let reversed = [Reading::against(0.0, -0.2)];
    let refused = fit(&sought("coulomb"), &reversed, 0.95).unwrap_err();
    assert_eq!(refused, FitError::NotOpposing { mean: -0.2 });
    let force = [Reading::against(0.0, 0.2), Reading::against(1.0, 1e308)];
    let refused = fit(&sought("coulomb"), &force, 0.95).unwrap_err();
    assert_eq!(
        refused.to_string(),
        "reading 1 has the friction 1e308, but it must lie between -1000 and 1000: divide the \
         tangential by the normal force"
    );
    let weightless = [Reading {
        spread: 1e300,
        ..Reading::against(0.0, 0.2)
    }];
    let refused = fit(&sought("coulomb"), &weightless, 0.95).unwrap_err();
    assert!(matches!(refused, FitError::Spread { reading: 0, .. }));
    let found = fit(&sought("coulomb"), &one[..1], 0.95).unwrap();
    assert_eq!(found.constants[0].name, ConstantName::Key("mu"));
    assert_eq!((found.deviation, found.constants[0].interval), (None, None));
    assert_eq!(
        fit(&sought("coulomb"), &one, 1.0).unwrap_err(),
        FitError::Level(1.0)
    );
}
