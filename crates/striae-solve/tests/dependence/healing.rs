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

/// Breakaway after rest: a slider on a spring twenty times as stiff as friction falls with slip
/// slides until its friction is that of steady slip, rests, and is dragged again.
fn breakaways(law: Healing, rate: f64, holds: &[f64]) -> [Vec<f64>; 2] {
    // Far below the slip that increments of rest take up.
    let slow = 1e-3 * rate;
    let slide = 10.0 * law.slip_distance / rate;
    let mut drags = vec![Drag(rate, slide, 200)];
    for hold in holds {
        // The rest ends where loading begins; the surface goes on to heal until it slips.
        drags.extend([Drag(slow, *hold, 20), Drag(rate, slide, 400)]);
    }
    let run = Run::completed(slider_with(friction(law), &drags));
    let found = coefficients(&run);
    let p = pressure(&run);
    let mut peaks = vec![found[..200].iter().copied().fold(0.0, f64::max)];
    let mut expected = vec![MU * law.factor(law.state_after(law.state, 0.0, 1e-3))];
    let mut state: f64 = law.steady_state(rate);
    for (k, hold) in holds.iter().enumerate() {
        let first = 200 + 420 * k + 20;
        peaks.push(
            found[first..first + 400]
                .iter()
                .copied()
                .fold(0.0, f64::max),
        );
        let (mut loaded, mut time) = (MU * law.factor(state) + STIFFNESS * slow * hold / p, *hold);
        // The spring is loaded until friction is that of the time at rest.
        let mut left = slide;
        while loaded < MU * law.factor(law.state_after(state, 0.0, time)) && left > 0.0 {
            let step = 1e-5 * slide;
            time += step;
            left -= step;
            loaded += STIFFNESS * rate * step / p;
        }
        expected.push(loaded);
        state = law.steady_state(rate);
    }
    [peaks, expected]
}

/// Slip over which friction falls with a twentieth of the slope of the spring.
fn distance(fall: f64) -> f64 {
    20.0 * MU * fall * PRESSURE / STIFFNESS
}

#[test]
fn friction_breaks_away_at_the_static_coefficient_and_comes_back_to_it_at_rest() {
    let distance = distance(1.0 - KINETIC);
    let (rate, time) = (1e-3, 50.0 * distance / 1e-3);
    let law = exponential(distance, time);
    let holds = [0.1, 0.5, 2.0, 20.0].map(|share| share * time);
    let [peaks, expected] = breakaways(law, rate, &holds);
    // Loading from rest to breakaway is resolved to 1/400 of the slip of a drag.
    let resolved = STIFFNESS * 10.0 * distance / (PRESSURE * 200.0);
    for (peak, expected) in peaks.iter().zip(&expected) {
        let short = expected - peak;
        assert!(
            (-1e-4..resolved).contains(&short),
            "{peaks:?}, not {expected:?}"
        );
    }
    assert!((peaks[4] - MU).abs() < resolved, "{peaks:?}");
}

#[test]
fn friction_heals_with_the_logarithm_of_the_time() {
    let distance = distance(RISE);
    let (rate, time) = (1e-3, 0.1 * distance / 1e-3);
    let law = logarithmic(distance, time);
    let holds = [1e4, 1e5, 1e6].map(|share| share * time);
    let [peaks, expected] = breakaways(law, rate, &holds);
    for (peak, expected) in peaks.iter().zip(&expected).skip(1) {
        assert!(
            (peak / expected - 1.0).abs() < 0.01,
            "{peaks:?}, not {expected:?}"
        );
    }
    for pair in peaks[1..].windows(2) {
        let rise = (pair[1] - pair[0]) / (MU * RISE * 10f64.ln());
        assert!((rise - 1.0).abs() < 0.05, "{rise}: {peaks:?}");
    }
}
