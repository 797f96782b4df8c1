//! Bodies that viscous forces carry across a gap to contact.

use crate::scene::{Places, Run, block, body, coulomb, increments, model, plane, rubber, step};
use striae_law::friction::Friction;
use striae_mesh::{NodeId, Vec3};
use striae_model::{
    Curve, Freedom, LoadExtent, LoadKind, Model, PairId, RigidId, RigidMotion, RigidShape,
    RigidSurface,
};
use striae_solve::{
    outcome::{CutBack, Ending, FreeMover},
    report::pairs,
};

const PRESSURE: f64 = 0.01;

/// A step in which a pressure of that size grows on the top of a body.
fn press(model: &mut Model, body: &str, pressure: f64) {
    let mut step = step();
    step.increments = increments(0.1, 1e-3);
    step.loads = vec![model.load(
        body,
        "zmax",
        LoadKind::Pressure(pressure),
        LoadExtent::Whole,
    )];
    model.steps = vec![step];
}

/// A block over a floor, pressed by a pressure on its top.
fn pressed(gap: f64, friction: Friction) -> Model {
    let mesh = block([0.0, 0.0, gap], [1.0; 3], [2, 2, 2]).mesh().unwrap();
    let mut model = model(vec![body("block", mesh, rubber(1.0, 0.3))]);
    model.touch_rigid(
        ("block", "zmin"),
        plane([0.0; 3], [0.0, 0.0, 1.0]),
        friction,
    );
    model.pairs[0].stabilised = true;
    press(&mut model, "block", PRESSURE);
    model
}

/// A block over a larger one that is held, with other meshes.
fn stacked(gap: f64) -> Model {
    let lower = block([-0.2, -0.2, 0.0], [1.4, 1.4, 0.5], [4, 4, 2]);
    let upper = block([0.0, 0.0, 0.5 + gap], [1.0, 1.0, 0.6], [3, 3, 2]);
    let mut model = model(vec![
        body("lower", lower.mesh().unwrap(), rubber(1.0, 0.3)),
        body("upper", upper.mesh().unwrap(), rubber(2.0, 0.2)),
    ]);
    model.touch(("lower", "zmax"), ("upper", "zmin"), coulomb(0.4));
    model.pairs[0].stabilised = true;
    press(&mut model, "upper", PRESSURE);
    model.steps[0].displacements = vec![model.hold("lower", "zmin", [Some(0.0); 3])];
    model
}

/// Asserts the properties common to all stabilised runs: they complete, energy is balanced, forces
/// are opposite, and no stabilising force remains at the end of the step.
fn assert_lawful(run: &Run) {
    let said: Vec<String> = run.cuts.iter().map(|(_, cut)| cut.to_string()).collect();
    assert_eq!(run.ending, Ending::Completed, "{}\n{said:#?}", run.ending);
    let mut resisted = 0.0;
    for (before, state) in run.states.iter().zip(&run.states[1..]) {
        let energies = state.energies;
        let off = energies.imbalance().abs();
        assert!(off <= 1e-9 * energies.external, "{energies:?}");
        assert!(energies.stabilisation >= before.energies.stabilisation);
        let nodes: Vec3 = state.forces.stabilisation.iter().sum();
        let bodies: Vec3 = state.forces.stabilised.iter().map(|w| w.force).sum();
        let largest = state.forces.stabilisation.iter().map(|f| f.norm());
        resisted = largest.fold(resisted, f64::max);
        assert!((nodes + bodies).norm() <= 1e-14);
    }
    assert!(resisted > 0.0);
    let last = &run.last().forces;
    assert!(last.stabilisation.iter().all(|f| *f == Vec3::zeros()));
}

/// Largest distance of two states of bodies of which the last one starts by `gap` higher.
fn apart(far: &Run, near: &Run) -> f64 {
    let (x, y) = (&far.last().positions, &near.last().positions);
    let off = x.iter().zip(y).map(|(x, y)| (x - y).norm());
    off.fold(0.0, f64::max)
}

#[test]
fn a_block_pressed_across_a_gap_ends_as_one_that_touched() {
    for gap in [1e-6, 0.1, 0.7, 5.0] {
        let far = Run::of(pressed(gap, coulomb(0.3)));
        assert_lawful(&far);
        let mut near = pressed(0.0, coulomb(0.3));
        near.pairs[0].stabilised = false;
        let near = Run::completed(near);
        assert!(apart(&far, &near) < 1e-10, "{gap} {:e}", apart(&far, &near));
        assert!(far.cuts.is_empty(), "{:?}", far.cuts);
        // What the load loses on its way is that of the first increment.
        let energies = far.last().energies;
        let most = 2e-3 * PRESSURE * gap;
        assert!(energies.stabilisation < most + 1e-8, "{energies:?}");
    }
}

#[test]
fn a_stiff_or_soft_block_under_any_load_comes_to_rest() {
    for (pressure, gap) in [
        (1e-6, 0.1),
        (1e-3, 0.1),
        (0.1, 0.1),
        (0.1, 1e-3),
        (0.3, 1.0),
    ] {
        let mut model = pressed(gap, coulomb(0.3));
        press(&mut model, "block", pressure);
        let run = Run::of(model);
        assert_lawful(&run);
        let force = pairs(&run.problem, run.last())[0].sides[0].force;
        assert!((force.z - pressure).abs() < 0.2 * pressure, "{force}");
    }
}

#[test]
fn a_block_pressed_on_another_block_ends_as_one_that_touched() {
    let mut near = stacked(0.0);
    near.pairs[0].stabilised = false;
    let near = Run::of(near);
    assert_eq!(near.ending, Ending::Completed, "{}", near.ending);
    for gap in [0.05, 0.4, 2.0] {
        let far = Run::of(stacked(gap));
        assert_lawful(&far);
        let [a, b] = pairs(&far.problem, far.last())[0].sides;
        assert!((a.force + b.force).norm() < 1e-12);
        assert!(
            (b.force.z - PRESSURE).abs() < 1e-2 * PRESSURE,
            "{}",
            b.force
        );
        // Friction remembers the way by which it came.
        assert!(apart(&far, &near) < 1e-4, "{gap} {:e}", apart(&far, &near));
    }
}

#[test]
fn stabilisation_does_not_alter_a_body_that_is_held() {
    let run = |stabilised: bool| {
        let mut model = pressed(0.0, coulomb(0.3));
        model.pairs[0].stabilised = stabilised;
        model.steps[0].increments = increments(0.002, 1e-3);
        model.steps[0].loads[0].kind = LoadKind::Pressure(1e-3).into();
        Run::of(model)
    };
    let (with, without) = (run(true), run(false));
    assert_lawful(&with);
    let energies = with.last().energies;
    assert!(energies.stabilisation < 1e-4 * energies.strain);
    assert!(apart(&with, &without) < 1e-9);
}

/// The lower half of a sphere.
fn sphere(centre: Vec3, radius: f64) -> RigidShape {
    const RINGS: usize = 5;
    const ROUND: usize = 12;
    let mut positions = vec![centre - Vec3::z() * radius];
    for ring in 1..=RINGS {
        let polar = 1.2 * ring as f64 / RINGS as f64;
        for k in 0..ROUND {
            let round = std::f64::consts::TAU * k as f64 / ROUND as f64;
            let (s, c) = (polar.sin(), polar.cos());
            positions.push(centre + Vec3::new(s * round.cos(), s * round.sin(), -c) * radius);
        }
    }
    let node = |ring: usize, k: usize| match ring {
        0 => NodeId::new(0),
        _ => NodeId::new(1 + (ring - 1) * ROUND + k % ROUND),
    };
    let mut facets = Vec::new();
    for ring in 0..RINGS {
        for k in 0..ROUND {
            let [a, b] = [node(ring, k), node(ring, k + 1)];
            let [d, c] = [node(ring + 1, k), node(ring + 1, k + 1)];
            facets.push(if ring == 0 {
                [a, c, d, d]
            } else {
                [a, b, c, d]
            });
        }
    }
    RigidShape::Facets { positions, facets }
}

/// A rigid sphere with six free coordinates over a block, driven down by a force.
fn dropped(gap: f64) -> Model {
    let mesh = block([-0.5, -0.5, 0.0], [1.0, 1.0, 0.5], [6, 6, 3])
        .mesh()
        .unwrap();
    let mut model = model(vec![body("block", mesh, rubber(1.0, 0.3))]);
    let centre = Vec3::new(0.01, 0.02, 0.5 + 0.6 + gap);
    model.touch_rigid(("block", "zmax"), sphere(centre, 0.6), coulomb(0.5));
    model.rigid_surfaces[0].reference = centre - Vec3::z() * 0.55;
    model.pairs[0].stabilised = true;
    model.solver.largest_iterations = 40;
    let mut step = step();
    step.increments = increments(0.1, 1e-4);
    step.displacements = vec![model.hold("block", "zmin", [Some(0.0); 3])];
    step.rigid_motions = vec![RigidMotion {
        surface: RigidId(0),
        coordinates: [Freedom::Free; 6],
        force: Some(Vec3::new(0.0, 0.0, -0.02)),
        torque: None,
        curve: Curve::Ramp,
    }];
    model.steps = vec![step];
    model
}

#[test]
fn a_free_rigid_sphere_drops_on_a_block() {
    let ends: Vec<f64> = [0.02, 0.3]
        .into_iter()
        .map(|gap| {
            let run = Run::of(dropped(gap));
            assert_lawful(&run);
            let force = pairs(&run.problem, run.last())[0].sides[0].force;
            assert!(
                (force - Vec3::new(0.0, 0.0, -0.02)).norm() < 1e-9,
                "{force}"
            );
            let pose = run.last().rigid[0];
            pose.displacement.z + gap
        })
        .collect();
    // How it turns depends on how it came, and so does its height by the rise of a facet.
    let rise = 0.6 * (1.0 - (0.5_f64 * 1.2 / 5.0).cos());
    assert!((ends[1] - ends[0]).abs() < rise, "{ends:?}");
}

#[test]
fn a_body_that_is_pulled_away_ends_by_name() {
    let mut model = pressed(0.1, coulomb(0.3));
    press(&mut model, "block", -PRESSURE);
    let run = Run::of(model);
    let Ending::Stopped { reason, .. } = &run.ending else {
        panic!("{}", run.ending);
    };
    let CutBack::NotBridged { pair, motion, gap } = reason else {
        panic!("{reason}");
    };
    assert_eq!(pair, "interface");
    assert_eq!(motion.mover, FreeMover::Body("block".to_owned()));
    assert!(*gap > 0.1);
}

#[test]
fn what_contact_does_not_hold_is_named_at_the_end_of_the_step() {
    let run = Run::of(pressed(0.1, Friction::frictionless()));
    let Ending::Stopped { reason, .. } = &run.ending else {
        panic!("{}", run.ending);
    };
    let CutBack::NotBridged { motion, gap, .. } = reason else {
        panic!("{reason}");
    };
    assert_eq!(motion.motions, "along x, along y and about z");
    assert_eq!(*gap, 0.0);
}

#[test]
fn a_free_body_is_advised_to_be_stabilised_where_that_helps() {
    let advice = |gap: f64, friction: Friction| {
        let mut model = pressed(gap, friction);
        model.pairs[0].stabilised = false;
        let run = Run::of(model);
        match &run.ending {
            Ending::Stopped {
                reason: CutBack::Free { stabilise, .. },
                ..
            } => stabilise.clone(),
            other => panic!("{other}"),
        }
    };
    assert_eq!(advice(0.1, coulomb(0.3)), Some("interface".to_owned()));
    // Without friction it would go on being free along the floor.
    assert_eq!(advice(0.1, Friction::frictionless()), None);
    // A wall that is stabilised does not help a floor that is not.
    let mut model = pressed(0.1, coulomb(0.3));
    let wall = RigidSurface::new("wall", plane([2.0, 0.0, 0.0], [-1.0, 0.0, 0.0]));
    model.rigid_surfaces.push(wall);
    let mut pair = model.pairs[PairId(0).0].clone();
    pair.name = "wall".to_owned();
    pair.stabilised = false;
    pair.b = striae_model::ContactSurface::Rigid(RigidId(1));
    model.pairs.push(pair);
    assert_eq!(Run::of(model).ending, Ending::Completed);
}
