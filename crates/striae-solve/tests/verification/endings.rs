//! Runs that end, and what they say of the cause.

use crate::scene::{Places, Run, block, body, coulomb, increments, model, plane, rubber, step};
use striae_law::friction::Friction;
use striae_mesh::Vec3;
use striae_solve::{
    freedom::FreeMover,
    model::{BodyId, Freedom, LoadExtent, LoadKind, Model, RigidId, RigidMotion},
    model::{Curve, RigidShape, RigidSurface},
    outcome::{CutBack, Ending},
};

/// A block over a floor, pressed by a pressure on its top.
fn pressed(gap: f64, friction: Friction) -> Model {
    let mesh = block([0.0, 0.0, gap], [1.0; 3], [2, 2, 2]).mesh().unwrap();
    let mut model = model(vec![body("block", mesh, rubber(1.0, 0.3))]);
    model.touch_rigid(
        ("block", "zmin"),
        plane([0.0; 3], [0.0, 0.0, 1.0]),
        friction,
    );
    let mut step = step();
    step.increments = increments(0.5, 1e-3);
    step.loads = vec![model.load("block", "zmax", LoadKind::Pressure(0.01), LoadExtent::Whole)];
    model.steps = vec![step];
    model
}

fn reason(run: &Run) -> &CutBack {
    match &run.ending {
        Ending::Stopped { reason, .. } => reason,
        other => panic!("{other}"),
    }
}

#[test]
fn a_body_that_nothing_holds_ends_the_run_at_once_and_by_name() {
    let free = Run::of(pressed(0.1, coulomb(0.3)));
    let CutBack::Free { motion, .. } = reason(&free) else {
        panic!("{}", free.ending);
    };
    assert_eq!(motion.mover, FreeMover::Body("block".to_owned()));
    assert_eq!(
        motion.motions,
        "along x, along y, along z, about x, about y and about z"
    );
    assert_eq!(free.cuts.len(), 1);
}

#[test]
fn what_conditions_leave_free_is_said_as_it_is() {
    let mut model = pressed(0.1, coulomb(0.3));
    let guide = model.hold("block", "zmax", [Some(0.0), Some(0.0), None]);
    model.steps[0].displacements = vec![guide];
    let run = Run::of(model);
    let CutBack::Free { motion, .. } = reason(&run) else {
        panic!("{}", run.ending);
    };
    assert_eq!(motion.motions, "along z");
    // On the floor without friction nothing stops motion along it.
    let run = Run::of(pressed(0.0, Friction::frictionless()));
    let CutBack::Free { motion, .. } = reason(&run) else {
        panic!("{}", run.ending);
    };
    assert_eq!(motion.motions, "along x, along y and about z");
    assert_eq!(run.cuts.len(), 1);
}

#[test]
fn a_block_held_by_contact_is_not_free() {
    let run = Run::of(pressed(0.0, coulomb(0.3)));
    let said = run.cuts.iter().map(|(_, cut)| cut.to_string());
    assert_eq!(
        run.ending,
        Ending::Completed,
        "{:?}",
        said.collect::<Vec<_>>()
    );
}

/// A block tied to a hand that presses it on the floor, then turns it by a torque.
fn twisted(torque: f64) -> Model {
    let mesh = block([-0.5, -0.5, 0.0], [1.0; 3], [2, 2, 2])
        .mesh()
        .unwrap();
    let mut model = model(vec![body("block", mesh, rubber(1.0, 0.3))]);
    model.touch_rigid(
        ("block", "zmin"),
        plane([0.0; 3], [0.0, 0.0, 1.0]),
        coulomb(0.3),
    );
    let ties = vec![(BodyId(0), model.nodes("block", "zmax"))];
    let mut hand = RigidSurface::new("hand", RigidShape::Bare);
    hand.reference = Vec3::new(0.0, 0.0, 1.0);
    hand.ties = ties;
    model.rigid_surfaces.push(hand);
    let motion = |coordinates, torque| RigidMotion {
        surface: RigidId(1),
        coordinates,
        force: None,
        torque,
        curve: Curve::Ramp,
    };
    let mut press = step();
    let mut down = [Freedom::AsBefore; 6];
    down[2] = Freedom::To(-0.05);
    press.rigid_motions = vec![motion(down, None)];
    let mut turn = step();
    turn.name = "turn".to_owned();
    turn.increments = increments(0.1, 2e-3);
    let mut free = [Freedom::AsBefore; 6];
    free[5] = Freedom::Free;
    turn.rigid_motions = vec![motion(free, Some(Vec3::new(0.0, 0.0, torque)))];
    model.steps = vec![press, turn];
    model
}

#[test]
fn a_torque_beyond_friction_ends_at_the_limit_of_friction() {
    assert_eq!(Run::of(twisted(0.002)).ending, Ending::Completed);
    let run = Run::of(twisted(0.02));
    let CutBack::FrictionLimit {
        pair,
        motion,
        reached,
        ..
    } = reason(&run)
    else {
        panic!("{}", run.ending);
    };
    assert_eq!(pair, "interface");
    assert_eq!(motion.to_string(), "`rz` of `hand` is free");
    assert!(*reached > 0.1 && *reached < 0.9, "{reached}");
}
