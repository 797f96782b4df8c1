//! Static and kinetic friction with healing.

use num_dual::Dual64;

use super::laws_of_all_kinds;
use crate::friction::{
    Friction, Healing, HealingCourse, PressureDependence, SlipDependence, StateDependence, battery,
};

const DISTANCE: f64 = 0.02;
const TIME: f64 = 3.0;

fn exponential() -> Healing {
    Healing {
        course: HealingCourse::Exponential {
            kinetic_over_static: 0.6,
        },
        slip_distance: DISTANCE,
        healing_time: TIME,
        state: 1.0,
    }
}

fn logarithmic() -> Healing {
    Healing {
        course: HealingCourse::Logarithmic { factor: 0.05 },
        slip_distance: DISTANCE,
        healing_time: TIME,
        state: 0.0,
    }
}

fn both() -> [Healing; 2] {
    [exponential(), logarithmic()]
}

fn close(found: f64, expected: f64) {
    let error = (found - expected).abs();
    assert!(
        error < 1e-12 * expected.abs().max(1.0),
        "{found}, not {expected}"
    );
}

#[test]
fn friction_falls_exponentially_with_fast_slip() {
    let law = exponential();
    for slip in [0.0, 0.01, 0.1] {
        // So fast that nothing heals.
        let elapsed = 1e-12;
        let state = law.state_after(1.0, slip / elapsed, elapsed);
        let expected = 0.6 + 0.4 * (-slip / DISTANCE).exp();
        assert!((law.factor(state) - expected).abs() < 1e-11);
    }
}

#[test]
fn friction_heals_at_rest() {
    for time in [1e-3, 1.0, 30.0, 1e6] {
        let formed = exponential().state_after(0.0, 0.0, time);
        close(formed, 1.0 - (-time / TIME).exp());
        let law = logarithmic();
        let factor = law.factor(law.state_after(0.0, 0.0, time));
        close(factor, 1.0 + 0.05 * (time / TIME).ln_1p());
    }
}

#[test]
fn steady_slip_has_the_state_of_its_rate() {
    for law in both() {
        for rate in [1e-4, 1e-2, 10.0] {
            let steady: f64 = law.steady_state(rate);
            close(law.state_after(steady, rate, 0.7), steady);
            let other = law.state_after(0.3, rate, 1e9);
            close(other, steady);
        }
    }
    close(
        exponential().steady_state(1.0),
        1.0 / (1.0 + TIME / DISTANCE),
    );
    close(logarithmic().steady_state(1.0), DISTANCE);
}

#[test]
fn an_increment_and_its_halves_lead_to_one_state() {
    for law in both() {
        for rate in [0.0, 1e-9, 1e-3, 0.05, 3.0] {
            let whole: f64 = law.state_after(0.4, rate, 0.5);
            let half = law.state_after(0.4, rate, 0.25);
            close(law.state_after(half, rate, 0.25), whole);
        }
    }
}

#[test]
fn friction_is_convex_and_never_falls_faster_than_stated() {
    for law in both() {
        for (elapsed, before) in [(1e-3, 1.0), (1.0, 0.2), (1e3, 0.0), (1.0, 1.0)] {
            let mut last = f64::INFINITY;
            for at in 0..400 {
                let slip = DISTANCE * 1e-4 * 1.05_f64.powi(at);
                let rate = Dual64::from(slip / elapsed).derivative();
                let factor = law.factor(law.state_after(before, rate, elapsed));
                let fall = -factor.eps / elapsed;
                assert!(
                    fall <= law.largest_weakening() * (1.0 + 1e-9),
                    "{law}: {fall}"
                );
                assert!(
                    fall <= last * (1.0 + 1e-6) + 1e-9,
                    "{law}: {fall} after {last}"
                );
                assert!(fall >= -1e-12);
                last = fall;
            }
        }
    }
}

#[test]
fn all_laws_pass_the_battery_with_healing() {
    for friction in laws_of_all_kinds() {
        for law in both() {
            let power = PressureDependence::power_law(0.7, 0.5, None).unwrap();
            let friction = friction
                .clone()
                .with_state(StateDependence::healing(law).unwrap())
                .with_pressure(power)
                .with_slip(SlipDependence::exponential(1.5, 0.1).unwrap());
            assert_eq!(battery(&friction), [], "{:?}, {law}", friction.law());
            assert!(friction.rate_and_state().is_none() && friction.weakens());
        }
    }
}

#[test]
fn the_bound_without_history_is_that_of_steady_slip() {
    let of = |law| {
        let state = StateDependence::healing(law).unwrap();
        Friction::coulomb(0.5).unwrap().with_state(state)
    };
    let exponential = of(exponential());
    close(exponential.cap(2.0, 0.0), 1.0);
    close(
        exponential.cap(2.0, 1e9),
        0.6 + 0.4 / (1.0 + 1e9 * TIME / DISTANCE),
    );
    let logarithmic = of(logarithmic());
    close(logarithmic.cap(2.0, 0.0), 1.0);
    let aged = (DISTANCE / 1e-3 / TIME).ln_1p();
    close(logarithmic.cap(2.0, 1e-3), 1.0 + 0.05 * aged);
}

#[test]
fn constants_out_of_range_are_refused() {
    let course = |kinetic_over_static: f64| HealingCourse::Exponential {
        kinetic_over_static,
    };
    let wrong = [
        Healing {
            course: course(1.2),
            ..exponential()
        },
        Healing {
            state: -0.1,
            ..exponential()
        },
        Healing {
            state: 1.1,
            ..exponential()
        },
        Healing {
            slip_distance: 0.0,
            ..logarithmic()
        },
        Healing {
            healing_time: -1.0,
            ..logarithmic()
        },
        Healing {
            course: HealingCourse::Logarithmic { factor: -0.1 },
            ..logarithmic()
        },
    ];
    for law in wrong {
        assert!(StateDependence::healing(law).is_err(), "{law:?}");
    }
}
