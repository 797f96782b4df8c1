//! Runs that end, and what they say of the cause.

use crate::scene::{Places, Run, block, body, coulomb, increments, model, plane, rubber, step};
use striae_law::{
    bulk::{LameConstants, Material},
    friction::Friction,
};
use striae_mesh::Vec3;
use striae_model::{
    BodyId, Curve, Freedom, LoadExtent, LoadKind, Model, RigidId, RigidMotion, RigidShape,
    RigidSurface,
};
use striae_solve::outcome::{CutBack, Ending, FreeMover};

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

/// A bar that is held at its foot and drawn by a thousand times its Young's modulus. Its
/// linear law goes along with that, to a thousand times its length; the smallest increment still
/// takes it a quarter of the way.
#[test]
fn loads_far_beyond_the_stiffness_are_refused_by_that_name() {
    let constants = LameConstants::from_youngs_modulus(1.0, 0.3).unwrap();
    let steel = Material::linear_elastic(constants);
    let mesh = block([0.0; 3], [1.0, 1.0, 4.0], [1, 1, 4]).mesh().unwrap();
    let mut model = model(vec![body("bar", mesh, steel)]);
    let mut step = step();
    step.increments = increments(1.0, 0.2);
    step.displacements = vec![model.hold("bar", "zmin", [Some(0.0); 3])];
    let drawn = LoadKind::DeadTraction(Vec3::new(0.0, 0.0, 1e3));
    step.loads = vec![model.load("bar", "zmax", drawn, LoadExtent::Whole)];
    model.steps = vec![step];
    let run = Run::of(model);
    let CutBack::Flown { body, times, .. } = reason(&run) else {
        panic!("{}", run.ending);
    };
    assert_eq!(body, "bar");
    assert!(*times > 100.0, "{times}");
    let said = run.ending.to_string();
    assert!(said.contains("loads far exceed its stiffness"), "{said}");
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
    assert_eq!(
        motion.to_string(),
        "rigid body `hand` is free to move in `rz`"
    );
    assert!(*reached > 0.1 && *reached < 0.9, "{reached}");
}

/// A block on a narrower one, pressed by a hand that guides it off its edge.
fn driven_off(friction: Friction, force: f64, divisions: [usize; 2]) -> Model {
    let [below, above] = divisions;
    let lower = block([-0.5, -0.5, -0.5], [1.0, 1.0, 0.5], [below, below, 2]);
    let upper = block([-0.3, -0.3, 0.0], [0.6, 0.6, 0.4], [above, above, 2]);
    let mut model = model(vec![
        body("lower", lower.mesh().unwrap(), rubber(1.0, 0.3)),
        body("upper", upper.mesh().unwrap(), rubber(1.0, 0.3)),
    ]);
    model.touch(("lower", "zmax"), ("upper", "zmin"), friction);
    let mut hand = RigidSurface::new("hand", RigidShape::Bare);
    hand.reference = Vec3::new(0.0, 0.0, 0.4);
    hand.ties = vec![(BodyId(1), model.nodes("upper", "zmax"))];
    model.rigid_surfaces.push(hand);
    let motion = |x: f64| {
        let mut coordinates = [Freedom::AsBefore; 6];
        coordinates[0] = Freedom::To(x);
        coordinates[2] = Freedom::Free;
        RigidMotion {
            surface: RigidId(0),
            coordinates,
            force: Some(Vec3::new(0.0, 0.0, -force)),
            torque: None,
            curve: Curve::Ramp,
        }
    };
    let hold = model.hold("lower", "zmin", [Some(0.0); 3]);
    let mut press = step();
    press.displacements = vec![hold];
    press.rigid_motions = vec![motion(0.0)];
    let mut slide = step();
    slide.name = "slide".to_owned();
    slide.increments = increments(0.05, 1e-3);
    slide.rigid_motions = vec![motion(1.0)];
    model.steps = vec![press, slide];
    model
}

/// Body that comes loose at the end, and the fraction of the path at which it does.
fn let_go(run: &Run) -> (FreeMover, String, f64) {
    let CutBack::Released { pair, motion } = reason(run) else {
        panic!("{}\n{:#?}", run.ending, run.cuts);
    };
    assert_eq!(pair, "interface");
    let said = run.ending.to_string();
    let remedies = [
        "prescribe displacements",
        "stabilise = true",
        "dynamics = {}",
    ];
    assert!(
        remedies.iter().all(|remedy| said.contains(remedy)),
        "{said}"
    );
    let last = run.progress.last().expect("it gets near the edge");
    (motion.mover.clone(), motion.motions.clone(), last.fraction)
}

#[test]
fn a_hand_that_drives_a_block_off_an_edge_is_let_go_by_name() {
    let hand = FreeMover::Rigid("hand".to_owned());
    for friction in [Friction::frictionless(), coulomb(0.3)] {
        for (force, divisions) in [(1e-3, [4, 3]), (1e-3, [3, 4]), (1e-2, [4, 3])] {
            let run = Run::of(driven_off(friction.clone(), force, divisions));
            let (mover, motions, reached) = let_go(&run);
            assert_eq!((mover, &*motions), (hand.clone(), "in `z`"));
            // The overlap ends at 0.8; friction and load shear and squeeze the block.
            assert!(reached > 0.75 && reached < 0.95, "{reached}");
        }
    }
}

#[test]
fn a_guided_block_that_loads_press_is_let_go_by_name() {
    for friction in [Friction::frictionless(), coulomb(0.3)] {
        let mut model = driven_off(friction, 0.0, [4, 3]);
        model.rigid_surfaces.clear();
        let guided = |x| model.hold("upper", "zmax", [Some(x), Some(0.0), None]);
        let hold = model.hold("lower", "zmin", [Some(0.0); 3]);
        let press = model.load("upper", "zmax", LoadKind::Pressure(3e-3), LoadExtent::Whole);
        let displacements = [vec![hold, guided(0.0)], vec![guided(1.0)]];
        let loads = [vec![press], Vec::new()];
        for ((step, displacements), loads) in model.steps.iter_mut().zip(displacements).zip(loads) {
            step.rigid_motions.clear();
            step.displacements = displacements;
            step.loads = loads;
        }
        let (mover, motions, reached) = let_go(&Run::of(model));
        assert_eq!(mover, FreeMover::Body("upper".to_owned()));
        assert!(motions.contains("along z"), "{motions}");
        assert!(reached > 0.4 && reached < 0.95, "{reached}");
    }
}

#[test]
fn a_block_that_is_pulled_off_is_let_go_by_name() {
    let mut model = driven_off(coulomb(0.3), 1e-3, [4, 3]);
    let mut motion = model.steps[0].rigid_motions[0].clone();
    motion.force = Some(Vec3::new(0.0, 0.0, 1e-3));
    model.steps[1].rigid_motions = vec![motion];
    let (_, motions, reached) = let_go(&Run::of(model));
    assert_eq!(motions, "in `z`");
    assert!((reached - 0.5).abs() < 2e-3, "{reached}");
}

/// A block on a wider one, over whose edge it stands, pressed by its own dead load.
fn overhanging(over: f64) -> Model {
    let lower = block([0.0; 3], [1.2, 1.1, 0.5], [3, 3, 1]);
    let upper = block([0.1, -over, 0.5], [0.75, 0.5, 0.3], [4, 6, 2]);
    let mut model = model(vec![
        body("lower", lower.mesh().unwrap(), rubber(100.0, 0.3)),
        body("upper", upper.mesh().unwrap(), rubber(100.0, 0.3)),
    ]);
    model.touch(("lower", "zmax"), ("upper", "zmin"), coulomb(0.3));
    let mut step = step();
    step.increments = increments(0.2, 1e-3);
    step.displacements = vec![model.hold("lower", "zmin", [Some(0.0); 3])];
    let down = LoadKind::DeadTraction(Vec3::new(0.0, 0.0, -0.1));
    step.loads = vec![model.load("upper", "zmax", down, LoadExtent::Whole)];
    model.steps = vec![step];
    model
}

#[test]
fn a_block_with_its_load_beside_its_base_tips_by_name() {
    assert_eq!(Run::of(overhanging(0.1)).ending, Ending::Completed);
    let run = Run::of(overhanging(0.3));
    let CutBack::Tips {
        body, other, pair, ..
    } = reason(&run)
    else {
        panic!("{}", run.ending);
    };
    let names = [body, other, pair].map(String::as_str);
    assert_eq!(names, ["upper", "lower", "interface"]);
}

/// A block on another one, pressed by a traction and then pushed along by one.
fn pushed(along: f64) -> Model {
    let lower = block([0.0; 3], [2.0, 2.0, 0.5], [4, 4, 1]);
    let upper = block([0.5, 0.5, 0.5], [1.0, 1.0, 0.5], [3, 5, 2]);
    let mut model = model(vec![
        body("lower", lower.mesh().unwrap(), rubber(100.0, 0.0)),
        body("upper", upper.mesh().unwrap(), rubber(100.0, 0.3)),
    ]);
    model.touch(("lower", "zmax"), ("upper", "zmin"), coulomb(0.3));
    let load = |model: &Model, vector: Vec3| {
        model.load(
            "upper",
            "zmax",
            LoadKind::DeadTraction(vector),
            LoadExtent::Whole,
        )
    };
    let (mut press, mut push) = (step(), step());
    press.increments = increments(0.25, 1e-3);
    press.displacements = vec![model.hold("lower", "zmin", [Some(0.0); 3])];
    press.loads = vec![load(&model, Vec3::new(0.0, 0.0, -1.0))];
    push.name = "push".to_owned();
    push.increments = increments(0.2, 1e-3);
    push.loads = vec![load(&model, Vec3::new(along, 0.0, -1.0))];
    model.steps = vec![press, push];
    model
}

#[test]
fn loads_beyond_friction_from_the_start_end_at_the_limit_of_friction() {
    // Pressed and pushed at once, in a fixed ratio: held below it, and in no increment above it.
    let proportional = |along: f64| {
        let mut model = pushed(along);
        let step = model.steps.remove(0);
        model.steps[0].displacements = step.displacements;
        model
    };
    assert_eq!(Run::of(proportional(0.2)).ending, Ending::Completed);
    let run = Run::of(proportional(0.4));
    let CutBack::Slides {
        body,
        other,
        pair,
        largest,
        reached,
    } = reason(&run)
    else {
        panic!("{}", run.ending);
    };
    let names = [body, other, pair].map(String::as_str);
    assert_eq!(names, ["upper", "lower", "interface"]);
    assert_eq!([*largest, *reached], [0.3, 0.0]);
}

#[test]
fn a_traction_beyond_friction_ends_at_the_limit_of_friction() {
    let run = Run::of(pushed(0.4));
    let CutBack::FrictionLimit { pair, reached, .. } = reason(&run) else {
        panic!("{}", run.ending);
    };
    assert_eq!(pair, "interface");
    assert!((reached * 0.4 / 0.3 - 1.0).abs() < 0.02, "{reached}");
}
