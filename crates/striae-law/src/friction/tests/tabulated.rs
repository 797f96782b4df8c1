//! Properties specific to tabulated friction.

use nalgebra::Vector3;
use num_dual::{Dual64, gradient};
use proptest::prelude::*;
use striae_verify::{Random, fitted_rate};

use super::slipping;
use crate::friction::{
    Friction, FrictionError, SlipRule, SlipSurface, Textures, periodic::Periodic,
};

/// Tabulated friction with its angles in degrees.
pub(super) fn tabulated(degrees: &[f64], mu: &[f64]) -> Result<Friction, FrictionError> {
    let angles: Vec<f64> = degrees.iter().map(|angle| angle.to_radians()).collect();
    Friction::tabulated(&angles, mu)
}

/// Tables as angles in degrees and coefficients.
pub(super) fn points() -> impl Strategy<Value = Vec<(f64, f64)>> {
    (
        -180.0..180.0f64,
        prop::collection::vec((5.0..60.0f64, 0.05..1.0f64), 3..14),
    )
        .prop_map(|(first, points)| {
            let mut angle = first;
            let around = points.into_iter().map(|(step, mu)| {
                angle += step;
                (angle - step, mu)
            });
            let all: Vec<(f64, f64)> = around.collect();
            all.into_iter()
                .filter(|(angle, _)| angle - first < 355.0)
                .collect()
        })
}

/// A unit vector at an angle from `x`, counter-clockwise from above.
fn unit(degrees: f64) -> Vector3<f64> {
    let (sine, cosine) = degrees.to_radians().sin_cos();
    Vector3::new(cosine, sine, 0.0)
}

/// `-tau/p` for slip along `d` of the upper one of two surfaces, which carries the
/// point: it faces down, and its texture points along `a`.
fn upper(friction: &Friction, a: &Vector3<f64>, d: &Vector3<f64>) -> Vector3<f64> {
    let textures = Textures {
        own: Some(*a),
        opposite: None,
    };
    let cap = friction.cap(1.0, 0.0);
    -slipping(&friction.kernel(&-Vector3::z(), &textures), cap, d)
}

/// Traction where the lower surface has the texture `a`.
fn lower(friction: &Friction, a: &Vector3<f64>, d: &Vector3<f64>) -> Vector3<f64> {
    let textures = Textures {
        own: None,
        opposite: Some(-*a),
    };
    let cap = friction.cap(1.0, 0.0);
    -slipping(&friction.kernel(&-Vector3::z(), &textures), cap, d)
}

const ANGLES: [f64; 5] = [0.0, 50.0, 90.0, 180.0, 270.0];
const MU: [f64; 5] = [0.6, 0.25, 0.2, 0.3, 0.4];

#[test]
fn angles_turn_about_the_outward_normal_of_the_textured_surface() {
    let friction = tabulated(&ANGLES, &MU).unwrap();
    for texture in [0.0, 33.0, 250.0] {
        let a = unit(texture);
        for (angle, mu) in ANGLES.into_iter().zip(MU) {
            // The upper surface is seen from outside from below, where turning looks reversed.
            let d = unit(texture - angle);
            assert!((upper(&friction, &a, &d) - d * mu).norm() < 1e-15);
            // The lower surface slips along `-d`, and is seen from above.
            let d = -unit(texture + angle);
            assert!((lower(&friction, &a, &d) - d * mu).norm() < 1e-15);
        }
    }
}

#[test]
fn angles_are_those_of_the_nap_and_of_its_grooves() {
    let nap = Friction::nap(0.1, 0.3, 0.15).unwrap();
    let table = tabulated(&[0.0, 90.0, 180.0, 270.0], &[0.3, 0.15, 0.1, 0.15]).unwrap();
    let a = unit(20.0);
    for side in [upper, lower] {
        for along in [a, -a] {
            let [one, other] = [&nap, &table].map(|friction| side(friction, &a, &along));
            assert!((one - other).norm() < 1e-15);
        }
    }
    // s = a x n with n down; 90 degrees is -s, 270 is s.
    let s = a.cross(&-Vector3::z());
    let sided = tabulated(&[0.0, 90.0, 180.0, 270.0], &[0.3, 0.1, 0.2, 0.4]).unwrap();
    assert!((upper(&sided, &a, &-s).norm() - 0.1).abs() < 1e-15);
    assert!((upper(&sided, &a, &s).norm() - 0.4).abs() < 1e-15);
}

#[test]
fn equal_coefficients_are_coulomb_friction() {
    let table = tabulated(&ANGLES, &[0.3; 5]).unwrap();
    let coulomb = Friction::coulomb(0.3).unwrap();
    let mut random = Random::new(3);
    for _ in 0..100 {
        let normal = random.unit3();
        let mut tangent = || normal.cross(&random.unit3());
        let textures = Textures {
            own: Some(tangent().normalize()),
            opposite: None,
        };
        let z = tangent();
        let tau = |friction: &Friction| friction.kernel(&normal, &textures).traction(0.7, &z);
        assert_eq!(tau(&table), tau(&coulomb));
        let reach = table.kernel(&normal, &textures).reach(&z);
        assert!((reach - 1.0).abs() < 1e-15);
        assert_eq!(table.cap(1.3, 0.0), coulomb.cap(1.3, 0.0));
    }
}

/// Friction against slip over the pressure, `-tau . d/p`.
fn against(friction: &Friction, d: &Vector3<f64>) -> f64 {
    upper(friction, &Vector3::x(), d).dot(d)
}

/// Largest difference of friction against slip from that of a table of it.
fn largest_difference(law: &Friction, count: usize) -> f64 {
    let step = 360.0 / count as f64;
    // Not where the law has its extremes.
    let angles: Vec<f64> = (0..count).map(|i| (i as f64 + 0.3) * step).collect();
    let mu: Vec<f64> = angles
        .iter()
        .map(|angle| against(law, &unit(-angle)))
        .collect();
    let table = tabulated(&angles, &mu).unwrap();
    let difference = |i: i32| {
        let d = unit(0.05 * f64::from(i));
        (against(&table, &d) - against(law, &d)).abs()
    };
    (0..7200).map(difference).fold(0.0, f64::max)
}

#[test]
fn fine_tables_of_other_laws_oppose_slip_as_those_do() {
    for law in [
        Friction::orthotropic(0.2, 0.7, SlipRule::Opposing).unwrap(),
        Friction::nap(0.1, 0.3, 0.12).unwrap(),
    ] {
        let counts = [24, 48, 96, 192];
        let errors = counts.map(|count| largest_difference(&law, count));
        let rate = fitted_rate(&counts.map(|count| 1.0 / count as f64), &errors);
        assert!(
            (1.8..2.5).contains(&rate) && errors[3] < 1e-4,
            "{rate}: {errors:?}"
        );
    }
}

/// `drho/dz` with the texture along `x`, seen from above.
fn derivative(friction: &Friction, z: &Vector3<f64>) -> Vector3<f64> {
    let (_, slope) = gradient(
        |z| {
            let textures = Textures {
                own: Some(Vector3::x().map(|x: f64| x.into())),
                opposite: None,
            };
            let normal = Vector3::z().map(|x: f64| x.into());
            friction.kernel(&normal, &textures).reach(&z)
        },
        z,
    );
    slope
}

#[test]
fn traction_below_the_slip_surface_is_linear_whatever_the_table() {
    let friction = tabulated(&ANGLES, &MU).unwrap();
    let textures = Textures {
        own: Some(Vector3::x()),
        opposite: None,
    };
    let kernel = friction.kernel(&Vector3::z(), &textures);
    for degrees in [0.0, 20.0, 70.0, 200.0] {
        let z = unit(degrees) * 0.01;
        assert_eq!(kernel.traction(0.5, &z), -z);
    }
    assert!(kernel.reach(&Vector3::zeros()) > 0.0);
    assert_eq!(derivative(&friction, &Vector3::zeros()), Vector3::zeros());
}

#[test]
fn derivatives_are_right_along_the_axes_and_of_any_size_of_z() {
    let friction = tabulated(&[10.0, 100.0, 190.0, 300.0], &[0.6, 0.2, 0.3, 0.4]).unwrap();
    let textures = Textures {
        own: Some(Vector3::x()),
        opposite: None,
    };
    let kernel = friction.kernel(&Vector3::z(), &textures);
    for degrees in [0.0, 33.0, 90.0, 180.0, 270.0] {
        // Exactly along the axes, where a component vanishes.
        let exact = |component: f64| {
            if component.abs() < 1e-15 {
                0.0
            } else {
                component
            }
        };
        let [r, t] = [unit(degrees), unit(degrees + 90.0)].map(|v| v.map(exact));
        let rho = |turn: f64| kernel.reach(&unit(degrees + turn.to_degrees()));
        let h = 1e-5;
        let turning = (rho(h) - rho(-h)) / (2.0 * h);
        for size in [1.0, 1e-9, 1e-120] {
            let slope = derivative(&friction, &(r * size)) * size;
            assert!(slope.dot(&r).abs() < 1e-14, "{degrees}, {size}");
            assert!((slope.dot(&t) - turning).abs() < 1e-9, "{degrees}, {size}");
        }
    }
}

#[test]
fn tables_that_are_no_curve_are_refused() {
    let said = |degrees: &[f64], mu: &[f64]| tabulated(degrees, mu).unwrap_err().to_string();
    for (degrees, mu, message) in [
        (
            vec![0.0, 90.0, 180.0],
            vec![0.1, 0.2],
            "the table has angles: 3, but coefficients: 2; each angle needs one",
        ),
        (
            vec![0.0, 180.0],
            vec![0.1, 0.2],
            "a table with angles: 2 is refused: it must have at least 3",
        ),
        (
            vec![0.0, 90.0, 180.0],
            vec![0.1, 0.0, 0.2],
            "mu = 0 at the angle 90.000 degrees is refused: it must be positive and finite, otherwise friction would create energy or vanish there",
        ),
        (
            vec![0.0, 90.0, 180.0],
            vec![0.1, f64::INFINITY, 0.2],
            "mu = inf at the angle 90.000 degrees is refused: it must be positive and finite, otherwise friction would create energy or vanish there",
        ),
        (
            vec![0.0, f64::NAN, 180.0],
            vec![0.1; 3],
            "angle = NaN is refused: it must be finite",
        ),
        (
            vec![0.0, 180.0, 90.0],
            vec![0.1; 3],
            "the angle 90.000 degrees after 180.000 degrees is refused: the angles of a table \
             must ascend",
        ),
        (
            vec![0.0, 90.0, 90.0],
            vec![0.1; 3],
            "the angle 90.000 degrees after 90.000 degrees is refused: the angles of a table \
             must ascend",
        ),
        (
            vec![-180.0, 0.0, 180.0],
            vec![0.1; 3],
            "angles from -180.000 to 180.000 degrees are refused: they must span less than a \
             turn, after which the table repeats",
        ),
        (
            vec![10.0, 90.0, 200.0, 380.0],
            vec![0.1; 4],
            "angles from 10.000 to 380.000 degrees are refused: they must span less than a \
             turn, after which the table repeats",
        ),
    ] {
        assert_eq!(said(&degrees, &mu), message);
    }
    assert!(tabulated(&[-180.0, 0.0, 179.0], &[0.1; 3]).is_ok());
}

proptest! {
    #[test]
    fn curves_pass_through_their_points_and_keep_between_them(points in points()) {
        let (angles, mu): (Vec<f64>, Vec<f64>) = points.iter().copied().unzip();
        let angles: Vec<f64> = angles.iter().map(|angle| angle.to_radians()).collect();
        let curve = Periodic::through(&angles, &mu);
        let turn = std::f64::consts::TAU;
        for i in 0..angles.len() {
            let last = i + 1 == angles.len();
            let (from, to) = (mu[i], mu[(i + 1) % mu.len()]);
            let end = if last { angles[0] + turn } else { angles[i + 1] };
            for turns in [-2.0, 0.0, 1.0] {
                prop_assert!((curve.at(angles[i] + turns * turn) - from).abs() < 1e-12);
            }
            let mut before = from;
            for step in 1..=50 {
                let angle = angles[i] + (end - angles[i]) * f64::from(step) / 50.0;
                let value = curve.at(angle);
                let risen = (value - before) * (to - from).signum();
                prop_assert!(risen >= -1e-13 && (to != from || value == from));
                before = value;
            }
            prop_assert!((before - to).abs() < 1e-13);
            let slope = |angle: f64| curve.at(Dual64::from(angle).derivative()).eps;
            let (left, right) = (slope(angles[i] - 1e-12), slope(angles[i] + 1e-12));
            prop_assert!((left - right).abs() < 1e-8, "{left} {right}");
        }
    }

    #[test]
    fn slip_dissipates_what_the_curve_says(points in points(), direction in 0.0..360.0f64) {
        let (angles, mu): (Vec<f64>, Vec<f64>) = points.into_iter().unzip();
        let friction = tabulated(&angles, &mu).unwrap();
        let least = mu.iter().copied().fold(f64::INFINITY, f64::min);
        let largest = mu.iter().copied().fold(0.0, f64::max);
        let d = unit(direction);
        let w = upper(&friction, &Vector3::x(), &d);
        prop_assert!(w.cross(&d).norm() < 1e-14 && w.dot(&d) >= least * (1.0 - 1e-12));
        let surface = friction.slip_surface(0.0);
        prop_assert!(matches!(&surface, SlipSurface::Star(_)));
        let margin = surface.least_dissipation().dissipation() * largest;
        prop_assert!((margin - least).abs() < 1e-12 && surface.extremes().traction == 1.0);
    }
}
