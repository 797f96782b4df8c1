//! Coefficients that depend on pressure and slip rate.

use num_dual::Dual64;

use super::laws_of_all_kinds;
use crate::friction::{
    Decay, Friction, FrictionError, Logarithm, PressureDependence, RateDependence, SlipDependence,
    battery,
};

fn decay(kinetic_over_static: f64, slip_rate: f64, exponent: f64, viscous: f64) -> RateDependence {
    RateDependence::decay(Decay {
        kinetic_over_static,
        slip_rate,
        exponent,
        viscous,
    })
    .unwrap()
}

fn logarithm(factor: f64, slip_rate: f64, limit: Option<f64>) -> RateDependence {
    RateDependence::logarithm(Logarithm {
        factor,
        slip_rate,
        limit,
    })
    .unwrap()
}

/// All forms of the pressure, above and below their floors at the pressure of the battery, 1.2.
fn by_pressure() -> Vec<PressureDependence> {
    vec![
        PressureDependence::default(),
        PressureDependence::power_law(2.0 / 3.0, 5.0, None).unwrap(),
        PressureDependence::power_law(0.8, 5.0, Some(2.0)).unwrap(),
        PressureDependence::power_law(1.3, 0.7, None).unwrap(),
        PressureDependence::adhesion(0.4, None).unwrap(),
        PressureDependence::adhesion(0.4, Some(2.0)).unwrap(),
        PressureDependence::saturation(0.3).unwrap(),
        PressureDependence::table(&[0.0, 1.0, 1.5, 4.0], &[1.4, 1.1, 0.6, 0.5]).unwrap(),
    ]
}

/// All forms of the rate.
fn by_rate() -> Vec<RateDependence> {
    vec![
        RateDependence::default(),
        decay(0.4, 0.7, 1.0, 0.0),
        decay(0.4, 0.7, 2.0, 0.1),
        decay(0.4, 0.7, 1.5, 0.0),
        logarithm(0.1, 0.2, None),
        logarithm(-0.1, 0.2, Some(3.0)),
        RateDependence::table(&[0.0, 0.3, 1.0, 5.0], &[1.0, 1.2, 0.7, 0.9]).unwrap(),
    ]
}

#[test]
fn all_dependences_pass_the_battery_together() {
    for pressure in by_pressure() {
        for rate in by_rate() {
            let name = format!("{pressure:?} {rate:?}");
            let nap = Friction::nap(0.11, 0.14, 0.2).unwrap();
            let friction = nap.with_pressure(pressure.clone()).with_rate(rate);
            assert_eq!(battery(&friction), [], "{name}");
        }
    }
}

#[test]
fn all_laws_pass_the_battery_with_all_dependences() {
    for law in laws_of_all_kinds() {
        for pressure in by_pressure() {
            for rate in by_rate() {
                let slip = SlipDependence::exponential(1.5, 0.1).unwrap();
                let friction = law.clone().with_pressure(pressure.clone());
                let friction = friction.with_rate(rate.clone()).with_slip(slip);
                assert_eq!(battery(&friction), [], "{friction:?}");
            }
        }
    }
}

/// `varpi` with its slopes by pressure and rate.
fn bound(friction: &Friction, p: f64, v: f64) -> [f64; 3] {
    let by_p = friction.cap(Dual64::from(p).derivative(), Dual64::from(v));
    let by_v = friction.cap(Dual64::from(p), Dual64::from(v).derivative());
    [by_p.re, by_p.eps, by_v.eps]
}

/// Asserts closeness within a multiple of round-off.
fn close(found: f64, expected: f64) {
    let error = (found - expected).abs();
    assert!(
        error <= 1e-13 * (1.0 + expected.abs()),
        "{found} {expected}"
    );
}

#[test]
fn bounds_are_those_of_their_formulas() {
    let (mu, v) = (0.3_f64, 0.0);
    let with = |dependence| Friction::coulomb(mu).unwrap().with_pressure(dependence);
    let power = with(PressureDependence::power_law(0.7, 2.0, None).unwrap());
    let adhesion = with(PressureDependence::adhesion(0.5, None).unwrap());
    let saturation = with(PressureDependence::saturation(0.4).unwrap());
    for p in [0.1, 1.0, 2.0, 30.0] {
        close(bound(&power, p, v)[0], mu * 2.0 * (p / 2.0_f64).powf(0.7));
        close(bound(&power, p, v)[1], mu * 0.7 * (p / 2.0_f64).powf(-0.3));
        close(bound(&adhesion, p, v)[0], mu * (p + 0.5));
        close(bound(&adhesion, p, v)[1], mu);
        close(bound(&saturation, p, v)[0], 0.4 * (mu * p / 0.4).tanh());
        let slope = mu / (mu * p / 0.4).cosh().powi(2);
        assert!((bound(&saturation, p, v)[1] - slope).abs() < 1e-14);
    }
    // Far beyond what hyperbolic functions can hold.
    for p in [1e3, 1e6, 1e200] {
        assert_eq!(bound(&saturation, p, v)[..2], [0.4, 0.0]);
    }
    let with = |dependence| Friction::coulomb(mu).unwrap().with_rate(dependence);
    let stribeck = with(decay(0.6, 0.5, 2.0, 0.2));
    let rising = with(logarithm(0.05, 1e-3, None));
    for v in [0.0, 0.1, 0.5, 3.0] {
        let factor = 0.6 + 0.4 * (-(v / 0.5_f64).powi(2)).exp() + 0.2 * v;
        close(bound(&stribeck, 2.0, v)[0], mu * 2.0 * factor);
        let factor = 1.0 + 0.05 * (1.0 + v / 1e-3_f64).ln();
        close(bound(&rising, 2.0, v)[0], mu * 2.0 * factor);
    }
}

#[test]
fn friction_leaves_zero_with_a_finite_slope_and_goes_on_smoothly_at_the_floor() {
    for (dependence, floor) in [
        (PressureDependence::power_law(0.6, 2.0, Some(0.01)), 0.01),
        (PressureDependence::adhesion(0.5, Some(0.05)), 0.05),
    ] {
        let dependence = dependence.unwrap();
        let largest = 0.3 * dependence.largest_factor();
        let friction = Friction::coulomb(0.3).unwrap().with_pressure(dependence);
        let [below, above] = [1.0 - 1e-12, 1.0].map(|share| bound(&friction, share * floor, 0.0));
        assert!((below[0] / above[0] - 1.0).abs() < 1e-10);
        assert!((below[1] / above[1] - 1.0).abs() < 1e-9);
        let [value, slope, _] = bound(&friction, 1e-12 * floor, 0.0);
        assert!(value > 0.0 && value < 1e-9 && (slope / largest - 1.0).abs() < 1e-9);
        let slopes = (1..200).map(|i| bound(&friction, 0.01 * f64::from(i) * floor, 0.0)[1]);
        assert!(slopes.is_sorted_by(|one, next| one >= next), "concave");
    }
}

#[test]
fn tables_go_through_their_points_and_stay_between_them() {
    let (places, factors) = ([0.0, 1.0, 1.5, 4.0], [1.4, 1.1, 0.6, 0.5]);
    let dependence = PressureDependence::table(&places, &factors).unwrap();
    let friction = Friction::coulomb(1.0).unwrap().with_pressure(dependence);
    let factor = |p: f64| friction.cap(p, 0.0) / p;
    for (place, expected) in places.into_iter().zip(factors).skip(1) {
        close(factor(place), expected);
    }
    assert!((1..1000).all(|i| factor(5e-3 * f64::from(i)) >= factor(5e-3 * f64::from(i + 1))));
    assert_eq!(friction.cap(10.0, 0.0), 5.0);
}

#[test]
fn accumulated_slip_scales_friction() {
    let law = SlipDependence::exponential(1.5, 0.2).unwrap();
    let friction = Friction::coulomb(0.3).unwrap().with_slip(law);
    assert_eq!(friction.cap(2.0, 1.0), 0.3 * 2.0);
    let expected = 0.6 * (1.5 - 0.5 * (-0.5_f64).exp());
    close(friction.cap_after(0.1, 2.0, 1.0), expected);
    let table = SlipDependence::table(&[0.0, 1.0, 2.0], &[1.0, 0.6, 0.8]).unwrap();
    let friction = Friction::coulomb(0.3).unwrap().with_slip(table);
    close(friction.cap_after(1.0, 2.0, 1.0), 0.36);
    close(friction.cap_after(9.0, 2.0, 1.0), 0.48);
    assert!(SlipDependence::exponential(0.0, 1.0).is_err());
}

#[test]
fn the_weakest_rate_is_where_friction_has_fallen_most() {
    assert_eq!(
        decay(0.5, 2.0, 1.0, 0.0).weakest_rate(),
        Some(f64::INFINITY)
    );
    assert_eq!(decay(1.2, 2.0, 1.0, 0.0).weakest_rate(), None);
    assert_eq!(decay(0.5, 2.0, 1.0, 1.0).weakest_rate(), None);
    assert_eq!(logarithm(0.1, 1.0, Some(2.0)).weakest_rate(), None);
    assert_eq!(logarithm(-0.1, 1.0, Some(2.0)).weakest_rate(), Some(2.0));
    for rate in by_rate() {
        let friction = Friction::coulomb(1.0).unwrap().with_rate(rate);
        let Some(weakest) = friction.weakest_rate() else {
            continue;
        };
        let least = friction.cap(1.0, weakest);
        assert!((0..2000).all(|i| friction.cap(1.0, 5e-3 * f64::from(i)) >= least - 1e-14));
    }
}

#[test]
fn constants_that_give_no_sound_friction_are_refused() {
    let told = |found: Result<RateDependence, FrictionError>| found.unwrap_err().to_string();
    let law = |factor, limit| {
        told(RateDependence::logarithm(Logarithm {
            factor,
            slip_rate: 1.0,
            limit,
        }))
    };
    assert!(law(-0.5, None).contains("vanish at the slip rate 6.389056"));
    assert!(law(-0.5, Some(7.0)).contains("needs a limit below that rate"));
    let steep = Decay {
        kinetic_over_static: 0.5,
        slip_rate: 1.0,
        exponent: 0.5,
        viscous: 0.0,
    };
    assert!(told(RateDependence::decay(steep)).contains("at least 1"));
    assert!(told(RateDependence::table(&[0.0, 1.0], &[1.0])).contains("equally many of both"));
    assert!(told(RateDependence::table(&[0.0, 0.0], &[1.0, 1.0])).contains("must ascend"));
    assert!(told(RateDependence::table(&[0.0, 1.0], &[1.0, 0.0])).contains("factors = 0"));
    let power = PressureDependence::power_law(0.0, 1.0, None).unwrap_err();
    assert!(power.to_string().contains("exponent = 0"));
}
