//! Blocks that slide: the law at every node and for the resultants.

use crate::scene::{
    Places, Run, block, body, coulomb, increments, model, pressed_on_plane, rubber, step,
};
use striae_contact::{side::Side, unknowns::Status};
use striae_mesh::Vec3;
use striae_model::Model;
use striae_solve::{
    norms::Norms,
    report::{PairReport, pairs},
};
use striae_verify::fitted_rate;

const MU: f64 = 0.3;

fn report(run: &Run, state: usize) -> PairReport {
    pairs(&run.problem, &run.states[state]).swap_remove(0)
}

/// A block pressed on a plane, then moved far in a direction.
fn on_plane(degrees: f64) -> Model {
    let mesh = block([0.0; 3], [1.0, 1.0, 0.5], [3, 3, 1]).mesh().unwrap();
    let mut model = pressed_on_plane(mesh, MU);
    let mut slide = step();
    let (sin, cos) = degrees.to_radians().sin_cos();
    slide.displacements =
        vec![model.hold("block", "zmax", [Some(2.0 * cos), Some(2.0 * sin), None])];
    slide.increments = increments(0.125, 0.1);
    model.steps.push(slide);
    model
}

#[test]
fn on_a_plane_the_resultant_and_every_node_obey_the_law() {
    for degrees in [0.0_f64, 37.0, 90.0, 180.0] {
        let run = Run::completed(on_plane(degrees));
        let force = report(&run, run.states.len() - 1).sides[0].force;
        let ratio = force.xy().norm() / force.z;
        assert!((ratio / MU - 1.0).abs() < 1e-9, "{degrees}: T/N = {ratio}");
        let (sin, cos) = degrees.to_radians().sin_cos();
        let against = force.normalize().xy() / (MU / (1.0 + MU * MU).sqrt());
        assert!((against.x + cos).abs() < 1e-8 && (against.y + sin).abs() < 1e-8);
        for state in 2..run.states.len() {
            nodes_obey_the_law(&run, state);
        }
    }
}

fn nodes_obey_the_law(run: &Run, state: usize) {
    let pair = &run.states[state].pairs[0];
    let nodes = || pair.nodes.iter().flatten();
    let largest = nodes().map(|node| node.pressure).fold(0.0, f64::max);
    let mut slipping = 0;
    for (kept, nodes) in pair.kept.iter().zip(&pair.nodes) {
        for (kept, node) in kept.iter().zip(nodes) {
            if *kept && node.status == Status::Slip {
                let error = (node.tau.norm() - MU * node.pressure).abs();
                assert!(
                    error <= 1e-10 * largest,
                    "off the law by {:.1e}",
                    error / largest
                );
                assert!(node.tau.dot(&node.slip) <= 0.0);
                slipping += 1;
            }
        }
    }
    assert!(slipping > 0);
}

/// A smaller block pressed on a larger one and slid over it.
fn two_blocks(order: [usize; 2], depth: f64, slide: [f64; 2]) -> Model {
    let lower = block([0.0; 3], [1.0, 1.0, 0.5], [4, 4, 1]).mesh().unwrap();
    let upper = block([0.2, 0.2, 0.5], [0.6, 0.6, 0.5], [3, 3, 1])
        .mesh()
        .unwrap();
    let mut model = model(vec![
        body("lower", lower, rubber(10.0, 0.3)),
        body("upper", upper, rubber(1.0, 0.3)),
    ]);
    let sides = [("lower", "zmax"), ("upper", "zmin")];
    model.touch(sides[order[0]], sides[order[1]], coulomb(MU));
    let mut press = step();
    press.displacements = vec![
        model.hold("lower", "zmin", [Some(0.0); 3]),
        model.hold("upper", "zmax", [Some(0.0), Some(0.0), Some(-depth)]),
    ];
    let mut move_on = step();
    move_on.displacements =
        vec![model.hold("upper", "zmax", [Some(slide[0]), Some(slide[1]), None])];
    move_on.increments = increments(0.25, 0.01);
    model.steps = vec![press, move_on];
    model
}

/// Coulomb friction depends on no time: after a slide, and at loads below it, nothing creeps.
#[test]
fn what_has_slid_rests_when_nothing_moves() {
    for (order, slide) in [([0, 1], [0.05, 0.01]), ([1, 0], [0.02, 0.06])] {
        let mut model = two_blocks(order, 0.02, slide);
        let mut hold = step();
        hold.increments = increments(0.05, 0.05);
        model.steps.push(hold);
        let run = Run::completed(model);
        let count = run.states.len();
        let forces: Vec<Vec3> = (count - 20..count)
            .map(|state| report(&run, state).sides[0].force)
            .collect();
        let last = forces[19];
        // Weak nodes take part in the slide by the friction of others, which ends with it.
        assert!((forces[0] - last).norm() < 5e-3 * last.norm(), "{forces:?}");
        for force in &forces[10..] {
            assert!((force - last).norm() < 1e-9 * last.norm(), "{forces:?}");
        }
        let [from, to] = [count - 10, count - 1].map(|state| run.states[state].energies.friction);
        assert!((to - from).abs() <= 1e-9 * to, "{from} {to}");
    }
}

#[test]
fn between_deformable_blocks_the_integrals_obey_the_law_and_balance() {
    for (order, depth) in [([0, 1], 0.02), ([1, 0], 0.002)] {
        let run = Run::completed(two_blocks(order, depth, [0.1, 0.03]));
        let last = run.states.len() - 1;
        let report = report(&run, last);
        for side in report.sides {
            let ratio = side.friction / side.pressure;
            // What is left is the tilt of the surfaces, of the order of the strain.
            assert!((ratio / MU - 1.0).abs() < 0.5 * depth, "{order:?}: {ratio}");
        }
        assert_eq!(report.stick, 0);
        nodes_obey_the_law(&run, last);
        for state in 1..=last {
            let report = self::report(&run, state);
            assert!(report.mismatch < 1e-12, "{:.1e}", report.mismatch);
            moments_balance_but_for_gaps(&run, state, &report);
        }
        let forces = &run.states[last].forces;
        let reactions: Vec3 = forces.reaction.iter().sum();
        let largest = forces.reaction.iter().map(|f| f.norm()).fold(0.0, f64::max);
        assert!(reactions.norm() < 1e-9 * largest);
    }
}

/// Both sides bear the same forces at points that are a gap `g` apart along the normal, so
/// their moments differ by `integral g n x t`, of which friction alone has a share:
/// at most the largest gap times `integral |tau|`.
fn moments_balance_but_for_gaps(run: &Run, state: usize, report: &PairReport) {
    let [a, b] = &report.sides;
    let mismatch = (a.moment + b.moment).norm();
    let bound = largest_gap(run, state) * a.friction.max(b.friction);
    // Round-off of the moments themselves.
    let bound = bound + 1e-12 * a.moment.norm();
    assert!(mismatch <= bound, "{mismatch:.1e}, {bound:.1e}");
}

/// Bound of the gap between facets in contact: a facet lies between its lowest and its
/// highest corner, and a distance along a normal is one in height over its vertical part.
fn largest_gap(run: &Run, state: usize) -> f64 {
    let state = &run.states[state];
    let pair = &state.pairs[0];
    let mut upright = 1.0_f64;
    let heights = Side::BOTH.map(|side| {
        let surface = run.problem.pairs[0].contact.sides[side].surface().unwrap();
        let mut extent = [f64::INFINITY, f64::NEG_INFINITY];
        for (facet, _) in &pair.facets[side] {
            let x = surface.facets()[facet.index()].map(|node| {
                let node = run.problem.surface_node(0, side, node).unwrap();
                state.positions[node]
            });
            let normal = (x[2] - x[0]).cross(&(x[3] - x[1])).normalize();
            upright = upright.min(normal.z.abs());
            extent[0] = x.iter().map(|x| x.z).fold(extent[0], f64::min);
            extent[1] = x.iter().map(|x| x.z).fold(extent[1], f64::max);
        }
        extent
    });
    let apart = (heights[1][1] - heights[0][0]).max(heights[0][1] - heights[1][0]);
    apart / upright
}

/// Increments in which a node that slipped before has got unknowns of its own.
fn increments_with_new_nodes(run: &Run) -> Vec<usize> {
    let has_new = |increment: &usize| {
        let [before, after] = [0, 1].map(|at| &run.states[increment + at].pairs[0]);
        (0..2).any(|side| {
            let kept = before.kept[side].iter().zip(&after.kept[side]);
            let mut nodes = kept.zip(&before.nodes[side]);
            nodes.any(|((was, is), node)| !was && *is && node.status == Status::Slip)
        })
    };
    (0..run.iterations.len()).filter(has_new).collect()
}

#[test]
fn nodes_that_are_newly_kept_while_sliding_go_on_slipping() {
    for depth in [0.02, 0.002] {
        let mut model = two_blocks([0, 1], depth, [0.15, 0.0]);
        model.steps[1].increments = increments(0.1, 0.001);
        let run = Run::completed(model);
        assert!(run.cuts.is_empty(), "{depth}: {:?}", run.cuts);
        let increments = increments_with_new_nodes(&run);
        assert!(!increments.is_empty(), "{depth}: no node is new");
        for increment in increments {
            // As many as in steady sliding; a node that sticks first takes three more.
            let count = run.iterations[increment].len();
            assert!(count <= 5, "{depth}, increment {increment}: {count}");
        }
    }
}

#[test]
fn convergence_ends_quadratically() {
    let mut model = two_blocks([0, 1], 0.02, [0.1, 0.03]);
    // No late corrections then: every iteration has its own tangent.
    model.solver.further_iterations = 1;
    let run = Run::completed(model);
    let mut told = 0;
    for norms in &run.iterations[1..] {
        let forces: Vec<f64> = norms.iter().map(|n| n.largest()).collect();
        let tail: Vec<f64> = forces.into_iter().filter(|f| *f > 1e-12).collect();
        let [.., a, b, c] = tail.as_slice() else {
            continue;
        };
        // Points of partly closed supports open and close before.
        if *a < 1e-3 {
            let order = fitted_rate(&[*a, *b], &[*b, *c]);
            assert!(order > 1.8, "order {order} in {tail:?}");
            told += 1;
        }
        assert!(norms.len() <= 12, "{} iterations", norms.len());
    }
    assert!(told > 0, "{:?}", run.iterations);
}

/// The corrections share a tangent, so each reduces the residual by the same factor.
#[test]
fn late_corrections_converge_as_fast_as_they_are_taken_to() {
    let tangents = |further| {
        let mut model = two_blocks([0, 1], 0.02, [0.1, 0.03]);
        model.solver.further_iterations = further;
        Run::completed(model)
    };
    let (late, newton) = (tangents(0), tangents(1));
    let mut told = 0;
    for norms in &late.iterations[1..] {
        let norms: Vec<f64> = norms.iter().map(Norms::largest).collect();
        let [.., a, b, c] = norms.as_slice() else {
            continue;
        };
        if *a < 3e-3 && *b > 1e-8 {
            assert!(*c <= 10.0 * b * b / a, "{norms:?}");
            told += 1;
        }
    }
    assert!(told > 0, "{:?}", late.iterations);
    let [late, newton] = [&late, &newton].map(|run| &run.states.last().unwrap().positions);
    for (x, y) in late.iter().zip(newton) {
        assert!((x - y).norm() < 1e-9, "{x} instead of {y}");
    }
}
