//! Coefficients that depend on slip rate and state, beside closed forms.

use nalgebra::DVector;
use striae_verify::assert_directional;

use super::laws_of_all_kinds;
use crate::friction::{
    Creep, Evolution, Friction, FrictionError, Past, PressureDependence, RateAndState,
    SlipDependence, StateDependence, battery,
};

const MU: f64 = 0.6;
const BOTH: [Evolution; 2] = [Evolution::Ageing, Evolution::Slip];

fn law(evolution: Evolution) -> RateAndState {
    RateAndState {
        evolution,
        direct_effect: 0.01,
        evolution_effect: 0.015,
        slip_rate: 1e-6,
        slip_distance: 1e-5,
        state: 10.0,
    }
}

fn dependence(evolution: Evolution) -> StateDependence {
    StateDependence::rate_and_state(law(evolution)).unwrap()
}

fn rock(evolution: Evolution) -> Friction {
    let friction = Friction::coulomb(MU).unwrap();
    friction.with_state(dependence(evolution))
}

fn past(state: f64, elapsed: f64) -> Past {
    Past {
        slip: 0.0,
        state,
        elapsed,
    }
}

/// Asserts closeness relative to the larger of both and 1.
fn close(found: f64, expected: f64, tolerance: f64) {
    let error = (found - expected).abs();
    let bound = tolerance * found.abs().max(expected.abs()).max(1.0);
    assert!(error <= bound, "{found} {expected}: {error:.1e}");
}

#[test]
fn steady_slip_has_the_coefficient_of_its_logarithm() {
    for evolution in BOTH {
        let law = law(evolution);
        for rate in [1e-12, 1e-9, 1e-6, 1e-3, 1.0] {
            let expected = MU + (0.01 - 0.015) * (rate / 1e-6_f64).ln();
            // The regularisation adds exp(-2 mu/a) of `a`, less than round-off here.
            close(law.steady(MU, rate), expected, 1e-13);
            // A long increment ends in steady slip.
            let state = law.state_after(3.0, rate, 1e3 * 1e-5 / rate);
            close(state * rate / 1e-5, 1.0, 1e-12);
        }
        assert_eq!(law.steady(MU, 0.0), MU);
        assert_eq!(law.coefficient(MU, 0.0, 10.0), 0.0);
    }
}

#[test]
fn contacts_age_at_rest_by_one_law_and_keep_their_state_by_the_other() {
    let [ageing, slip] = BOTH.map(law);
    for elapsed in [1e-3, 1.0, 1e6] {
        assert_eq!(ageing.state_after(10.0, 0.0, elapsed), 10.0 + elapsed);
        assert_eq!(slip.state_after(10.0, 0.0, elapsed), 10.0);
        // Rates below all numbers are rest.
        close(
            ageing.state_after(10.0, 1e-300, elapsed),
            10.0 + elapsed,
            1e-15,
        );
        close(slip.state_after(10.0, 1e-300, elapsed), 10.0, 1e-15);
    }
}

#[test]
fn states_go_along_the_exact_solution() {
    for evolution in BOTH {
        let law = law(evolution);
        for (state, rate, elapsed) in [(10.0, 1e-6, 3.0), (0.2, 1e-5, 4.0), (900.0, 3e-7, 40.0)] {
            // Two increments are one.
            let half = law.state_after(state, rate, 0.3 * elapsed);
            let whole = law.state_after(state, rate, elapsed);
            close(law.state_after(half, rate, 0.7 * elapsed), whole, 1e-13);
            // Runge and Kutta's method, of fourth order.
            let slope = |state: f64| {
                let omega = rate * state / 1e-5;
                match evolution {
                    Evolution::Ageing => 1.0 - omega,
                    Evolution::Slip => -omega * omega.ln(),
                }
            };
            let (count, mut found) = (2000, state);
            let h = elapsed / f64::from(count);
            for _ in 0..count {
                let a = slope(found);
                let b = slope(found + 0.5 * h * a);
                let c = slope(found + 0.5 * h * b);
                let d = slope(found + h * c);
                found += h / 6.0 * (a + 2.0 * b + 2.0 * c + d);
            }
            close(found, whole, 1e-9);
        }
    }
}

#[test]
fn friction_after_a_step_of_the_rate_decays_over_the_slip_distance() {
    let (before, after) = (1e-6, 1e-5_f64);
    let jump: f64 = after / before;
    for evolution in BOTH {
        let law = law(evolution);
        let steady = law.steady(MU, after);
        for share in [0.0_f64, 0.1, 1.0, 3.0, 10.0] {
            let elapsed = share * 1e-5 / after;
            let state = law.state_after(1e-5 / before, after, elapsed);
            let excess = law.coefficient(MU, after, state) - steady;
            let left = (-share).exp();
            let expected = match evolution {
                Evolution::Ageing => 0.015 * (1.0 + (jump - 1.0) * left).ln(),
                Evolution::Slip => 0.015 * left * jump.ln(),
            };
            close(excess, expected, 1e-13);
        }
    }
}

/// Lengths over 40 decades of the rate, and the creep that belongs to them.
fn creeps(friction: &Friction, past: Past) -> Vec<(f64, f64, Creep)> {
    let pressure = 5.0;
    let least = friction.creep_stiffness(past, pressure) * past.elapsed;
    let stiffness = least.max(2.0 * past.elapsed);
    let lengths = (-60..60).map(|at| 3.0 * 10f64.powf(0.1 * f64::from(at)));
    lengths
        .map(|length| {
            let creep = friction.creep(past, pressure, 0.8, stiffness, length);
            (length, stiffness, creep)
        })
        .collect()
}

#[test]
fn friction_and_spring_carry_the_length_together() {
    for evolution in BOTH {
        let friction = rock(evolution);
        let law = law(evolution);
        for past in [past(10.0, 1.0), past(1e4, 1e-2), past(1e-3, 100.0)] {
            let mut before = f64::NEG_INFINITY;
            for (length, stiffness, creep) in creeps(&friction, past) {
                let sum = creep.radius + stiffness * creep.slip_rate;
                assert!((sum / length - 1.0).abs() < 1e-12, "{length}: {sum}");
                // One rate belongs to each length, and slip dissipates.
                assert!(creep.radius >= 0.0 && creep.slip_rate > before, "{length}");
                before = creep.slip_rate;
                let state = law.state_after(past.state, creep.slip_rate, past.elapsed);
                let varpi = 0.8 * 5.0 * law.coefficient(MU, creep.slip_rate, state);
                assert!((varpi - creep.radius).abs() < 1e-12 * length.max(1.0));
            }
        }
    }
}

#[test]
fn a_surface_far_below_strength_hardly_creeps() {
    let friction = rock(Evolution::Ageing);
    // A third of its strength.
    let creep = friction.creep(past(10.0, 1.0), 5.0, 1.0, 1e3, 1.0);
    assert!((creep.radius - 1.0).abs() < 1e-12);
    assert!(creep.slip_rate < 1e-20 && creep.slip_rate > 0.0);
    assert!((creep.by_length - 1.0).abs() < 1e-12);
    // At rest and without pressure.
    let rest = friction.creep(past(10.0, 1.0), 5.0, 1.0, 1e3, 0.0);
    assert_eq!([rest.radius, rest.slip_rate], [0.0; 2]);
    let open = friction.creep(past(10.0, 1.0), 0.0, 1.0, 1e3, 2.0);
    assert_eq!([open.radius, open.slip_rate], [0.0, 2e-3]);
}

#[test]
fn derivatives_of_creep_are_exact() {
    for evolution in BOTH {
        let power = PressureDependence::power_law(0.8, 3.0, None).unwrap();
        let run_in = SlipDependence::exponential(1.5, 0.2).unwrap();
        let friction = rock(evolution).with_pressure(power).with_slip(run_in);
        let past = Past {
            slip: 0.1,
            ..past(10.0, 1.0)
        };
        let least: f64 = friction.creep_stiffness(past, 5.0);
        // Length, pressure, reach, stiffness: hardly creeping, beginning to slip, slipping fast.
        for length in [1.2, 2.9, 3.4, 4.0, 9.0] {
            let x = DVector::from_vec(vec![length, 5.0, 0.8, least.max(1e5)]);
            let creep = |x: &DVector<f64>| friction.creep(past, x[1], x[2], x[3], x[0]);
            let at = creep(&x);
            let slopes = [at.by_length, at.by_pressure, at.by_reach, at.by_stiffness];
            for (axis, slope) in slopes.into_iter().enumerate() {
                let mut direction = DVector::zeros(4);
                direction[axis] = x[axis];
                let claimed = DVector::from_element(1, slope * x[axis]);
                let radius = |x: &DVector<f64>| DVector::from_element(1, creep(x).radius);
                assert_directional(radius, &claimed, &x, &direction);
            }
            let stiffness = |p: f64| friction.creep_stiffness(past, p);
            let by_p = friction.creep_stiffness(past, num_dual::Dual64::from(5.0).derivative());
            let x = DVector::from_element(1, 5.0);
            assert_directional(
                |x| DVector::from_element(1, stiffness(x[0])),
                &DVector::from_element(1, by_p.eps),
                &x,
                &DVector::from_element(1, 1.0),
            );
        }
    }
}

#[test]
fn friction_never_falls_faster_with_slip_than_stated() {
    for evolution in BOTH {
        let law = law(evolution);
        for (state, elapsed) in [(10.0, 1.0), (1e5, 1e-2), (1e-4, 10.0)] {
            let most = law.largest_weakening(state, elapsed);
            let after = |slip: f64| {
                let rate = slip / elapsed;
                law.coefficient(MU, rate, law.state_after(state, rate, elapsed))
            };
            let slips: Vec<f64> = (0..400)
                .map(|at| 1e-10 * 10f64.powf(0.02 * f64::from(at)))
                .collect();
            for pair in slips.windows(2) {
                let fall = (after(pair[0]) - after(pair[1])) / (pair[1] - pair[0]);
                assert!(fall <= most, "{evolution:?} {pair:?}: {fall} > {most}");
            }
        }
    }
}

#[test]
fn all_laws_pass_the_battery_with_a_state() {
    for law in laws_of_all_kinds() {
        for evolution in BOTH {
            let friction = law.clone().with_state(dependence(evolution));
            assert_eq!(battery(&friction), [], "{:?}", friction.law());
        }
    }
}

#[test]
fn the_shear_cap_bounds_friction_with_a_state() {
    let friction = rock(Evolution::Ageing).with_shear_cap(1.5).unwrap();
    let creep = friction.creep(past(10.0, 1.0), 5.0, 1.0, 1e3, 40.0);
    assert_eq!(creep.radius, 1.5);
    close(creep.slip_rate, 38.5e-3, 1e-12);
}

#[test]
fn constants_out_of_range_are_refused() {
    let refused = |change: fn(&mut RateAndState)| {
        let mut law = law(Evolution::Slip);
        change(&mut law);
        let found = StateDependence::rate_and_state(law);
        matches!(found, Err(FrictionError::Constant { .. }))
    };
    assert!(refused(|law| law.direct_effect = 0.0));
    assert!(refused(|law| law.evolution_effect = -0.1));
    assert!(refused(|law| law.slip_rate = -1.0));
    assert!(refused(|law| law.slip_distance = f64::INFINITY));
    assert!(refused(|law| law.state = 0.0));
}

#[test]
fn a_dependence_on_the_rate_and_one_on_the_state_take_each_others_place() {
    let decaying = Friction::coulomb(MU).unwrap().with_decay(0.5, 1.0).unwrap();
    let friction = decaying.with_state(dependence(Evolution::Ageing));
    assert!(!friction.depends_on_rate() && friction.rate_and_state().is_some());
    let friction = friction.with_decay(0.5, 1.0).unwrap();
    assert!(friction.depends_on_rate() && friction.rate_and_state().is_none());
}
