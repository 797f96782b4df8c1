//! Friction that falls with the slip rate, faster than the bodies can follow.
//!
//! Where `p (mu_s - mu_k)/(v_d dt)` is larger than the stiffness of the body, friction of a
//! node that begins to slip falls faster than the force that the body holds it with: the
//! residual rises with slip before it falls, and a tangent at rest leads away from the
//! solution.

use crate::scene::{Places, Run, block, coulomb, increments, pressed_on_plane, step};
use striae_contact::unknowns::Status;
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

#[test]
fn slip_begins_however_steeply_friction_falls() {
    for rate in [1e-3, 3e-3, 1e-2, 0.03, 0.1, 1.0] {
        let run = dragged(rate);
        assert_eq!(run.ending, Ending::Completed, "{rate}");
        assert!(run.cuts.is_empty(), "{rate}: {:?}", run.cuts);
        let most = run.iterations.iter().map(Vec::len).max();
        assert!(most <= Some(10), "{rate}: {most:?} iterations");
        let mut slipping = 0;
        for state in &run.states[1..] {
            let nodes = state.pairs[0].nodes[0].iter();
            for node in nodes.filter(|node| node.status != Status::Open) {
                let speed = node.slip.norm() * f64::from(COUNT);
                let kinetic =
                    KINETIC_OVER_STATIC + (1.0 - KINETIC_OVER_STATIC) * (-speed / rate).exp();
                let limit = STATIC * kinetic * node.pressure;
                let used = node.tau.norm();
                if node.status == Status::Slip {
                    slipping += 1;
                    assert!((used - limit).abs() < 1e-9, "{rate}: {used} of {limit}");
                    let against = node.tau.dot(&node.slip) + used * node.slip.norm();
                    assert!(against.abs() < 1e-9, "{rate}: {against:.1e}");
                } else {
                    assert!(used <= limit + 1e-9, "{rate}: {used} of {limit}");
                }
            }
        }
        assert!(slipping > 100, "{rate}: {slipping}");
    }
}
