//! The strategy of the paper's Table 1 beside the default one.

use crate::scene::{Places, Run, block, increments, largest_distance, pressed_on_plane, step};
use striae_contact::unknowns::Status;
use striae_model::{Model, Strategy};

const MU: f64 = 0.3;

/// A tall block pressed on a plane, sheared until it slides, and back.
fn sheared(strategy: Strategy) -> Model {
    let mesh = block([0.0; 3], [1.0, 1.0, 1.0], [4, 3, 3]).mesh().unwrap();
    let mut model = pressed_on_plane(mesh, MU);
    let way = |model: &Model, x: f64, y: f64| {
        let mut way = step();
        way.displacements = vec![model.hold("block", "zmax", [Some(x), Some(y), None])];
        way.increments = increments(0.25, 0.01);
        way
    };
    let ways = [(0.04, 0.01), (0.02, 0.01)].map(|(x, y)| way(&model, x, y));
    model.steps.extend(ways);
    model.solver.strategy = strategy;
    model.solver.largest_iterations = 30;
    model
}

fn strict(stick_tolerance: f64) -> Strategy {
    Strategy::Table1 { stick_tolerance }
}

fn count(run: &Run, state: usize, status: Status) -> usize {
    let nodes = run.states[state].pairs[0].nodes[0].iter();
    nodes.filter(|node| node.status == status).count()
}

#[test]
fn a_strict_predictor_and_corrector_finds_the_state_of_the_default() {
    let default = Run::completed(sheared(Strategy::Semismooth));
    let paper = Run::completed(sheared(strict(1e-12)));
    assert!(default.cuts.is_empty() && paper.cuts.is_empty());
    let statuses = |status| (0..default.states.len()).any(|s| count(&default, s, status) > 0);
    assert!(statuses(Status::Stick) && statuses(Status::Slip));
    for (state, (ours, theirs)) in default.states.iter().zip(&paper.states).enumerate() {
        let apart = largest_distance(&ours.positions, &theirs.positions);
        assert!(apart < 1e-9, "state {state}: {apart:.1e}");
    }
}

#[test]
fn a_sticking_node_exceeds_the_law_by_the_tolerance_at_most() {
    for tolerance in [0.01, 0.1] {
        let run = Run::completed(sheared(strict(tolerance)));
        let mut largest = 0.0_f64;
        for state in &run.states[1..] {
            for node in &state.pairs[0].nodes[0] {
                let limit = MU * node.pressure.max(0.0);
                if node.status == Status::Slip {
                    assert!((node.tau.norm() - limit).abs() < 1e-9);
                } else {
                    largest = largest.max(node.tau.norm() / limit - 1.0);
                }
            }
        }
        assert!(largest < tolerance * (1.0 + 1e-9), "{largest}");
    }
}
