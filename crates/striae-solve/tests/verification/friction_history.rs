//! Friction that is switched on, off and on again between steps starts from zero.
//!
//! Friction is an unknown that refers to the positions at the end of the last increment. Without
//! friction it vanishes, and the bodies relax; later friction starts without traction at the
//! positions of rest.

use crate::scene::{
    Places, Run, block, body, coulomb, increments, largest_distance, model, plane, rubber, step,
};
use striae_contact::unknowns::Status;
use striae_law::{
    bulk::{LameConstants, Material},
    friction::Friction,
};
use striae_mesh::Vec3;
use striae_model::{Model, PairId, Step, Strategy};
use striae_solve::{
    report::{PairReport, pairs},
    state::State,
};

const STRATEGIES: [Strategy; 2] = [
    Strategy::Semismooth,
    Strategy::Table1 {
        stick_tolerance: 1e-12,
    },
];
/// Coefficient of friction of steps with it and without it.
const ON: f64 = 0.3;
const OFF: f64 = 0.0;
const SHEAR_MODULUS: f64 = 0.5;
const HEIGHT: f64 = 0.25;
const DEPTH: f64 = 0.025;
/// `E A w/H`, as Poisson's ratio is zero.
const NORMAL_FORCE: f64 = 2.0 * SHEAR_MODULUS * DEPTH / HEIGHT;
/// `G A/H`, of a layer that sticks as a whole.
const STIFFNESS: f64 = SHEAR_MODULUS / HEIGHT;

/// A step that moves the upper side of a body along `x` with a coefficient of friction.
fn way(model: &Model, body: &str, x: f64, mu: f64) -> Step {
    let friction = if mu == OFF {
        Friction::frictionless()
    } else {
        coulomb(mu)
    };
    let mut way = step();
    way.displacements = vec![model.hold(body, "zmax", [Some(x), None, None])];
    way.frictions = vec![(PairId(0), friction)];
    way.increments = increments(0.25, 0.1);
    way
}

/// One layer of elements between a prescribed side and a plane: while it sticks
/// every node is where it is made to be, and the strains are homogeneous.
fn layer(strategy: Strategy, ways: &[(f64, f64)]) -> Model {
    let constants = LameConstants::from_youngs_modulus(2.0 * SHEAR_MODULUS, 0.0);
    let material = Material::linear_elastic(constants.unwrap());
    let mesh = block([0.0; 3], [1.0, 1.0, HEIGHT], [3, 3, 1]).mesh();
    let mut model = model(vec![body("block", mesh.unwrap(), material)]);
    model.touch_rigid(
        ("block", "zmin"),
        plane([0.0; 3], [0.0, 0.0, 1.0]),
        Friction::frictionless(),
    );
    let mut press = step();
    press.displacements = vec![model.hold("block", "zmax", [Some(0.0), Some(0.0), Some(-DEPTH)])];
    model.steps = vec![press];
    for (x, mu) in ways {
        let way = way(&model, "block", *x, *mu);
        model.steps.push(way);
    }
    model.solver.strategy = strategy;
    model.solver.largest_iterations = 30;
    model
}

/// The pair at the end of a way, counted from 0.
fn at_end_of(run: &Run, way: usize) -> PairReport {
    let state = &run.states[1 + 4 * (way + 1)];
    pairs(&run.problem, state).swap_remove(0)
}

#[test]
fn stick_starts_from_the_place_where_friction_comes_back() {
    for strategy in STRATEGIES {
        let ways = [
            (0.010, OFF),
            (0.018, ON),
            (0.018, OFF),
            (0.018, ON),
            (0.021, ON),
            (0.016, ON),
        ];
        let run = Run::completed(layer(strategy, &ways));
        // From where the layer last rested without friction.
        let sheared = [0.0, 0.008, 0.0, 0.0, 0.003, -0.002];
        for (index, way) in sheared.into_iter().enumerate() {
            let report = at_end_of(&run, index);
            let force = report.sides[0].force;
            let expected = Vec3::new(-STIFFNESS * way, 0.0, NORMAL_FORCE);
            let error = (force - expected).norm() / NORMAL_FORCE;
            assert!(error < 1e-9, "way {index}: {force} instead of {expected}");
            assert_eq!(report.dissipated, 0.0);
            let counts = if ways[index].1 == OFF {
                (0, 16)
            } else {
                (16, 0)
            };
            assert_eq!((report.stick, report.slip), counts);
        }
    }
}

#[test]
fn slip_before_leaves_no_traction_behind() {
    for strategy in STRATEGIES {
        let ways = [(0.08, ON), (0.08, OFF), (0.076, ON), (0.0, ON), (0.0, OFF)];
        let run = Run::completed(layer(strategy, &ways));
        let report = |way: usize| at_end_of(&run, way);
        let along = |way: usize| report(way).sides[0].force.x / NORMAL_FORCE;
        let expected = [-ON, 0.0, STIFFNESS * 0.004 / NORMAL_FORCE, ON, 0.0];
        for (index, expected) in expected.into_iter().enumerate() {
            let found = along(index);
            assert!(
                (found - expected).abs() < 1e-9,
                "way {index}: {found}, {expected}"
            );
        }
        // All of the layer slides along in the last increments.
        let dissipated = |state: usize| run.states[state].pairs[0].dissipated;
        for (last, way) in [(5, 0.02), (17, 0.019)] {
            let work = dissipated(last) - dissipated(last - 1);
            assert!((work / (ON * NORMAL_FORCE * way) - 1.0).abs() < 1e-9);
        }
        // Neither relaxing nor sticking dissipates.
        assert_eq!(report(1).dissipated, report(0).dissipated);
        assert!((report(2).dissipated / report(0).dissipated - 1.0).abs() < 1e-12);
        assert_eq!(report(4).dissipated, report(3).dissipated);
    }
}

/// Two blocks with meshes that do not match, which part of the way slip.
fn blocks(strategy: Strategy, before: f64) -> Model {
    let lower = block([0.0; 3], [1.0, 1.0, 0.5], [4, 4, 2]).mesh().unwrap();
    let upper = block([0.2, 0.2, 0.5], [0.6, 0.6, 0.5], [3, 3, 2]).mesh();
    let mut model = model(vec![
        body("lower", lower, rubber(10.0, 0.3)),
        body("upper", upper.unwrap(), rubber(1.0, 0.3)),
    ]);
    model.touch(
        ("lower", "zmax"),
        ("upper", "zmin"),
        Friction::frictionless(),
    );
    let mut press = step();
    press.displacements = vec![
        model.hold("lower", "zmin", [Some(0.0); 3]),
        model.hold("upper", "zmax", [Some(0.0), Some(0.0), Some(-0.02)]),
    ];
    // Friction of `mu` times the pressure shears the upper block by
    // `mu (H/G) E w/H = 2 (1 + nu) mu w`, 0.0156: about there a part slips.
    let way = 2.0 * (1.0 + 0.3) * ON * 0.02;
    let ways = [(way, before), (way, OFF), (2.0 * way, ON)];
    model.steps = vec![press];
    for (x, mu) in ways {
        let next = self::way(&model, "upper", x, mu);
        model.steps.push(next);
    }
    model.solver.strategy = strategy;
    model.solver.largest_iterations = 30;
    model
}

#[test]
fn what_comes_after_a_step_without_friction_knows_nothing_of_friction_before() {
    for strategy in STRATEGIES {
        let never = Run::completed(blocks(strategy, OFF));
        let before = Run::completed(blocks(strategy, ON));
        let apart = |state: usize| {
            let [a, b] = [&never, &before].map(|run| &run.states[state]);
            largest_distance(&a.positions, &b.positions)
        };
        assert!(apart(5) > 1e-3, "friction makes a difference at first");
        let count = |state: &State, status: Status| {
            let nodes = state.pairs[0].nodes.iter().flatten();
            nodes.filter(|node| node.status == status).count()
        };
        for status in [Status::Stick, Status::Slip] {
            assert!(count(&before.states[5], status) > 0 && count(before.last(), status) > 0);
        }
        for state in 9..never.states.len() {
            assert!(apart(state) < 1e-9, "state {state}: {:.1e}", apart(state));
            let nodes =
                [&never, &before].map(|run| run.states[state].pairs[0].nodes.iter().flatten());
            let [a, b] = nodes;
            for (a, b) in a.zip(b) {
                assert!((a.tau - b.tau).norm() < 1e-8, "{} {}", a.tau, b.tau);
                assert_eq!(a.status, b.status, "state {state}");
            }
        }
    }
}
