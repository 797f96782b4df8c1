//! Springs and dashpots with inertia: errors fall with the square of the increments.

use std::f64::consts::TAU;

use striae::{
    model::{StepBuilder, reference_of, spring_along, spring_to_point},
    prelude::*,
};

use super::scene::{equal, free, held, run, weight, with_block};

const MASS: f64 = 2.0;

fn swing(duration: f64, count: usize, velocity: [f64; 3]) -> StepBuilder {
    held("swing")
        .duration(duration)
        .dynamic(0.9)
        .increment_sizes(equal(count))
        .rigid_velocity("weight", velocity)
        .move_rigid("weight", free(&[0, 2]))
}

/// Asserts that an error falls with the square of the number of increments.
fn assert_second_order(error: impl Fn(usize) -> f64) {
    let errors = [40, 80, 160].map(error);
    for pair in errors.windows(2) {
        let order = (pair[0] / pair[1]).log2();
        assert!(
            (1.8..2.3).contains(&order),
            "order {order}, errors {errors:?}"
        );
    }
}

#[test]
fn a_weight_on_a_spring_swings_with_its_period() {
    let (stiffness, speed) = (8.0, 0.3);
    let omega = f64::sqrt(stiffness / MASS);
    assert_second_order(|count| {
        let duration = 1.3 * TAU / omega;
        let model = with_block("An oscillator")
            .rigid(weight("weight", [0.0; 3]))
            .spring(
                spring_along("spring", reference_of("weight"), [1.0, 0.0, 0.0])
                    .stiffness(stiffness),
            )
            .spring(
                spring_along("other", reference_of("weight"), [0.0, 0.0, 1.0]).stiffness(stiffness),
            )
            .step(swing(duration, count, [speed, 0.0, 0.0]));
        let run = run(model);
        let way = run.results().rigid_body("weight").unwrap().displacement.x;
        (way - speed / omega * (omega * duration).sin()).abs()
    });
}

#[test]
fn a_dashpot_damps_the_swing() {
    let (stiffness, damping, speed) = (8.0, 1.2, 0.3);
    let decay = damping / (2.0 * MASS);
    let omega = f64::sqrt(stiffness / MASS - decay * decay);
    assert_second_order(|count| {
        let duration = 1.3 * TAU / omega;
        let spring = spring_along("spring", reference_of("weight"), [1.0, 0.0, 0.0]);
        let model = with_block("A damped oscillator")
            .rigid(weight("weight", [0.0; 3]))
            .spring(spring.stiffness(stiffness).damping(damping))
            .step(swing(duration, count, [speed, 0.0, 0.0]));
        let run = run(model);
        let energies = run.state.energies;
        assert!(energies.imbalance().abs() < 1e-10, "{energies:?}");
        let way = run.results().rigid_body("weight").unwrap().displacement.x;
        let expected = speed / omega * (-decay * duration).exp() * (omega * duration).sin();
        (way - expected).abs()
    });
}

/// A weight on a spring goes round at a constant distance: `k (r - l) = m w^2 r`.
#[test]
fn a_weight_goes_round_on_a_spring() {
    let (stiffness, radius, omega) = (40.0, 1.0, 2.0);
    let length = radius - MASS * omega * omega * radius / stiffness;
    assert_second_order(|count| {
        let spring = spring_to_point("rod", reference_of("weight"), [0.0; 3]);
        let model = with_block("An orbit")
            .rigid(weight("weight", [radius, 0.0, 0.0]))
            .spring(spring.stiffness(stiffness).free_length(length))
            .step(swing(0.7 * TAU / omega, count, [0.0, 0.0, radius * omega]));
        let run = run(model);
        let way = run.results().rigid_body("weight").unwrap().displacement;
        let (sin, cos) = (0.7 * TAU).sin_cos();
        (way + Vec3::x() * radius - Vec3::new(cos, 0.0, sin) * radius).norm()
    });
}

/// A dashpot along the line between two ends resists no turn.
#[test]
fn a_dashpot_does_not_resist_turns() {
    let (stiffness, radius, omega) = (40.0, 1.0, 2.0);
    let length = radius - MASS * omega * omega * radius / stiffness;
    let spring = spring_to_point("rod", reference_of("weight"), [0.0; 3]);
    let spring = spring.stiffness(stiffness).free_length(length).damping(3.0);
    let model = with_block("A damped orbit")
        .rigid(weight("weight", [radius, 0.0, 0.0]))
        .spring(spring)
        .step(swing(TAU / omega, 200, [0.0, 0.0, radius * omega]));
    let run = run(model);
    let energies = run.state.energies;
    let start = 0.5 * MASS * (radius * omega).powi(2);
    assert!(
        (energies.kinetic - start).abs() < 1e-3 * start,
        "{energies:?}"
    );
    assert!(energies.inelastic < 1e-5 * start, "{energies:?}");
}
