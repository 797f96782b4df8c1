//! Factors of one's own: what they see, states of their own, endings where they are not sound.

use rayon::ThreadPoolBuilder;
use striae_law::friction::{
    DualNum, FactorLane, FactorLaw, FactorPoint, FactorRange, Friction, Healing, HealingCourse,
    OwnFactor, StateDependence,
};
use striae_solve::{outcome::Ending, state::State};

use crate::{
    blocks::{force, uniform},
    scene::{Run, coulomb},
};

const MU: f64 = 0.3;
const PRESSURE: f64 = 0.02;
const SPEED: f64 = 0.15;
/// Duration of the step in which the block slides.
const TIME: f64 = 2.0;

type Function = fn(&FactorPoint, &[FactorLane]) -> FactorLane;
/// Factor over the time since slip began.
type Course = fn(f64) -> f64;

/// A law of a function, with the slip and the time of contact for states.
#[derive(Debug)]
struct Of(Function);

impl FactorLaw for Of {
    fn name(&self) -> &str {
        "of-a-function"
    }

    fn range(&self) -> FactorRange {
        FactorRange {
            pressure: 0.1,
            slip_rate: 0.3,
            ..FactorRange::default()
        }
    }

    fn initial_state(&self) -> Vec<f64> {
        vec![0.0, 0.0]
    }

    fn state_after(&self, at: &FactorPoint, before: &[f64]) -> Vec<FactorLane> {
        vec![
            at.slip() + before[0],
            FactorLane::from(at.elapsed + before[1]),
        ]
    }

    fn factor(&self, at: &FactorPoint, state: &[FactorLane]) -> FactorLane {
        (self.0)(at, state)
    }
}

fn of(function: Function) -> Friction {
    let factor = OwnFactor::of(Of(function)).unwrap();
    coulomb(MU).with_factor(factor).unwrap()
}

/// Friction over that of the stated coefficient in every increment of slip.
fn factors(run: &Run) -> Vec<f64> {
    let of = |state: &State| force(run, state)[0] / (MU * PRESSURE);
    run.states[2..].iter().map(of).collect()
}

#[test]
fn a_factor_sees_pressure_rate_time_and_its_states() {
    let laws: [(Function, Course); 5] = [
        (
            |at, _| (at.pressure * 10.0 + 1.0).sqrt().recip(),
            |_| 1.0 / (10.0 * PRESSURE + 1.0).sqrt(),
        ),
        (
            |at, _| (-at.slip_rate * 4.0).exp() * 0.4 + 0.6,
            |_| 0.4 * (-4.0 * SPEED).exp() + 0.6,
        ),
        (
            |at, _| FactorLane::from(1.0 + 0.25 * at.time),
            |time| 1.0 + 0.25 * (1.0 + time),
        ),
        (
            |_, state| (-state[0] * 3.0).exp() * 0.4 + 0.6,
            |time| 0.4 * (-3.0 * SPEED * time).exp() + 0.6,
        ),
        (
            |_, state| state[1] * 0.1 + 1.0,
            |time| 1.0 + 0.1 * (1.0 + time),
        ),
    ];
    for (at, (function, expected)) in laws.into_iter().enumerate() {
        let run = Run::completed(uniform(PRESSURE, SPEED, of(function)));
        let found = factors(&run);
        for (k, factor) in found.iter().enumerate() {
            let expected = expected(TIME * (k + 1) as f64 / found.len() as f64);
            let error = (factor / expected - 1.0).abs();
            assert!(error < 1e-9, "{at}, {k}: {factor}, not {expected}");
        }
    }
}

#[test]
fn a_factor_sees_the_slip_and_the_place_up_to_the_increment() {
    let slip = Run::completed(uniform(
        PRESSURE,
        SPEED,
        of(|at, _| FactorLane::from(1.0 + at.accumulated_slip)),
    ));
    let found = factors(&slip);
    for (k, factor) in found.iter().enumerate() {
        let before = SPEED * TIME * k as f64 / found.len() as f64;
        assert!(
            (factor / (1.0 + before) - 1.0).abs() < 1e-9,
            "{k}: {factor}"
        );
    }
    // The mean of `1 + x` over a block from 0 to 1 that has moved.
    let place = Run::completed(uniform(
        PRESSURE,
        SPEED,
        of(|at, _| FactorLane::from(1.0 + at.position.x)),
    ));
    let found = factors(&place);
    for (k, factor) in found.iter().enumerate() {
        let before = 0.8 * SPEED * TIME * k as f64 / found.len() as f64;
        assert!(
            (factor / (1.5 + before) - 1.0).abs() < 1e-9,
            "{k}: {factor}"
        );
    }
}

/// The constants of healing as a law of one's own.
#[derive(Debug)]
struct Same(Healing);

impl FactorLaw for Same {
    fn name(&self) -> &str {
        "same"
    }

    fn range(&self) -> FactorRange {
        FactorLaw::range(&self.0)
    }

    fn initial_state(&self) -> Vec<f64> {
        FactorLaw::initial_state(&self.0)
    }

    fn state_after(&self, at: &FactorPoint, before: &[f64]) -> Vec<FactorLane> {
        FactorLaw::state_after(&self.0, at, before)
    }

    fn factor(&self, at: &FactorPoint, state: &[FactorLane]) -> FactorLane {
        FactorLaw::factor(&self.0, at, state)
    }
}

#[test]
fn healing_as_a_law_of_ones_own_gives_the_same_bits() {
    let law = Healing {
        course: HealingCourse::Exponential {
            kinetic_over_static: 0.5,
        },
        slip_distance: 0.1,
        healing_time: 1.0,
        state: 1.0,
    };
    let state = StateDependence::healing(law).unwrap();
    let own = OwnFactor::of(Same(law)).unwrap();
    let [named, own] = [
        coulomb(MU).with_state(state),
        coulomb(MU).with_factor(own).unwrap(),
    ]
    .map(|friction| Run::completed(uniform(PRESSURE, SPEED, friction)));
    for (one, other) in named.states.iter().zip(&own.states) {
        assert_eq!(one.positions, other.positions);
        assert_eq!(one.pairs[0].tractions.nodes, other.pairs[0].tractions.nodes);
    }
}

#[test]
fn any_number_of_threads_gives_the_same_bits() {
    let run = |threads: usize| {
        let pool = ThreadPoolBuilder::new().num_threads(threads).build();
        let friction = of(|at, state| {
            let rate = (-at.slip_rate * 4.0).exp() * 0.4 + 0.6;
            rate * ((-state[0]).exp() + at.position.y.sin() + 1.0)
        });
        pool.unwrap()
            .install(|| Run::of(uniform(PRESSURE, SPEED, friction)))
    };
    let [one, two] = [1, 2].map(run);
    assert!(matches!(one.ending, Ending::Completed), "{:?}", one.ending);
    for (one, two) in one.states.iter().zip(&two.states) {
        assert_eq!(one.positions, two.positions);
        assert_eq!(one.pairs[0].tractions, two.pairs[0].tractions);
    }
}

#[test]
fn a_factor_that_comes_to_be_negative_ends_the_run_by_its_name() {
    // Within the range of the law, up to the time 1, it is positive.
    let run = Run::of(uniform(
        PRESSURE,
        SPEED,
        of(|at, _| FactorLane::from(2.0 - at.time)),
    ));
    let Ending::Stopped { reason, time, .. } = &run.ending else {
        panic!("{:?}", run.ending);
    };
    assert!(*time > 1.9 && *time <= 2.0, "{time}");
    let told = reason.to_string();
    assert!(
        told.contains("factor of friction `of-a-function`: it is -") && told.contains("the time"),
        "{told}"
    );
}
