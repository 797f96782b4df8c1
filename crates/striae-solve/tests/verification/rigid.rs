//! Rigid bodies with tied nodes and mass: flight, rotation, driving, elimination.

use crate::{
    dynamics::moving,
    scene::{Places, Run, block, body, increments, model, rubber, step},
};
use striae_mesh::Vec3;
use striae_model::{
    BodyId, Curve, Freedom, Gravity, Model, Mover, RigidId, RigidInertia, RigidMotion, RigidShape,
    RigidSurface, Velocity,
};
use striae_solve::{dynamics::momentum, rigid::fitted_velocity};
use striae_verify::fitted_rate;

const FREE: [Freedom; 6] = [Freedom::Free; 6];
const MOMENTS: [f64; 3] = [0.5, 0.7, 0.9];

fn top(coordinates: [Freedom; 6]) -> RigidMotion {
    RigidMotion {
        surface: RigidId(0),
        coordinates,
        force: None,
        torque: None,
        curve: Curve::Constant,
    }
}

/// A rigid body of mass 2 without anything else but a small block far away.
fn lonely() -> Model {
    let mesh = block([9.0; 3], [0.1; 3], [1, 1, 1]).mesh().unwrap();
    let mut stone = body("stone", mesh, rubber(1.0, 0.3));
    stone.density = 1.0;
    let mut model = model(vec![stone]);
    let mut rigid = RigidSurface::new("top", RigidShape::Bare);
    rigid.reference = Vec3::new(0.1, 0.2, 0.3);
    rigid.inertia = Some(RigidInertia::aligned(2.0, rigid.reference, MOMENTS));
    model.rigid_surfaces.push(rigid);
    model
}

fn thrown(velocity: [f64; 3], spin: [f64; 3]) -> Vec<Velocity> {
    vec![Velocity {
        body: Mover::Rigid(RigidId(0)),
        velocity: velocity.into(),
        spin: spin.into(),
        about: Vec3::new(0.1, 0.2, 0.3),
    }]
}

#[test]
fn a_body_falls_and_turns_about_a_principal_axis() {
    let mut model = lonely();
    let mut step = moving(1.0, 100);
    step.velocities = thrown([1.0, 0.0, 2.0], [0.0, 0.0, 9.0]);
    step.gravity = Some(Gravity {
        acceleration: Vec3::new(0.0, 0.0, -3.0),
        curve: Curve::Constant,
    });
    step.rigid_motions = vec![top(FREE)];
    model.steps.push(step);
    let run = Run::completed(model);
    let pose = run.last().rigid[0];
    let fallen = Vec3::new(1.0, 0.0, 0.5);
    assert!((pose.displacement - fallen).norm() < 1e-9, "{pose:?}");
    assert!((pose.turned.z - 9.0).abs() < 0.01, "{pose:?}");
    assert!(pose.turned.xy().norm() < 1e-9);
}

/// Errors of angular momentum and energy of a tumbling body, over what they are.
fn tumbled(count: usize) -> [f64; 2] {
    let mut model = lonely();
    let mut step = moving(1.0, count);
    step.velocities = thrown([0.3, 0.1, 0.0], [2.0, 3.0, 1.0]);
    step.rigid_motions = vec![top(FREE)];
    model.steps.push(step);
    let run = Run::completed(model);
    let (p_0, _) = momentum(&run.problem, &run.states[1]);
    let (p, _) = momentum(&run.problem, run.last());
    assert!((p - p_0).norm() < 1e-9);
    let state = run.last();
    let [_, spin] = fitted_velocity(
        &(run.problem.model.rigid_surfaces[0].reference + state.rigid[0].displacement),
        &run.problem.tied[0],
        &state.positions,
        &state.velocities,
    );
    let r = state.rigid[0].rotation;
    let inertia = r * nalgebra::Matrix3::from_diagonal(&MOMENTS.into()) * r.transpose();
    let expected = Vec3::new(2.0 * MOMENTS[0], 3.0 * MOMENTS[1], MOMENTS[2]);
    let found = inertia * spin;
    let energy = 0.5 * spin.dot(&found);
    let kinetic = 0.5 * (4.0 * MOMENTS[0] + 9.0 * MOMENTS[1] + MOMENTS[2]);
    [
        (found - expected).norm() / expected.norm(),
        (energy - kinetic).abs() / kinetic,
    ]
}

#[test]
fn tumbling_converges_with_the_square_of_the_increment() {
    let counts = [40, 80, 160];
    let errors = counts.map(tumbled);
    let sizes = counts.map(|count| 1.0 / count as f64);
    for at in 0..2 {
        let errors = errors.map(|error| error[at]);
        let rate = fitted_rate(&sizes, &errors);
        assert!(rate > 1.8, "rate {rate}: {errors:?}");
    }
}

#[test]
fn a_torque_spins_a_body_up() {
    let mut model = lonely();
    let mut step = moving(2.0, 160);
    let mut motion = top([
        Freedom::AsBefore,
        Freedom::AsBefore,
        Freedom::AsBefore,
        Freedom::AsBefore,
        Freedom::Free,
        Freedom::AsBefore,
    ]);
    motion.torque = Some(Vec3::new(0.0, 1.4, 0.0));
    step.rigid_motions = vec![motion];
    model.steps.push(step);
    let run = Run::completed(model);
    let turned = run.last().rigid[0].turned;
    // 1/2 (M/J) t^2 = 4
    assert!((turned.y - 4.0).abs() < 1e-2, "{turned}");
    let energies = run.last().energies;
    assert!(
        energies.imbalance().abs() < 1e-9 * energies.external,
        "{energies:?}"
    );
    assert!((energies.external - 1.4 * 4.0).abs() < 0.02, "{energies:?}");
}

/// A column of rubber with its top tied to a rigid body.
fn column() -> Model {
    let mesh = block([0.0; 3], [1.0, 1.0, 2.0], [2, 2, 3]).mesh().unwrap();
    let mut model = model(vec![body("column", mesh, rubber(1.0, 0.3))]);
    let mut rigid = RigidSurface::new("plate", RigidShape::Bare);
    rigid.reference = Vec3::new(0.5, 0.5, 2.0);
    rigid.ties = vec![(BodyId(0), model.nodes("column", "zmax"))];
    model.rigid_surfaces.push(rigid);
    model
}

#[test]
fn ties_act_as_prescribed_nodes_do() {
    let mut tied = column();
    let mut first = step();
    first.increments = increments(0.25, 0.2);
    first.displacements = vec![tied.hold("column", "zmin", [Some(0.0); 3])];
    let target = [0.1, -0.05, -0.1, 0.0, 0.0, 0.4];
    let mut motion = top(target.map(Freedom::To));
    motion.curve = Curve::Ramp;
    first.rigid_motions = vec![motion];
    tied.steps.push(first);
    let run = Run::completed(tied);
    let state = run.last();
    let wrench = state.forces.rigid[0];
    // The other end carries the opposite.
    let problem = &run.problem;
    let (mut force, mut moment) = (Vec3::zeros(), Vec3::zeros());
    for node in problem.model.nodes("column", "zmin") {
        force += state.forces.reaction[problem.node(0, node)];
        moment += state.positions[problem.node(0, node)]
            .cross(&state.forces.reaction[problem.node(0, node)]);
    }
    let point = Vec3::new(0.6, 0.45, 1.9);
    assert!(wrench.force.norm() > 0.05);
    assert!((wrench.force + force).norm() < 1e-9, "{wrench:?} {force}");
    let opposite = wrench.torque + point.cross(&wrench.force);
    assert!((opposite + moment).norm() < 1e-9, "{opposite} {moment}");
    let energies = state.energies;
    assert!(energies.imbalance().abs() < 1e-9 * energies.external);
    assert!(
        energies.numerical.abs() < 0.05 * energies.external,
        "{energies:?}"
    );

    // Freed, the plate goes back.
    let mut freed = column();
    freed.steps = run.problem.model.steps.clone();
    let mut second = step();
    second.increments = increments(0.5, 0.1);
    second.rigid_motions = vec![top(FREE)];
    freed.steps.push(second);
    let freed = Run::of(freed);
    let back = freed.last().rigid[0];
    assert!(
        back.displacement.norm() < 1e-6 && back.turned.norm() < 1e-6,
        "{back:?}"
    );
}

#[test]
fn newton_ends_quadratically_with_free_ties() {
    let mut model = column();
    let mut step = step();
    step.displacements = vec![model.hold("column", "zmin", [Some(0.0); 3])];
    let mut motion = top(FREE);
    motion.force = Some(Vec3::new(0.005, 0.002, -0.02));
    motion.torque = Some(Vec3::new(0.0, 0.003, 0.005));
    step.rigid_motions = vec![motion];
    model.steps.push(step);
    let run = Run::completed(model);
    let norms: Vec<f64> = run.iterations[0].iter().map(|n| n.largest()).collect();
    assert!(norms.len() <= 7, "{norms:?}");
    let tail = &norms[norms.len() - 3..];
    assert!(tail[2] < 1e3 * tail[1] * tail[1] + 1e-11, "{norms:?}");
}
