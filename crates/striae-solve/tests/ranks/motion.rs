//! Inertia and rigid bodies.

use striae_mesh::Vec3;
use striae_model::{
    BodyId, ContactMass, Curve, Freedom, Gravity, Model, Mover, Procedure, RigidId, RigidInertia,
    RigidMotion, RigidShape, RigidSurface, Step, Velocity,
};

use crate::{
    scene::{Places, block, body, coulomb, increments, model, plane, rubber, step},
    told::assert_same,
};

fn moving(duration: f64, count: usize) -> Step {
    let size = 1.0 / count as f64;
    Step {
        duration,
        procedure: Procedure::Dynamic {
            spectral_radius: 0.8,
        },
        increments: increments(size, 0.4 * size),
        ..step()
    }
}

fn motion(coordinates: [Freedom; 6]) -> RigidMotion {
    RigidMotion {
        surface: RigidId(0),
        coordinates,
        force: None,
        torque: None,
        curve: Curve::Ramp,
    }
}

/// A block thrown on a plane at an angle, under its weight.
fn thrown(contact_mass: ContactMass) -> Model {
    let mesh = block([0.0; 3], [1.0, 1.0, 0.5], [2, 2, 4]).mesh().unwrap();
    let mut falling = body("block", mesh, rubber(100.0, 0.3));
    (falling.density, falling.contact_mass) = (1.0, contact_mass);
    let mut model = model(vec![falling]);
    let floor = plane([0.0, 0.0, -0.05], [0.0, 0.0, 1.0]);
    model.touch_rigid(("block", "zmin"), floor, coulomb(0.3));
    let mut step = moving(0.1, 20);
    step.velocities = vec![Velocity {
        body: Mover::Deformable(BodyId(0)),
        velocity: Vec3::new(0.5, 0.2, -1.0),
        spin: Vec3::new(0.1, 0.0, 0.3),
        about: Vec3::zeros(),
    }];
    step.gravity = Some(Gravity {
        acceleration: Vec3::new(0.0, 0.0, -1.0),
        curve: Curve::Constant,
    });
    model.steps.push(step);
    model
}

#[test]
fn impacts() {
    assert_same(&thrown(ContactMass::Consistent));
}

#[test]
fn impacts_with_nodes_without_mass() {
    assert_same(&thrown(ContactMass::Redistributed));
}

/// A bar whose upper end is tied to a rigid body, its lower one held.
fn with_head(inertia: Option<RigidInertia>) -> Model {
    let mesh = block([0.0; 3], [0.5, 0.5, 2.0], [2, 2, 6]).mesh().unwrap();
    let mut bar = body("bar", mesh, rubber(10.0, 0.3));
    bar.density = 1.0;
    let mut model = model(vec![bar]);
    let mut head = RigidSurface::new("head", RigidShape::Bare);
    head.reference = Vec3::new(0.25, 0.25, 2.0);
    head.ties = vec![(BodyId(0), model.nodes("bar", "zmax"))];
    head.inertia = inertia;
    model.rigid_surfaces.push(head);
    model
}

#[test]
fn a_rigid_body_with_tied_nodes_that_is_driven() {
    let mut model = with_head(None);
    let mut turn = step();
    turn.increments = increments(0.25, 0.01);
    turn.displacements = vec![model.hold("bar", "zmin", [Some(0.0); 3])];
    let mut coordinates = [Freedom::AsBefore; 6];
    (coordinates[0], coordinates[5]) = (Freedom::To(0.2), Freedom::To(0.6));
    turn.rigid_motions = vec![motion(coordinates)];
    model.steps.push(turn);
    assert_same(&model);
}

#[test]
fn a_heavy_head_that_swings() {
    let inertia = RigidInertia::aligned(2.0, Vec3::new(0.25, 0.25, 2.2), [0.5, 0.7, 0.9]);
    let mut model = with_head(Some(inertia));
    let mut swing = moving(0.5, 10);
    swing.displacements = vec![model.hold("bar", "zmin", [Some(0.0); 3])];
    swing.rigid_motions = vec![RigidMotion {
        force: Some(Vec3::new(0.2, 0.1, -0.1)),
        curve: Curve::Constant,
        ..motion([Freedom::Free; 6])
    }];
    model.steps.push(swing);
    assert_same(&model);
}

#[test]
fn a_free_rigid_body_that_contact_moves() {
    let mesh = block([0.0; 3], [1.0, 1.0, 0.5], [4, 4, 2]).mesh().unwrap();
    let mut model = model(vec![body("block", mesh, rubber(1.0, 0.3))]);
    let press = plane([0.0, 0.0, 0.5], [0.0, 0.0, -1.0]);
    model.touch_rigid(("block", "zmax"), press, coulomb(0.4));
    model.rigid_surfaces[0].reference = Vec3::new(0.5, 0.5, 0.6);
    let mut push = step();
    push.increments = increments(0.5, 0.01);
    push.displacements = vec![model.hold("block", "zmin", [Some(0.0); 3])];
    push.rigid_motions = vec![RigidMotion {
        force: Some(Vec3::new(0.002, 0.001, -0.02)),
        ..motion([Freedom::Free; 6])
    }];
    let mut down = step();
    down.displacements = vec![model.hold("block", "zmin", [Some(0.0); 3])];
    let mut coordinates = [Freedom::AsBefore; 6];
    coordinates[2] = Freedom::To(-0.02);
    down.rigid_motions = vec![motion(coordinates)];
    model.steps = vec![down, push];
    assert_same(&model);
}
