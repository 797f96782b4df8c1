//! Tangent of contact with factors of friction, by healing and of one's own.

use striae_contact::{pair::Enforcement, unknowns::Status};
use striae_law::friction::{
    DualNum, FactorLane, FactorLaw, FactorPoint, FactorRange, Friction, Healing, HealingCourse,
    OwnFactor, PressureDependence, RequiredTextures, SlipDependence, StateDependence,
};
use striae_model::Model;
use striae_solve::{assembly::StepContext, problem::Problem, state::State};

use crate::{
    oblique::{Formula, uniform},
    pair::{PairFunction, Wanted},
    placed::{bumps, of_bodies, of_rigid, on_rigid, two_blocks},
    scene::{coulomb, plane},
};

/// Time in which the slip came about.
const ELAPSED: f64 = 0.5;

/// Friction that depends on all that a factor may see, with a film that builds up under pressure
/// and wears off with slip.
#[derive(Debug)]
struct Film {
    textures: RequiredTextures,
}

impl FactorLaw for Film {
    fn name(&self) -> &str {
        "film"
    }

    fn range(&self) -> FactorRange {
        FactorRange::default()
    }

    fn required_textures(&self) -> RequiredTextures {
        self.textures
    }

    fn initial_state(&self) -> Vec<f64> {
        vec![0.4, 0.1]
    }

    fn state_after(&self, at: &FactorPoint, before: &[f64]) -> Vec<FactorLane> {
        let formed = at.pressure * 0.1 * at.elapsed;
        let film = (formed + before[0]) / (formed + at.slip() * 3.0 + 1.0);
        vec![film, at.slip_rate * (0.2 * at.elapsed) + before[1]]
    }

    fn factor(&self, at: &FactorPoint, state: &[FactorLane]) -> FactorLane {
        let place = 1.0 + 0.1 * (at.position.x + at.time).cos() + 0.2 * at.accumulated_slip;
        let rate = (-at.slip_rate * 2.0).exp() * 0.3 + 0.8;
        let pressed = (at.pressure * 0.1 + 1.0).sqrt().recip();
        let of_textures = match at.textures.both() {
            Some((a, b)) => {
                let turn = a.cross(&b).dot(&at.normal);
                a.dot(&b) * 0.2 + turn * turn * 0.3 + 1.0
            }
            None => FactorLane::from(1.0),
        };
        (state[0] * 0.5 + 0.7) * (state[1] * 0.1 + 1.0) * rate * pressed * of_textures * place
    }
}

fn film(friction: Friction, textures: RequiredTextures) -> Friction {
    let factor = OwnFactor::of(Film { textures }).expect("it is sound");
    let power = PressureDependence::power_law(0.8, 0.5, None).expect("in range");
    let run_in = SlipDependence::exponential(1.5, 0.2).expect("in range");
    let friction = friction.with_pressure(power).with_slip(run_in);
    friction.with_factor(factor).expect("it needs no others")
}

fn healing(friction: Friction, course: HealingCourse) -> Friction {
    let state = StateDependence::healing(Healing {
        course,
        slip_distance: 0.3,
        healing_time: 2.0,
        state: 0.7,
    });
    friction.with_state(state.expect("in range"))
}

fn frictions(of: &Friction) -> [Friction; 3] {
    let exponential = HealingCourse::Exponential {
        kinetic_over_static: 0.6,
    };
    let logarithmic = HealingCourse::Logarithmic { factor: 0.2 };
    [
        film(of.clone(), RequiredTextures::Any),
        healing(of.clone(), exponential),
        healing(of.clone(), logarithmic),
    ]
}

fn check(name: &str, model: &Model, on_bodies: bool) {
    for enforcement in [Enforcement::Weighted, Enforcement::Collocated] {
        let mut model = model.clone();
        model.pairs[0].enforcement = enforcement;
        let problem = Problem::new(model).unwrap();
        let state = State::undeformed(&problem);
        let context = StepContext::new(&problem, 0, &state);
        let found = (7..40).find_map(|seed| {
            let [start, now] = match on_bodies {
                true => of_bodies(&problem, seed),
                false => of_rigid(&problem, 0.1, seed),
            };
            let pair = PairFunction::new(&context, start, now, ELAPSED);
            let u = pair.found(Wanted::Slip)?;
            pair.statuses(&u)
                .contains(&Status::Slip)
                .then_some((pair, u))
        });
        let (pair, u) = found.expect("some node slips");
        pair.assert_order(&u, &format!("{name}, {enforcement:?}"));
    }
}

#[test]
fn between_two_curved_surfaces() {
    for friction in frictions(&coulomb(0.5)) {
        let model = two_blocks([1.0, 2.0], [2, 3], friction.clone());
        check(&format!("{:?}", friction.coefficient()), &model, true);
    }
}

#[test]
fn of_laws_with_a_direction() {
    let both = [Some(15.0), Some(70.0)];
    for (law, angles) in [
        (Formula::TwoTextures([0.2, 0.3, 2.0, 0.5]), both),
        (Formula::Associated([0.3, 0.15]), [Some(15.0), None]),
        (Formula::Nap([0.1, 0.3, 0.2]), [None, Some(70.0)]),
    ] {
        let inclined = plane([0.0, 0.0, 0.01], [0.02, -0.03, 1.0]);
        for (on, shape) in [("plane", inclined), ("facets", bumps(4, 0.1))] {
            for friction in frictions(&law.friction()) {
                let mut model = on_rigid(shape.clone());
                model.pairs[0].friction = friction;
                model.pairs[0].textures = angles.map(|angle| angle.map(uniform));
                check(&format!("{law:?} on {on}"), &model, false);
            }
        }
    }
}

#[test]
fn of_a_factor_that_sees_the_textures() {
    for formula in [None, Some(Formula::TwoTextures([0.2, 0.3, 2.0, 0.5]))] {
        let friction = formula.map_or_else(|| coulomb(0.4), |formula| formula.friction());
        let mut model = on_rigid(bumps(4, 0.1));
        model.pairs[0].friction = film(friction, RequiredTextures::Both);
        model.pairs[0].textures = [15.0, 70.0].map(|angle| Some(uniform(angle)));
        check("factor of both textures", &model, false);
    }
}
