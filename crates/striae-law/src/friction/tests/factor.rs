//! Factors of one's own, and how they are judged.

use num_dual::DualNum;

use super::laws_of_all_kinds;
use crate::friction::{
    Factor, FactorBatch, FactorFailure, FactorLane, FactorLaw, FactorPoint, FactorPoints,
    FactorRange, Friction, FrictionError, LARGEST_STATE, OwnFactor, RequiredTextures, Violation,
    battery,
};

type Function = fn(&FactorPoint, &[FactorLane]) -> FactorLane;
/// `true` for the violation that is expected.
type Expected = fn(&Violation) -> bool;
type Update = fn(&FactorPoint, &[f64]) -> Vec<FactorLane>;

/// A law of functions.
#[derive(Debug)]
struct Made {
    factor: Function,
    start: Vec<f64>,
    update: Update,
    textures: RequiredTextures,
}

impl FactorLaw for Made {
    fn name(&self) -> &str {
        "made"
    }

    fn range(&self) -> FactorRange {
        FactorRange {
            pressure: 10.0,
            slip_rate: 2.0,
            ..FactorRange::default()
        }
    }

    fn required_textures(&self) -> RequiredTextures {
        self.textures
    }

    fn initial_state(&self) -> Vec<f64> {
        self.start.clone()
    }

    fn state_after(&self, at: &FactorPoint, before: &[f64]) -> Vec<FactorLane> {
        (self.update)(at, before)
    }

    fn factor(&self, at: &FactorPoint, state: &[FactorLane]) -> FactorLane {
        (self.factor)(at, state)
    }
}

fn of(factor: Function) -> Made {
    Made {
        factor,
        start: Vec::new(),
        update: |_, _| Vec::new(),
        textures: RequiredTextures::Any,
    }
}

fn with_state(start: f64, update: Update, factor: Function) -> Made {
    Made {
        start: vec![start],
        update,
        ..of(factor)
    }
}

fn judged(law: Made) -> Vec<Violation> {
    let friction = Friction::coulomb(0.4).unwrap();
    battery(&friction.with_factor(OwnFactor::of(law).unwrap()).unwrap())
}

fn film(at: &FactorPoint, before: &[f64]) -> Vec<FactorLane> {
    vec![(-at.slip() / 0.3).exp() * (before[0] - 1.0) + 1.0]
}

/// Junctions that form in the time 0.5 under pressure and break over the slip 0.2, by one step of
/// the implicit Euler method.
fn junctions(at: &FactorPoint, before: &[f64]) -> Vec<FactorLane> {
    let formed = at.pressure / 10.0 * (at.elapsed / 0.5);
    vec![(formed + before[0]) / (formed + at.slip() / 0.2 + 1.0)]
}

fn seen(at: &FactorPoint, state: &[FactorLane]) -> FactorLane {
    let warm = FactorLane::from(1.0 + 0.3 * at.position.x * at.time + 0.2 * at.accumulated_slip);
    let rate = (-at.slip_rate / 0.5).exp() * 0.3 + 0.7;
    let pressed = (at.pressure / 5.0 + 1.0).sqrt().recip();
    (state[0] * 0.5 + 0.5) * warm * rate * pressed
}

#[test]
fn sound_factors_pass_the_battery_in_all_laws() {
    for friction in laws_of_all_kinds() {
        for update in [film as Update, junctions] {
            let factor = OwnFactor::of(with_state(0.5, update, seen)).unwrap();
            let friction = friction.clone().with_factor(factor).unwrap();
            assert_eq!(battery(&friction), [], "{:?}", friction.law());
            assert!(friction.depends_on_rate() && friction.weakens());
        }
    }
}

#[test]
fn a_factor_of_both_textures_passes_the_battery() {
    let crossed = Made {
        textures: RequiredTextures::Both,
        ..of(|at, _| {
            let (a, b) = at.textures.both().expect("both have a texture");
            let turn = a.cross(&b).dot(&at.normal);
            a.dot(&b) * 0.2 + turn * turn * 0.1 + 1.0
        })
    };
    let friction = Friction::coulomb(0.4).unwrap();
    let factor = OwnFactor::of(crossed).unwrap();
    let friction = friction.with_factor(factor.clone()).unwrap();
    assert_eq!(friction.required_textures(), RequiredTextures::Both);
    assert_eq!(battery(&friction), []);
    let orthotropic = Friction::nap(0.1, 0.3, 0.2).unwrap();
    let refused = orthotropic.with_factor(factor).unwrap_err();
    assert!(matches!(refused, FrictionError::FactorTextures { .. }));
}

#[test]
fn negative_and_infinite_factors_are_refused_when_they_are_made() {
    let laws: [Function; 3] = [
        |at, _| -at.pressure + 5.0,
        |at, _| at.slip_rate.ln() + 40.0,
        |at, _| (at.slip_rate - 0.5).sqrt() + 1.0,
    ];
    for law in laws {
        let refused = OwnFactor::of(of(law)).unwrap_err();
        assert!(
            refused
                .to_string()
                .starts_with("factor of friction `made`: it is "),
            "{refused}"
        );
    }
    let long = Made {
        start: vec![0.0; LARGEST_STATE + 1],
        ..of(|_, _| FactorLane::from(1.0))
    };
    assert!(OwnFactor::of(long).is_err());
}

#[test]
fn the_battery_says_what_is_wrong_with_a_factor() {
    let wrong: [(Made, Expected); 9] = [
        (
            of(|at, _| FactorLane::from(if at.pressure.re > 4.0 { 1.5 } else { 1.0 })),
            |found| {
                matches!(found, Violation::FactorJumps { by: "pressure", value, change, .. }
                if (value - 4.0).abs() < 1e-9 && (change - 0.5).abs() < 1e-9)
            },
        ),
        (
            of(|at, _| FactorLane::from(if at.slip_rate.re > 0.02 { 0.5 } else { 1.0 })),
            |found| {
                matches!(found, Violation::FactorJumps { by: "slip rate", value, .. }
                if (value - 0.02).abs() < 1e-9)
            },
        ),
        (
            of(|at, _| (at.pressure * at.pressure + 1.0).recip()),
            |found| matches!(found, Violation::FactorFallsWithPressure(_)),
        ),
        (
            of(|at, _| match at.slip_rate.re > 0.0 {
                true => FactorLane::from(0.7),
                false => FactorLane::from(1.0),
            }),
            |found| matches!(found, Violation::FactorSteepAtRest(_)),
        ),
        (
            Made {
                textures: RequiredTextures::One,
                ..of(|at, _| {
                    let a = at.textures.only().expect("one has a texture");
                    a.x * 0.2 + 1.0
                })
            },
            |found| matches!(found, Violation::FactorSides(_)),
        ),
        (
            of(|at, _| FactorLane::from(1.0 + 0.1 * at.pressure.re)),
            |found| matches!(found, Violation::FactorDerivative(_)),
        ),
        (
            with_state(
                0.0,
                |_, before| vec![FactorLane::from(0.5 * (before[0] + 1.0))],
                seen,
            ),
            |found| matches!(found, Violation::FactorState(_)),
        ),
        (
            with_state(
                0.0,
                |at, before| vec![FactorLane::from(before[0] + at.elapsed.sqrt())],
                seen,
            ),
            |found| matches!(found, Violation::FactorState(_)),
        ),
        (
            with_state(0.0, |_, _| vec![FactorLane::from(1.0)], seen),
            |found| matches!(found, Violation::FactorStateJumps(_)),
        ),
    ];
    for (at, (law, expected)) in wrong.into_iter().enumerate() {
        let found = judged(law);
        assert!(found.iter().any(expected), "{at}: {found:?}");
        for violation in found {
            assert!(violation.to_string().len() > 30);
        }
    }
}

/// A law that fails.
#[derive(Debug)]
struct Failing;

impl FactorBatch for Failing {
    fn name(&self) -> &str {
        "failing"
    }

    fn range(&self) -> FactorRange {
        FactorRange::default()
    }

    fn initial_state(&self) -> Vec<f64> {
        Vec::new()
    }

    fn factors(&self, _: &FactorPoints) -> Result<Vec<Factor>, FactorFailure> {
        Ok(Vec::new())
    }

    fn states_after(&self, _: &FactorPoints) -> Result<Vec<f64>, FactorFailure> {
        Ok(Vec::new())
    }
}

#[test]
fn answers_for_other_points_are_refused() {
    let refused = OwnFactor::new(Failing).unwrap_err().to_string();
    assert!(refused.contains("`failing`: 0 values for "), "{refused}");
}

#[test]
fn the_course_of_a_factor_is_found_in_samples() {
    let falling = OwnFactor::of(of(|at, _| (-at.slip() / 0.3).exp() * 0.4 + 0.6)).unwrap();
    let friction = Friction::coulomb(0.4).unwrap();
    let friction = friction.with_factor(falling.clone()).unwrap();
    assert!(friction.weakens() && friction.depends_on_rate());
    assert!((falling.steepest_fall() - 0.4 / 0.3).abs() < 1e-12);
    let constant = OwnFactor::of(of(|at, _| FactorLane::from(1.0 + at.position.x.abs()))).unwrap();
    let friction = Friction::coulomb(0.4)
        .unwrap()
        .with_factor(constant)
        .unwrap();
    assert!(!friction.weakens() && !friction.depends_on_rate());
}
