//! Tangent of contact with friction that depends on rate and state.

use striae_contact::pair::Enforcement;
use striae_law::friction::{
    Evolution, Friction, PressureDependence, RateAndState, SlipDependence, StateDependence,
};
use striae_model::Model;
use striae_solve::{assembly::StepContext, problem::Problem, state::State};

use crate::{
    oblique::{Formula, uniform},
    pair::PairFunction,
    placed::{bumps, of_bodies, of_rigid, on_rigid, two_blocks},
    scene::{coulomb, plane},
    table::STRONG,
};

/// Time in which the slip came about.
const ELAPSED: f64 = 0.5;

/// Friction whose state evolves over slips of about those of the tests.
fn creeping(friction: Friction, evolution: Evolution) -> Friction {
    let state = StateDependence::rate_and_state(RateAndState {
        evolution,
        direct_effect: 0.1,
        evolution_effect: 0.15,
        slip_rate: 0.1,
        slip_distance: 0.05,
        state: 0.5,
    });
    let power = PressureDependence::power_law(0.8, 0.5, None).expect("in range");
    let run_in = SlipDependence::exponential(1.5, 0.2).expect("in range");
    let friction = friction.with_pressure(power).with_slip(run_in);
    friction.with_state(state.expect("in range"))
}

/// Checks a model under pressures at which its springs suffice, and at which they are raised.
fn check(name: &str, model: &Model, on_bodies: bool) {
    for enforcement in [Enforcement::Weighted, Enforcement::Collocated] {
        for evolution in [Evolution::Ageing, Evolution::Slip] {
            let mut model = model.clone();
            let pair = &mut model.pairs[0];
            pair.enforcement = enforcement;
            pair.friction = creeping(pair.friction.clone(), evolution);
            let problem = Problem::new(model).unwrap();
            let state = State::undeformed(&problem);
            let context = StepContext::new(&problem, 0, &state);
            let [start, now] = match on_bodies {
                true => of_bodies(&problem, 11),
                false => of_rigid(&problem, 0.1, 11),
            };
            let pair = PairFunction::new(&context, start, now, ELAPSED);
            let pressed = [0.3, 30.0].map(|pressure| pair.crept(pressure));
            for u in pressed {
                pair.assert_order(&u, &format!("{name}, {enforcement:?}, {evolution:?}"));
            }
        }
    }
}

#[test]
fn between_two_curved_surfaces() {
    let model = two_blocks([1.0, 2.0], [2, 3], coulomb(0.5));
    check("two blocks", &model, true);
}

#[test]
fn of_laws_with_a_direction() {
    let both = [Some(15.0), Some(70.0)];
    for (law, angles) in [
        (Formula::TwoTextures([0.2, 0.3, 2.0, 0.5]), both),
        (Formula::Opposing([0.3, 0.15]), [None, Some(70.0)]),
        (Formula::Associated([0.3, 0.15]), [Some(15.0), None]),
        (Formula::Associated([0.3, 0.15]), [None, Some(70.0)]),
        (Formula::Nap([0.1, 0.3, 0.2]), [Some(15.0), None]),
        (Formula::Tabulated(STRONG), [None, Some(70.0)]),
    ] {
        let inclined = plane([0.0, 0.0, 0.01], [0.02, -0.03, 1.0]);
        for (on, shape) in [("plane", inclined), ("facets", bumps(4, 0.1))] {
            let mut model = on_rigid(shape);
            model.pairs[0].friction = law.friction();
            model.pairs[0].textures = angles.map(|angle| angle.map(uniform));
            check(&format!("{law:?} on {on}"), &model, false);
        }
    }
}
