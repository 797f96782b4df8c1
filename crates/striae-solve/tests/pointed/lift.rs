//! Rows that are lifted where their nodes would be too deep.

use striae_contact::lift::DEEP;
use striae_law::friction::Friction;
use striae_mesh::Vec3;
use striae_solve::{
    model::{Displacement, Model, Step},
    state::State,
};

use crate::scene::{Floor, Run, moved, standing, tilted};

const DIVISIONS: usize = 4;
const DEPTH: f64 = 0.05;

/// Turns the upper side of the level block to where it is if the block stands on its edge,
/// turned up by `degrees`, and presses it down.
fn turned(model: &Model, degrees: f64, increments: usize) -> Step {
    let press = moved(model, [0.0, 0.0, -DEPTH], increments);
    let [from, to] = [0.0, degrees].map(|degrees| tilted(degrees, DIVISIONS).mesh().unwrap());
    let hold = &press.displacements[0];
    let ways = hold.nodes.iter().map(|node| {
        let way = to.positions[node.index()] - from.positions[node.index()] - Vec3::z() * DEPTH;
        Displacement {
            nodes: vec![*node],
            components: [Some(way.x), Some(way.y), Some(way.z)],
            ..hold.clone()
        }
    });
    let displacements = ways.collect();
    Step {
        displacements,
        ..press
    }
}

/// A level block that is pressed down and tipped over its edge, by these angles one after
/// another.
fn tipped(floor: Floor, degrees: &[f64]) -> Run {
    let friction = Friction::coulomb(0.0).unwrap();
    let mut model = standing(tilted(0.0, DIVISIONS), &["zmin"], floor, friction);
    let steps = degrees.iter();
    model.steps = steps.map(|&degrees| turned(&model, degrees, 8)).collect();
    Run::completed(model)
}

fn lifted(state: &State) -> usize {
    let lifts = state.pairs[0].lifts.iter().flatten();
    lifts.filter(|lift| **lift > 0.0).count()
}

#[test]
fn no_pressed_edge_stays_deeper_than_rows_are_lifted_for() {
    // The facets sag at the edge of the block.
    for (floor, lowest) in [(Floor::Plane, 0.0), (Floor::Facets, -0.005)] {
        let run = tipped(floor, &[0.0, 25.0]);
        let (state, report) = run.last();
        assert!(lifted(state) > 0, "{floor:?}");
        assert!(report.mismatch < 1e-12, "{}", report.mismatch);
        let deepest = state
            .positions
            .iter()
            .map(|x| lowest - x.z)
            .fold(0.0, f64::max);
        // Facets of a quarter by a third.
        let size = (1.0 / (DIVISIONS * 3) as f64).sqrt();
        assert!(deepest < 1.02 * DEEP * size, "{floor:?}: {deepest}");
        let pressed = || run.nodes().iter().filter(|node| node.pressure > 0.0);
        assert!(pressed().count() > 0);
        assert!(pressed().all(|node| node.gap.abs() < 1e-9));
    }
}

#[test]
fn lifts_fade_as_facets_lie_down() {
    let run = tipped(Floor::Plane, &[0.0, 25.0, 0.0, 0.0]);
    let lifts: Vec<usize> = run.states.iter().map(lifted).collect();
    assert!(lifts.iter().any(|&count| count > 0), "{lifts:?}");
    assert_eq!(lifts.last(), Some(&0), "{lifts:?}");
    let level = tipped(Floor::Plane, &[0.0]);
    let [force, wanted] = [&run, &level].map(|run| run.last().1.sides[0].force);
    assert!((force - wanted).norm() < 1e-8 * wanted.norm(), "{force}");
}
