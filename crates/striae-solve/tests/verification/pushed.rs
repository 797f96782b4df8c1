//! Rigid bodies that contact pushes, turns and rolls.

use crate::{
    dynamics::moving,
    scene::{Places, Run, block, body, coulomb, increments, model, rubber, step},
};
use striae_mesh::{NodeId, Vec3};
use striae_model::{
    BodyId, Curve, Freedom, Model, Mover, RigidId, RigidInertia, RigidMotion, RigidShape, Velocity,
};
use striae_solve::{
    dynamics::momentum,
    outcome::Ending,
    report::{pairs, reactions, rigid_bodies},
};

const FREE: [Freedom; 6] = [Freedom::Free; 6];
const HELD: [Freedom; 6] = [Freedom::AsBefore; 6];
const RADIUS: f64 = 1.0;
const TOP: f64 = 0.5;

fn motion(coordinates: [Freedom; 6]) -> RigidMotion {
    RigidMotion {
        surface: RigidId(0),
        coordinates,
        force: None,
        torque: None,
        curve: Curve::Ramp,
    }
}

/// The lower part of a surface of revolution about `z` or of a cylinder along `y`.
fn round(crown: f64, count: usize) -> RigidShape {
    let share = |i: usize| 2.0 * i as f64 / count as f64 - 1.0;
    let positions = (0..(count + 1) * (count + 1)).map(|k| {
        let (u, v) = (0.9 * share(k % (count + 1)), 0.9 * share(k / (count + 1)));
        let across = Vec3::new(RADIUS * u.sin(), v, -RADIUS * u.cos());
        let height = crown * (1.0 - v.cos()) * RADIUS;
        Vec3::new(0.5, 0.5, TOP + RADIUS) + across + Vec3::z() * height
    });
    let node = |i: usize, j: usize| NodeId::new(i + (count + 1) * j);
    let facets = (0..count * count).map(|k| {
        let (i, j) = (k % count, k / count);
        [
            node(i, j),
            node(i, j + 1),
            node(i + 1, j + 1),
            node(i + 1, j),
        ]
    });
    RigidShape::Facets {
        positions: positions.collect(),
        facets: facets.collect(),
    }
}

/// A block under a round rigid body whose reference point is its centre.
fn under(shape: RigidShape, friction: f64, divisions: [usize; 3]) -> Model {
    let mesh = block([0.0; 3], [1.0, 1.0, TOP], divisions).mesh().unwrap();
    let mut model = model(vec![body("block", mesh, rubber(1.0, 0.3))]);
    model.touch_rigid(("block", "zmax"), shape, coulomb(friction));
    model.rigid_surfaces[0].reference = Vec3::new(0.5, 0.5, TOP + RADIUS);
    model
}

#[test]
fn a_pushed_body_is_in_balance() {
    let mut model = under(round(1.0, 8), 0.6, [6, 6, 2]);
    // Well below the centre of the sphere, so that it does not roll away.
    let reference = Vec3::new(0.5, 0.5, TOP + 0.2);
    model.rigid_surfaces[0].reference = reference;
    let mut press = step();
    press.increments = increments(0.5, 0.01);
    press.displacements = vec![model.hold("block", "zmin", [Some(0.0); 3])];
    let mut down = [Freedom::AsBefore; 6];
    down[2] = Freedom::To(-0.05);
    press.rigid_motions = vec![motion(down)];
    let mut push = step();
    push.increments = increments(0.25, 0.01);
    let mut free = motion(FREE);
    let force = Vec3::new(0.002, 0.001, -0.022);
    // Three nodes in a row are pressed, the outer two of which hold a spin of 2e-4.
    let torque = Vec3::new(0.0003, -0.0005, 0.0005);
    (free.force, free.torque) = (Some(force), Some(torque));
    free.curve = Curve::Constant;
    push.rigid_motions = vec![free];
    model.steps = vec![press, push];
    let run = Run::completed(model);
    let (problem, state) = (&run.problem, run.last());
    let [on_block, on_body] = pairs(problem, state)[0].sides;
    assert!((on_block.force - force).norm() < 1e-10, "{on_block:?}");
    assert!((on_body.force + force).norm() < 1e-10);
    let point = reference + state.rigid[0].displacement;
    let found = on_block.moment - point.cross(&on_block.force);
    assert!((found - torque).norm() < 1e-10, "{found} {torque}");
    assert!((rigid_bodies(problem, state)[0].torque - torque).norm() < 1e-10);
    // The block's other end holds all of it.
    let held = |name: &str| {
        let all = reactions(problem, state);
        all.iter().find(|(known, _)| known == name).unwrap().1
    };
    assert!((held("block.zmin") + force).norm() < 1e-10);
    assert!((held("floor") - force).norm() < 1e-10);
    assert!(state.rigid[0].turned.norm() > 1e-3, "{:?}", state.rigid[0]);
    for state in &run.states {
        let energies = state.energies;
        let off = energies.imbalance().abs();
        assert!(off <= 1e-8 * energies.external, "{energies:?}");
    }
    let norms = run.iterations.iter().flatten();
    assert!(norms.count() <= 8 * run.iterations.len());
}

#[test]
fn a_driven_cylinder_rolls_on_friction() {
    let mut model = under(round(0.0, 12), 0.8, [6, 4, 2]);
    let to = |x: f64, z: f64| {
        let mut coordinates = HELD;
        (coordinates[0], coordinates[2]) = (Freedom::To(x), Freedom::To(z));
        coordinates
    };
    let mut lift = step();
    lift.displacements = vec![model.hold("block", "zmin", [Some(0.0); 3])];
    lift.rigid_motions = vec![motion(to(-0.2, 0.01))];
    let mut press = step();
    press.increments = increments(0.5, 0.01);
    press.rigid_motions = vec![motion(to(-0.2, -0.01))];
    let mut roll = step();
    roll.increments = increments(0.05, 0.001);
    let mut rolling = to(0.2, -0.01);
    rolling[4] = Freedom::Free;
    roll.rigid_motions = vec![motion(rolling)];
    model.steps = vec![lift, press, roll];
    let run = Run::of(model);
    let state = run.last();
    let turned = state.rigid[0].turned;
    // Without slip at the bottom, turned . R = way.
    let ways: Vec<[f64; 2]> = run
        .states
        .iter()
        .map(|s| [s.rigid[0].displacement.x, s.rigid[0].turned.y])
        .collect();
    let rolled = turned.y * RADIUS / 0.4;
    assert!((rolled - 1.0).abs() < 0.05, "{rolled} {ways:?}");
    assert!(rigid_bodies(&run.problem, state)[0].torque.y.abs() < 1e-10);
    assert_eq!(turned.xz().norm(), 0.0);
}

/// A block and a heavy body that meet in flight, off their centres.
fn collision(count: usize) -> Run {
    let mut model = under(round(1.0, 8), 0.4, [6, 4, 2]);
    model.bodies[0].density = 1.0;
    let centre = model.rigid_surfaces[0].reference;
    let inertia = RigidInertia::aligned(0.7, centre, [0.1, 0.12, 0.14]);
    model.rigid_surfaces[0].inertia = Some(inertia);
    let mut step = moving(1.2, count);
    let velocity = |body: Mover, velocity: [f64; 3], spin: [f64; 3]| Velocity {
        body,
        velocity: velocity.into(),
        spin: spin.into(),
        about: Vec3::new(0.5, 0.5, TOP + RADIUS),
    };
    step.velocities = vec![
        velocity(Mover::Deformable(BodyId(0)), [0.0, 0.02, 0.1], [0.0; 3]),
        velocity(Mover::Rigid(RigidId(0)), [0.05, 0.0, -0.1], [0.0, 0.3, 0.2]),
    ];
    step.rigid_motions = vec![motion(FREE)];
    model.steps = vec![step];
    let run = Run::of(model);
    assert_eq!(run.ending, Ending::Completed);
    run
}

#[test]
fn a_collision_conserves_momentum_and_accounts_for_all_energy() {
    let runs = [60, 120].map(collision);
    let drifts = runs.each_ref().map(|run| {
        let (p_0, l_0) = momentum(&run.problem, &run.states[1]);
        let scale = run.states[1].energies.external;
        let mut largest: f64 = 0.0;
        for state in &run.states[1..] {
            let (p, l) = momentum(&run.problem, state);
            assert!((p - p_0).norm() < 1e-9, "{p} {p_0}");
            largest = largest.max((l - l_0).norm() / l_0.norm());
            let off = state.energies.imbalance().abs();
            assert!(off < 1e-8 * scale, "{:?}", state.energies);
        }
        let touched = run
            .states
            .iter()
            .map(|state| state.forces.pushed[0].force.norm());
        assert!(touched.fold(0.0, f64::max) > 0.01);
        let last = run.last().energies;
        assert!(last.friction > 0.0, "{last:?}");
        assert!(last.contact + last.numerical < 0.2 * scale, "{last:?}");
        largest
    });
    assert!(
        drifts[1] < 0.7 * drifts[0] && drifts[1] < 0.02,
        "{drifts:?}"
    );
}
