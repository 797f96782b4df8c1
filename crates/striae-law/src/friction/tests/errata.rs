//! Errors of the published law, each held down by a test.

use nalgebra::{Vector2, Vector3};
use proptest::prelude::*;

use super::assert_reads;
use crate::friction::{Published, SlipSample, TwoTextures};

const ALIGNED: f64 = 0.0;

fn reference() -> TwoTextures {
    TwoTextures::new(0.1, 0.1, 0.5).unwrap()
}

/// A unit vector of the plane at an angle.
fn unit(angle: f64) -> Vector3<f64> {
    Vector3::new(angle.cos(), angle.sin(), 0.0)
}

/// Admissible constants.
fn admissible() -> impl Strategy<Value = [f64; 3]> {
    (-0.9..0.9f64, -0.2..1.0f64, -3.0..3.0f64)
        .prop_map(|(c_mag, c_ang, c_cen)| [c_mag, c_ang, c_cen])
        .prop_filter("admissible", |c| {
            TwoTextures::new(c[0], c[1], c[2]).is_ok_and(|law| law.least_dissipation().value > 0.01)
        })
}

#[test]
fn friction_opposes_slip_and_is_larger_where_scales_dig_in() {
    let (a, kernel) = (unit(0.3), reference().kernel(&unit(0.3), &unit(0.3)));
    let with = kernel.traction(1.0, &-a);
    let against = kernel.traction(1.0, &a);
    assert!(against.dot(&a) < 0.0 && with.dot(&-a) < 0.0);
    assert!(against.norm() > with.norm());
}

#[test]
fn slip_rule_and_published_slip_function_disagree() {
    let (exact, published) = (
        reference().slip_surface(ALIGNED),
        Published::new(&reference(), ALIGNED),
    );
    let half_turn = std::f64::consts::PI;
    let size = |sample: SlipSample| sample.traction.norm();
    assert_reads(size(exact.at(0.0)), 2.10, 2);
    assert_reads(size(exact.at(half_turn)), 1.70, 2);
    assert_reads(size(published.at(0.0)), 1.55, 2);
    assert_reads(size(published.at(half_turn)), 1.35, 2);
}

#[test]
fn published_and_exact_agree_without_texture_effects() {
    let plain = TwoTextures::new(0.3, 0.0, 0.5).unwrap();
    let (exact, published) = (plain.slip_surface(1.0), Published::new(&plain, 1.0));
    for (one, other) in exact.sampled(24).iter().zip(published.sampled(24)) {
        assert!((one.traction - other.traction).norm() < 1e-14);
    }
}

proptest! {
    #[test]
    #[allow(non_snake_case)]
    fn size_of_friction_has_the_factor_two_that_30_lacks(
        c in admissible(), theta in 0.0..3.1f64, phi in -3.1..3.1f64,
    ) {
        let law = TwoTextures::new(c[0], c[1], c[2]).unwrap();
        let (own, opposite, d) = (unit(0.2), unit(0.2 + theta), unit(phi));
        let w = -law.kernel(&own, &opposite).traction(1.0, &d);
        let (I0, I1) = (own.dot(&opposite), (own + opposite).dot(&d));
        let alpha0 = 1.0 + c[0] * I0;
        let alpha1 = c[1] * (1.0 + I0) * (c[2] + I1);
        let right = alpha0 * alpha0 + 2.0 * alpha0 * alpha1 * I1 + alpha1 * alpha1 * (2.0 + 2.0 * I0);
        prop_assert!((w.norm_squared() - right).abs() < 1e-11 * (1.0 + right));
    }

    #[test]
    #[allow(non_snake_case)]
    fn published_slip_function_follows_from_the_wrong_30(
        c in admissible(), theta in 0.0..3.1f64, phi in -3.1..3.1f64,
    ) {
        let law = TwoTextures::new(c[0], c[1], c[2]).unwrap();
        let v = Published::new(&law, theta).at(phi).traction;
        let I0 = theta.cos();
        let m = (2.0 + 2.0 * I0).sqrt();
        let (A, B) = (1.0 + c[0] * I0, c[1] * (1.0 + I0));
        let I1 = m * (v.x - B * m * c[2]) / (A + B * m * m);
        let alpha1 = B * (c[2] + I1);
        let wrong = A * A + A * alpha1 * I1 + alpha1 * alpha1 * m * m;
        prop_assert!((v.norm_squared() - wrong).abs() < 1e-11 * (1.0 + wrong));
    }

    #[test]
    fn published_slip_surface_is_the_stated_ellipse(
        c in admissible(), theta in 0.0..3.1f64, phi in -3.1..3.1f64,
    ) {
        let law = TwoTextures::new(c[0], c[1], c[2]).unwrap();
        let exact = law.slip_surface(theta);
        let v = Published::new(&law, theta).at(phi).traction;
        let square = exact.along * exact.across + 0.25 * exact.offset * exact.offset;
        let left = (v.x - 0.5 * exact.offset).powi(2) + exact.along / exact.across * v.y * v.y;
        prop_assert!((left - square).abs() < 1e-11 * (1.0 + square));
    }

    #[test]
    fn slip_surface_is_convex(
        c in admissible(), theta in 0.0..3.1f64,
        u in (-2.0..2.0f64, -2.0..2.0f64), v in (-2.0..2.0f64, -2.0..2.0f64),
    ) {
        let surface = TwoTextures::new(c[0], c[1], c[2]).unwrap().slip_surface(theta);
        let (u, v) = (Vector2::new(u.0, u.1), Vector2::new(v.0, v.1));
        let sum = surface.gauge(&u) + surface.gauge(&v);
        prop_assert!(surface.gauge(&(u + v)) <= sum * (1.0 + 1e-12) + 1e-14);
    }
}
