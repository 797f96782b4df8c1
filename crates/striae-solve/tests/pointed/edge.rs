//! Forces of an edge that is pressed onto a face.

use striae_contact::unknowns::Status;
use striae_law::friction::{Friction, SlipRule};
use striae_mesh::Vec3;
use striae_surface::texture::{Field, Lines, Paint};

use crate::scene::{Floor, Run, moved, standing, tilted};

const SOLE: &[&str] = &["zmin", "xmin"];
const FLOORS: [Floor; 3] = [Floor::Soft, Floor::Plane, Floor::Facets];

fn coulomb(mu: f64) -> Friction {
    Friction::coulomb(mu).unwrap()
}

fn pressed(degrees: f64, divisions: usize, floor: Floor, depth: f64, increments: usize) -> Run {
    let mut model = standing(tilted(degrees, divisions), SOLE, floor, coulomb(0.3));
    model.steps = vec![moved(&model, [0.0, 0.0, -depth], increments)];
    Run::completed(model)
}

#[test]
fn an_edge_is_felt_and_forces_balance() {
    for floor in FLOORS {
        let run = pressed(33.0, 4, floor, 0.05, 4);
        let (_, report) = run.last();
        assert!(report.sides[0].force.z > 1e-3, "{:?}", report.sides[0]);
        assert!(report.mismatch < 1e-12, "{}", report.mismatch);
        assert!(run.pointed() > 0);
    }
}

#[test]
fn force_grows_continuously_from_the_depth_at_which_an_edge_is_felt() {
    let run = pressed(33.0, 4, Floor::Plane, 0.05, 25);
    let forces: Vec<f64> = run.reports.iter().map(|r| r.sides[0].force.z).collect();
    let last = forces[forces.len() - 1];
    // Facets of a quarter in steps of 0.002: the dead zone ends below 0.02 of one.
    assert!(forces[2] > 0.0, "{forces:?}");
    for pair in forces.windows(2).skip(2) {
        let growth = (pair[1] - pair[0]) / last;
        assert!(growth > 0.0 && growth < 0.1, "{growth} in {forces:?}");
    }
    assert!(forces[2] < 0.15 * last, "{forces:?}");
}

#[test]
fn an_edge_that_is_lifted_out_of_sight_needs_no_texture() {
    let friction = Friction::orthotropic(0.2, 0.5, SlipRule::Associated).unwrap();
    let mut model = standing(tilted(33.0, 4), SOLE, Floor::Facets, friction);
    model.pairs[0].textures[1] = Some(Paint::Field(Field {
        lines: Lines::Uniform(Vec3::new(0.8, 0.6, 0.0)),
        turn: 0.0,
    }));
    let mut lift = moved(&model, [0.0, 0.0, 2.0], 1);
    lift.increments.smallest = 1.0;
    model.steps = vec![moved(&model, [0.0, 0.0, -0.05], 4), lift];
    let run = Run::completed(model);
    assert!(run.reports[3].sides[0].force.z > 1e-3);
    assert_eq!(run.last().1.sides[0].force.z, 0.0);
}

#[test]
fn force_converges_with_the_mesh() {
    let force = |divisions| {
        let run = pressed(33.0, divisions, Floor::Plane, 0.04, 4);
        run.last().1.sides[0].force.z
    };
    let [coarse, medium, fine] = [3, 6, 12].map(force);
    assert!((medium - fine).abs() < 0.7 * (coarse - medium).abs());
    assert!((medium - fine).abs() < 0.2 * fine);
}

#[test]
fn a_sliding_edge_obeys_coulombs_law() {
    let mu = 0.3;
    let mut model = standing(tilted(33.0, 4), SOLE, Floor::Plane, coulomb(mu));
    model.steps = vec![
        moved(&model, [0.0, 0.0, -0.03], 2),
        moved(&model, [0.0, 0.1, -0.03], 5),
    ];
    let run = Run::completed(model);
    let (_, report) = run.last();
    assert!(run.pointed() > 0);
    let closed = || run.nodes().iter().filter(|node| node.pressure > 0.0);
    assert!(closed().all(|node| node.status == Status::Slip));
    let force = report.sides[0].force;
    let friction: f64 = report.sides[0].friction;
    assert!((friction - mu * force.z).abs() < 1e-9 * force.z, "{force}");
    for node in closed() {
        let excess = node.tau.norm() - mu * node.pressure;
        assert!(excess.abs() < 1e-9 * node.pressure, "{node:?}");
    }
}

/// A block that stands on its edge, turned by `degrees`, and is turned level while its upper
/// side is pressed down; without turning if `degrees` is zero.
fn settled(degrees: f64, increments: usize) -> Run {
    let mut model = standing(tilted(degrees, 4), SOLE, Floor::Plane, coulomb(0.0));
    let block = tilted(degrees, 4).mesh().unwrap();
    let level = tilted(0.0, 4).mesh().unwrap();
    let press = moved(&model, [0.0, 0.0, -0.05], increments);
    let hold = &press.displacements[0];
    let ways = hold.nodes.iter().map(|node| {
        let way = level.positions[node.index()] - block.positions[node.index()];
        let target = way - striae_mesh::Vec3::z() * 0.05;
        striae_solve::model::Displacement {
            nodes: vec![*node],
            components: [Some(target.x), Some(target.y), Some(target.z)],
            ..hold.clone()
        }
    });
    let displacements = ways.collect();
    let settle = striae_solve::model::Step {
        displacements,
        ..press
    };
    // Kept nodes and ramp are those of where an increment starts.
    let hold = striae_solve::model::Step {
        increments: moved(&model, [0.0; 3], 1).increments,
        ..settle.clone()
    };
    model.steps = vec![settle, hold];
    Run::completed(model)
}

/// That the last state is the one of a block that never stood on its edge.
fn assert_flat(run: &Run) {
    let flat = settled(0.0, 5);
    assert_eq!([run, &flat].map(Run::pointed), [0, 0]);
    let [force, wanted] = [run, &flat].map(|run| run.last().1.sides[0].force);
    // The shapes at rest differ by the rotation, which strains nothing.
    let error = (force - wanted).norm() / wanted.norm();
    assert!(error < 1e-9, "{force} for {wanted}");
    let pairs = || run.nodes().iter().zip(flat.nodes());
    let largest = pairs().map(|(_, b)| b.pressure).fold(0.0, f64::max);
    let differences = pairs().map(|(a, b)| (a.pressure - b.pressure).abs());
    let difference = differences.fold(0.0, f64::max) / largest;
    assert!(difference < 1e-8, "{difference}");
}

#[test]
fn a_block_that_settles_flat_has_the_force_of_the_flat_one() {
    assert_flat(&settled(1.0, 5));
}

#[test]
fn a_pointed_node_is_an_ordinary_one_again_once_its_faces_close() {
    let run = settled(25.0, 12);
    let pointed = |state: &striae_solve::state::State| {
        let pointed = state.pairs[0].pointed.iter().flatten();
        pointed.filter(|pointed| **pointed).count()
    };
    let counts: Vec<usize> = run.states.iter().map(pointed).collect();
    assert!(counts.contains(&4), "{counts:?}");
    assert_flat(&run);
    let edge = run.nodes().iter().filter(|node| node.pressure > 0.0);
    assert!(edge.count() >= 20);
}
