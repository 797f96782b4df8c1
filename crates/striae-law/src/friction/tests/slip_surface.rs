//! Closed forms of the elliptic slip surface against brute force.

use nalgebra::Vector2;
use proptest::prelude::*;

use super::dense;
use crate::friction::{Ellipse, SlipRule};

/// Slip surfaces that hold the origin.
fn surfaces() -> impl Strategy<Value = Ellipse> {
    let opposing = (0.1..3.0f64, 0.1..3.0f64, -0.95..0.95f64).prop_map(|(p, a, h)| Ellipse {
        along: p,
        across: a,
        offset: h * p,
        rule: SlipRule::Opposing,
    });
    let associated = (0.1..3.0f64, 0.1..3.0f64).prop_map(|(p, a)| Ellipse {
        along: p,
        across: a,
        offset: 0.0,
        rule: SlipRule::Associated,
    });
    prop_oneof![opposing, associated]
}

proptest! {
    #[test]
    fn gauge_is_one_on_the_surface_and_scales(
        surface in surfaces(), phi in -3.1..3.1f64, scale in 0.1..10.0f64,
    ) {
        let v = surface.at(phi).traction;
        prop_assert!((surface.gauge(&v) - 1.0).abs() < 1e-10);
        prop_assert!((surface.gauge(&(v * scale)) - scale).abs() < 1e-9 * scale);
    }

    #[test]
    fn angle_inverts_the_surface(
        surface in surfaces(), phi in -3.1..3.1f64, scale in 0.1..10.0f64,
    ) {
        let v = surface.at(phi).traction * scale;
        prop_assert!((surface.angle(&v) - phi).abs() < 1e-9);
    }

    #[test]
    fn gauge_grows_linearly_from_the_origin(
        surface in surfaces(), x in -2.0..2.0f64, y in -2.0..2.0f64,
    ) {
        let v = Vector2::new(x, y);
        prop_assert!((surface.gauge(&(v * 3.0)) - 3.0 * surface.gauge(&v)).abs() < 1e-10 * (1.0 + v.norm() / surface.across));
        prop_assert_eq!(surface.gauge(&Vector2::zeros()), 0.0);
    }

    #[test]
    fn largest_traction_is_that_of_brute_force(surface in surfaces()) {
        let found = dense(&surface).iter().map(|s| s.traction.norm()).fold(0.0, f64::max);
        let exact = surface.extremes().traction;
        prop_assert!(found <= exact + 1e-12 && exact - found < 1e-5, "{} {}", exact, found);
    }

    #[test]
    fn least_dissipation_is_that_of_brute_force(surface in surfaces()) {
        let found = dense(&surface).iter().map(|s| s.dissipation()).fold(f64::INFINITY, f64::min);
        let exact = surface.least_dissipation().dissipation();
        prop_assert!(found >= exact - 1e-12 && found - exact < 1e-5, "{} {}", exact, found);
    }

    #[test]
    fn largest_deviation_is_that_of_brute_force(surface in surfaces()) {
        prop_assume!(surface.least_dissipation().dissipation() > 0.02);
        let found = dense(&surface).iter().map(|s| s.deviation.abs()).fold(0.0, f64::max);
        let exact = surface.extremes().deviation;
        prop_assert!(found <= exact + 1e-10 && exact - found < 1e-4, "{} {}", exact, found);
    }

    #[test]
    fn associated_slip_is_normal_to_the_surface(
        p in 0.1..3.0f64, a in 0.1..3.0f64, phi in -3.1..3.1f64,
    ) {
        let surface = Ellipse { along: p, across: a, offset: 0.0, rule: SlipRule::Associated };
        let tangent = Vector2::new(-p * phi.sin(), a * phi.cos());
        prop_assert!(surface.at(phi).slip.dot(&tangent).abs() < 1e-13);
    }
}
