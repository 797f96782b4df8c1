//! Friction that falls with the slip rate, faster than the bodies can follow.
//!
//! If `p (mu_s - mu_k)/(v_d dt)` is larger than the stiffness of the body, friction of a node that
//! begins to slip falls faster than the force that the body holds it with: the residual rises with
//! slip before it falls, and a tangent at rest leads away from the solution.

use crate::scene::{
    Places, Run, block, body, coulomb, increments, model, pressed_on_plane, rubber, step,
};
use striae_contact::{side::Side, unknowns::Status};
use striae_solve::outcome::Ending;

const STATIC: f64 = 0.5;
const KINETIC_OVER_STATIC: f64 = 0.6;
/// Increments a step, whose duration is 1.
const COUNT: u32 = 10;

/// A block that is pressed and slides on.
fn dragged(rate: f64) -> Run {
    let mesh = block([0.0; 3], [1.0, 1.0, 0.4], [4, 4, 2]).mesh().unwrap();
    let mut model = pressed_on_plane(mesh, STATIC);
    let friction = coulomb(STATIC).with_decay(KINETIC_OVER_STATIC, rate);
    model.pairs[0].friction = friction.unwrap();
    let mut slide = step();
    slide.displacements = vec![model.hold("block", "zmax", [Some(0.2), Some(0.05), None])];
    model.steps.push(slide);
    for step in &mut model.steps {
        step.increments = increments(1.0 / f64::from(COUNT), 1e-3);
    }
    model.solver.largest_iterations = 40;
    Run::of(model)
}

/// A block that slides over the edge of another one, so that some nodes have a ramp.
fn over_the_edge(rate: f64) -> Run {
    let lower = block([0.0; 3], [1.0, 1.0, 0.5], [4, 4, 2]);
    let upper = block([0.22, 0.17, 0.5], [0.9, 0.6, 0.5], [6, 5, 2]);
    let mut model = model(vec![
        body("lower", lower.mesh().unwrap(), rubber(1.0, 0.3)),
        body("upper", upper.mesh().unwrap(), rubber(1.0, 0.2)),
    ]);
    let friction = coulomb(STATIC).with_decay(KINETIC_OVER_STATIC, rate);
    model.touch(("lower", "zmax"), ("upper", "zmin"), friction.unwrap());
    let mut press = step();
    press.displacements = vec![
        model.hold("lower", "zmin", [Some(0.0); 3]),
        model.hold("upper", "zmax", [Some(0.0), Some(0.0), Some(-0.02)]),
    ];
    let mut slide = step();
    slide.displacements = vec![model.hold("upper", "zmax", [Some(0.2), Some(0.05), None])];
    model.steps = vec![press, slide];
    for step in &mut model.steps {
        step.increments = increments(1.0 / f64::from(COUNT), 1e-3);
    }
    model.solver.largest_iterations = 40;
    Run::completed(model)
}

/// Asserts that friction of kept nodes is that of their slip rate, opposes their slip, and
/// counts those that slip.
fn assert_obeyed(run: &Run, rate: f64) -> usize {
    let mut slipping = 0;
    for pair in run.states[1..].iter().map(|state| &state.pairs[0]) {
        let of_side = |side: Side| pair.nodes[side].iter().zip(&pair.kept[side]);
        let nodes = of_side(Side::A).chain(of_side(Side::B));
        for (node, _) in nodes.filter(|(node, kept)| **kept && node.status != Status::Open) {
            let speed = node.slip.norm() * f64::from(COUNT);
            let kinetic = KINETIC_OVER_STATIC + (1.0 - KINETIC_OVER_STATIC) * (-speed / rate).exp();
            let limit = STATIC * kinetic * node.pressure;
            let used = node.tau.norm();
            if node.status == Status::Slip {
                slipping += 1;
                assert!((used - limit).abs() < 1e-9, "{rate}: {used} of {limit}");
            } else {
                assert!(used <= limit + 1e-9, "{rate}: {used} of {limit}");
            }
        }
    }
    slipping
}

/// Asserts that friction opposes the slip that is seen.
fn assert_opposed(run: &Run) {
    for pair in run.states.iter().map(|state| &state.pairs[0]) {
        for node in pair.nodes[0]
            .iter()
            .filter(|node| node.status == Status::Slip)
        {
            let against = node.tau.dot(&node.slip) + node.tau.norm() * node.slip.norm();
            assert!(against.abs() < 1e-9, "{against:.1e}");
        }
    }
}

#[test]
fn weak_nodes_have_the_friction_of_the_slip_that_is_seen() {
    for rate in [0.03, 0.1, 1.0] {
        let slipping = assert_obeyed(&over_the_edge(rate), rate);
        assert!(slipping > 200, "{rate}: {slipping}");
    }
}

#[test]
fn slip_begins_however_steeply_friction_falls() {
    for rate in [1e-3, 3e-3, 1e-2, 0.03, 0.1, 1.0] {
        let run = dragged(rate);
        assert_eq!(run.ending, Ending::Completed, "{rate}");
        assert!(run.cuts.is_empty(), "{rate}: {:?}", run.cuts);
        let most = run.iterations.iter().map(Vec::len).max();
        assert!(most <= Some(15), "{rate}: {most:?} iterations");
        let slipping = assert_obeyed(&run, rate);
        assert_opposed(&run);
        assert!(slipping > 100, "{rate}: {slipping}");
    }
}
