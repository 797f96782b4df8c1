//! Static and kinetic friction with healing, beside closed forms: decay with slip, steady slip, and
//! breakaway after rest.

use striae_law::friction::{Friction, Healing, HealingCourse, StateDependence};
use striae_solve::state::State;

use crate::{
    blocks::{force, uniform},
    scene::{Run, coulomb},
    slider::{Drag, PRESSURE, STIFFNESS, coefficients, pressure, slider_with},
};

const MU: f64 = 0.6;
/// Kinetic over static coefficient.
const KINETIC: f64 = 0.7;
/// Rise of logarithmic healing over the kinetic coefficient.
const RISE: f64 = 0.03;

fn exponential(slip_distance: f64, healing_time: f64) -> Healing {
    Healing {
        course: HealingCourse::Exponential {
            kinetic_over_static: KINETIC,
        },
        slip_distance,
        healing_time,
        state: 1.0,
    }
}

fn logarithmic(slip_distance: f64, healing_time: f64) -> Healing {
    Healing {
        course: HealingCourse::Logarithmic { factor: RISE },
        state: 0.0,
        ..exponential(slip_distance, healing_time)
    }
}

fn friction(law: Healing) -> Friction {
    coulomb(MU).with_state(StateDependence::healing(law).unwrap())
}

#[test]
fn friction_of_a_block_in_full_slip_goes_along_the_closed_form() {
    let (pressing, sliding, speed) = (1.0, 2.0, 0.15);
    for law in [exponential(0.1, 1.5), logarithmic(0.1, 1.5)] {
        let run = Run::completed(uniform(PRESSURE, speed, friction(law)));
        let at_rest = law.state_after(law.state, 0.0, pressing);
        let states: &[State] = &run.states[2..];
        for (k, state) in states.iter().enumerate() {
            let time = sliding * (k + 1) as f64 / states.len() as f64;
            let expected = law.factor(law.state_after(at_rest, speed, time));
            let [along, normal] = force(&run, state);
            let found = along / (MU * normal);
            assert!(
                (found / expected - 1.0).abs() < 1e-9,
                "{law}: {found}, not {expected}"
            );
            let of_nodes = state.pairs[0].tractions.factors.as_ref().unwrap();
            assert_eq!(of_nodes.count, 1);
        }
    }
}

/// Number of increments that resolve loading and breakaway.
const FINE: usize = 1000;
/// Friction over pressure to which the spring is loaded by then if nothing slips.
const LOADED: f64 = 1.0;

/// Largest friction over pressure in breakaways at the start and after rests, and what it should
/// be: a slider on a spring twenty times as stiff as friction falls with slip slides until its
/// friction is that of steady slip, rests, and is dragged again.
fn breakaways(law: Healing, rate: f64, rests: &[f64]) -> [Vec<f64>; 2] {
    let load = LOADED * PRESSURE / (STIFFNESS * rate);
    let slide = 10.0 * law.slip_distance / rate;
    let drag = || [Drag(rate, load, FINE), Drag(rate, slide, 40)];
    let mut drags = drag().to_vec();
    for rest in rests {
        drags.push(Drag(0.0, *rest, 5));
        drags.extend(drag());
    }
    let run = Run::completed(slider_with(friction(law), &drags));
    let found = coefficients(&run);
    let stiffness = STIFFNESS / pressure(&run);
    let largest = |first: usize| {
        let of = found[first..first + FINE].iter();
        of.copied().fold(0.0, f64::max)
    };
    let mut peaks = vec![largest(0)];
    // The spring is loaded until friction is that of the time at rest.
    let broken = |mut loaded: f64, state: f64, mut time: f64| {
        while loaded < MU * law.factor(law.state_after(state, 0.0, time)) {
            time += 1e-5 * load;
            loaded += stiffness * rate * 1e-5 * load;
        }
        loaded
    };
    let steady: f64 = law.steady_state(rate);
    let mut expected = vec![broken(0.0, law.state, 0.0)];
    for (k, rest) in rests.iter().enumerate() {
        peaks.push(largest((FINE + 45) * (k + 1)));
        expected.push(broken(MU * law.factor(steady), steady, *rest));
    }
    [peaks, expected]
}

/// Friction over pressure by which the spring is loaded in an increment.
const RESOLVED: f64 = LOADED / FINE as f64;

/// Slip over which friction falls with a twentieth of the slope of the spring.
fn distance(fall: f64) -> f64 {
    20.0 * MU * fall * PRESSURE / STIFFNESS
}

#[test]
fn friction_breaks_away_at_the_static_coefficient_and_comes_back_to_it_at_rest() {
    let distance = distance(1.0 - KINETIC);
    let (rate, time) = (1e-3, 50.0 * distance / 1e-3);
    let law = exponential(distance, time);
    let rests = [0.1, 0.5, 2.0, 20.0].map(|share| share * time);
    let [peaks, expected] = breakaways(law, rate, &rests);
    for (peak, expected) in peaks.iter().zip(&expected) {
        let off = (peak - expected).abs();
        assert!(off < RESOLVED, "{peaks:?}, not {expected:?}");
    }
    assert!((peaks[0] - MU).abs() < RESOLVED);
    assert!((peaks[4] - MU).abs() < RESOLVED);
}

#[test]
fn friction_heals_with_the_logarithm_of_the_time() {
    let distance = distance(RISE);
    let (rate, time) = (1e-3, 0.1 * distance / 1e-3);
    let law = logarithmic(distance, time);
    let rests = [1e4, 1e5, 1e6].map(|share| share * time);
    let [peaks, expected] = breakaways(law, rate, &rests);
    for (peak, expected) in peaks.iter().zip(&expected) {
        let off = (peak - expected).abs();
        assert!(off < RESOLVED, "{peaks:?}, not {expected:?}");
    }
    for pair in peaks[1..].windows(2) {
        let rise = (pair[1] - pair[0]) / (MU * RISE * 10f64.ln());
        assert!((rise - 1.0).abs() < 0.05, "{rise}: {peaks:?}");
    }
}
