//! Tangent of contact whose gaps open by wear, in nodes of every status.

use striae_contact::{side::Side, unknowns::Status};
use striae_model::Model;
use striae_solve::{assembly::StepContext, problem::Problem, state::State};
use striae_verify::Random;

use crate::{
    oblique::uniform,
    pair::{PairFunction, Places, Wanted},
    placed::{dome, of_bodies, of_pieces, of_rigid, on_rigid, two_blocks, two_pieces},
    scene::{coulomb, plane},
};

/// Depths per pressure and slip, which wear off some hundredths of a facet in the increment.
const WEAR: [f64; 2] = [0.4, 0.15];

/// Asserts the order of central differences where some nodes have each status.
fn assert_order(
    mut model: Model,
    statuses: &[Status],
    places: impl Fn(&Problem, u64) -> [Places; 2],
    name: &str,
) {
    model.pairs[0].wear = WEAR;
    let problem = Problem::new(model).unwrap();
    let state = State::undeformed(&problem);
    let context = StepContext::new(&problem, 0, &state);
    let found = (7..60).find_map(|seed| {
        let [start, now] = places(&problem, seed);
        let mut pair = PairFunction::new(&context, start, now, 0.5);
        let mut random = Random::new(seed);
        pair.selection.worn = Side::BOTH.map(|side| {
            let nodes = 0..pair.selection.nodes(side);
            nodes.map(|_| random.uniform(0.0, 0.005)).collect()
        });
        let wanted = match statuses.len() {
            1 => Wanted::Slip,
            _ => Wanted::Mixed,
        };
        let u = pair.found(wanted)?;
        let found = pair.statuses(&u);
        let has_all = statuses.iter().all(|status| found.contains(status));
        has_all.then_some((pair, u))
    });
    let (pair, u) = found.expect("nodes of every status");
    pair.assert_order(&u, name);
}

const EVERY: [Status; 3] = [Status::Open, Status::Stick, Status::Slip];

#[test]
fn of_two_bodies() {
    for divisions in [[3, 3], [2, 4], [4, 3]] {
        let model = two_blocks([1.0, 2.0], divisions, coulomb(0.5));
        assert_order(model, &EVERY, of_bodies, &format!("{divisions:?}"));
    }
}

#[test]
fn on_rigid_surfaces() {
    let inclined = plane([0.0, 0.0, 0.01], [0.02, -0.03, 1.0]);
    for (name, shape, bump) in [("plane", inclined, 0.02), ("dome", dome(4), 0.1)] {
        let places = |problem: &Problem, seed| of_rigid(problem, bump, seed);
        assert_order(on_rigid(shape), &EVERY, places, name);
    }
}

#[test]
fn of_a_surface_that_touches_itself() {
    let divisions: [usize; 2] = [4, 3];
    let first_of_second = 2 * (divisions[0] + 1).pow(2);
    let places = |problem: &Problem, seed| of_pieces(problem, first_of_second, seed);
    let model = two_pieces(divisions, coulomb(0.5));
    assert_order(model, &EVERY[2..], places, "one surface");
}

/// Wear that is less or more across grooves than along them, of either side, whose directions turn
/// with the surfaces.
#[test]
fn across_textures() {
    for (sides, ratio) in [([Some(15.0), Some(70.0)], 3.0), ([None, Some(40.0)], 0.3)] {
        let directed = |mut model: Model| {
            model.pairs[0].textures = sides.map(|angle| angle.map(uniform));
            model.pairs[0].wear_across = ratio;
            model
        };
        let model = directed(two_blocks([1.0, 2.0], [3, 3], coulomb(0.5)));
        assert_order(model, &EVERY, of_bodies, &format!("bodies, {ratio}"));
        let places = |problem: &Problem, seed| of_rigid(problem, 0.1, seed);
        let model = directed(on_rigid(dome(4)));
        assert_order(model, &EVERY, places, &format!("dome, {ratio}"));
    }
}
