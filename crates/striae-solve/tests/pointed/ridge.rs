//! Rigid ridges and tops between the nodes of a flat block.

use striae_contact::{side::Side, unknowns::Status};
use striae_law::friction::Friction;
use striae_mesh::Vec3;
use striae_solve::report::rigid_bodies;
use striae_surface::node::SurfaceNode;

use crate::scene::{Floor, Run, TOP, moved, standing, tilted};

const SOLE: &[&str] = &["zmin"];
const SHARP: [Floor; 2] = [Floor::Ridge, Floor::Pyramid];

/// Size of the facets of a block with four divisions.
const SIZE: f64 = 0.288_675;

fn pressed(divisions: usize, floor: Floor, mu: f64, ways: &[([f64; 3], usize)]) -> Run {
    let friction = Friction::coulomb(mu).unwrap();
    let mut model = standing(tilted(0.0, divisions), SOLE, floor, friction);
    let steps = ways.iter().map(|(way, n)| moved(&model, *way, *n));
    model.steps = steps.collect();
    Run::completed(model)
}

/// Points of the lower side of the block.
fn sole(run: &Run) -> Vec<Vec3> {
    let pair = &run.problem.pairs[0].contact;
    let surface = pair.sides[0].surface().unwrap();
    let (state, _) = run.last();
    let x: Vec<Vec3> = SurfaceNode::all(surface.nodes().len())
        .map(|node| state.positions[run.problem.surface_node(0, Side::A, node).unwrap()])
        .collect();
    // Facets are bilinear over plane rectangles.
    let facets = surface.facets().iter().flat_map(|corners| {
        let [a, b, c, d] = corners.map(|node| x[node]);
        (0..=20).flat_map(move |i| {
            (0..=20).map(move |j| {
                let (s, t) = (f64::from(i) / 20.0, f64::from(j) / 20.0);
                a * (1.0 - s) * (1.0 - t) + b * s * (1.0 - t) + c * s * t + d * (1.0 - s) * t
            })
        })
    });
    facets.collect()
}

/// How deep the top line of the floor is inside the block, at most.
fn depth(run: &Run) -> f64 {
    let near = sole(run).into_iter().filter(|x| (x.x - TOP).abs() < 0.01);
    near.map(|x| -x.z).fold(0.0, f64::max)
}

#[test]
fn what_is_between_the_nodes_is_felt() {
    for floor in SHARP {
        let run = pressed(4, floor, 0.3, &[([0.0, 0.0, -0.02], 2)]);
        let (_, report) = run.last();
        let force = report.sides[0].force.z;
        assert!(force > 1e-4, "{floor:?}: {force}");
        let points = run.points(run.states.len() - 1);
        let pressed: Vec<_> = points.iter().filter(|(_, of)| of.pressure > 0.0).collect();
        assert!(!pressed.is_empty());
        assert!(pressed.iter().all(|(_, of)| of.gap.abs() < 1e-9 * SIZE));
        if floor == Floor::Ridge {
            assert!(depth(&run) < 0.1 * SIZE, "{}", depth(&run));
        }
    }
}

#[test]
fn a_ridge_of_long_facets_is_bent() {
    let run = pressed(4, Floor::Narrow, 0.3, &[([0.0, 0.0, -0.02], 2)]);
    let points = run.points(run.states.len() - 1);
    assert!(points.iter().any(|(_, of)| of.pressure > 0.0));
    assert!(depth(&run) < 0.1 * SIZE, "{}", depth(&run));
}

#[test]
fn a_flat_top_is_felt_where_nothing_else_is() {
    // The facet on it is open in the mean.
    let run = pressed(4, Floor::Hill, 0.3, &[([0.0, 0.0, -0.008], 2)]);
    assert!(run.last().1.sides[0].force.z > 0.0);
    let points = run.points(run.states.len() - 1);
    assert_eq!(points.len(), 1);
    assert!(points[0].1.pressure > 0.0 && points[0].1.gap.abs() < 1e-9 * SIZE);
}

#[test]
fn a_flat_top_under_pressure_is_no_deeper_than_a_tenth_of_a_facet() {
    let run = pressed(4, Floor::Hill, 0.3, &[([0.0, 0.0, -0.08], 10)]);
    let near = sole(&run)
        .into_iter()
        .filter(|x| (x.x - TOP).hypot(x.y) < 0.02);
    let depth = near.map(|x| -x.z).fold(f64::NEG_INFINITY, f64::max);
    assert!(depth.abs() < 0.1 * SIZE, "{depth}");
}

#[test]
fn force_grows_continuously_from_the_depth_at_which_it_is_felt() {
    for floor in SHARP {
        let run = pressed(4, floor, 0.0, &[([0.0, 0.0, -0.1], 40)]);
        let forces: Vec<f64> = run.reports.iter().map(|r| r.sides[0].force.z).collect();
        let last = forces[forces.len() - 1];
        // Steps of 0.0025 with a dead zone of 0.0058.
        assert!(forces[2] > 0.0, "{floor:?}: {forces:?}");
        for pair in forces.windows(2).skip(2) {
            let growth = (pair[1] - pair[0]) / last;
            assert!(
                growth > 0.0 && growth < 0.1,
                "{floor:?}: {growth} in {forces:?}"
            );
        }
    }
}

#[test]
fn force_is_of_the_size_of_that_on_a_fine_mesh() {
    // Twenty divisions resolve the ridge, four do not: pressed by a tenth of
    // its elements, the coarse block yields with whole elements and is stiffer.
    let [coarse, fine] = [4, 20].map(|divisions| {
        let run = pressed(divisions, Floor::Ridge, 0.0, &[([0.0, 0.0, -0.025], 4)]);
        run.last().1.sides[0].force.z
    });
    assert!((1.0..3.0).contains(&(coarse / fine)), "{coarse} for {fine}");
}

#[test]
fn a_top_is_pushed_where_it_is() {
    let run = pressed(
        4,
        Floor::Pyramid,
        0.3,
        &[([0.0, 0.0, -0.02], 2), ([0.004, 0.002, -0.02], 2)],
    );
    let (state, report) = run.last();
    let points = run.points(run.states.len() - 1);
    assert_eq!(points.len(), 1);
    let force = -report.sides[0].force;
    let top = Vec3::new(TOP, 0.0, 0.0);
    let torque = rigid_bodies(&run.problem, state)[0].torque;
    // What drives the body is against contact.
    let expected = top.cross(&-force);
    let error = (torque - expected).norm() / (force.norm() * TOP);
    assert!(error < 1e-9, "{torque} for {expected}");
}

#[test]
fn a_node_next_to_a_top_is_not_felt_besides_it() {
    // The node is inside the pyramid as well, and both would stand against each other.
    let mut upper = tilted(0.0, 4);
    upper.origin.x += TOP + 0.02 - 0.25;
    upper.origin.y += 0.015 - 1.0 / 6.0;
    let friction = Friction::coulomb(0.3).unwrap();
    let mut model = standing(upper, SOLE, Floor::Pyramid, friction);
    model.steps = vec![moved(&model, [0.0, 0.0, -0.03], 3)];
    let run = Run::completed(model);
    let points = run.points(run.states.len() - 1);
    assert_eq!(points.len(), 1);
    assert!(points[0].1.pressure > 0.0);
    assert!(!run.last().0.pairs[0].pointed[0].contains(&true));
    assert!(depth(&run) < 0.1 * SIZE, "{}", depth(&run));
}

#[test]
fn what_slides_between_the_nodes_obeys_coulombs_law() {
    let mu = 0.3;
    for floor in SHARP {
        let press = ([0.0, 0.0, -0.02], 2);
        let run = pressed(4, floor, mu, &[press, ([0.0, 0.4, -0.02], 12)]);
        let points = run.points(run.states.len() - 1);
        let closed: Vec<_> = points.iter().filter(|(_, of)| of.pressure > 0.0).collect();
        assert!(!closed.is_empty(), "{floor:?}");
        for (point, of) in closed {
            assert_eq!(of.status, Status::Slip, "{floor:?}: {point:?}");
            let excess = of.tau.norm() - mu * of.pressure;
            assert!(excess.abs() < 1e-9 * of.pressure, "{of:?}");
        }
        let forces: Vec<f64> = run.reports.iter().map(|r| r.sides[0].force.z).collect();
        assert!(forces.iter().all(|force| *force > 1e-4), "{forces:?}");
    }
}

#[test]
fn the_rim_of_a_block_on_a_slope_is_felt() {
    // The ridge is beside the block, which meets its slope with the nodes of its rim only.
    let mut upper = tilted(0.0, 2);
    upper.origin.x = TOP + 0.02;
    let mut model = standing(upper, SOLE, Floor::Ridge, Friction::coulomb(0.2).unwrap());
    model.steps = vec![moved(&model, [0.0, 0.0, -0.03], 3)];
    let run = Run::completed(model);
    assert!(run.last().1.sides[0].force.z > 1e-4);
    assert!(run.pointed() > 0);
    // The slope is at -0.01 there.
    let gaps = run.nodes().iter().filter(|node| node.pressure > 0.0);
    assert!(gaps.map(|node| node.gap.abs()).fold(0.0, f64::max) < 1e-9);
}
