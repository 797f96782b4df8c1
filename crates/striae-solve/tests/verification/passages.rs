//! Bodies that would go through each other in one increment.

use crate::scene::{Places, Run, block, body, coulomb, increments, model, plane, rubber, step};
use striae_contact::interference::{Kind, SHARE};
use striae_law::friction::Friction;
use striae_mesh::{NodeId, Vec3};
use striae_model::{
    BodyId, Curve, Freedom, InterferenceFit, Model, Mover, Procedure, RigidId, RigidMotion,
    RigidShape, Velocity,
};
use striae_solve::{
    interference::{between, within},
    outcome::{CutBack, Ending},
    report::pairs,
};

/// Asserts that nothing went through anything in any increment, and nothing is deep inside.
fn assert_apart(run: &Run) {
    for (states, known) in run.states.windows(2).zip(&run.interferences) {
        for (pair, known) in known.iter().enumerate() {
            let [start, end] = [&states[0], &states[1]].map(Into::into);
            let found = between(&run.problem, pair, start, end, SHARE);
            assert_eq!(&found, known, "what increments tell of themselves");
            let passed = found.iter().find(|found| {
                // A node of a coarse ball may graze a coarse plate where pressure acts beside it.
                found.kind == Kind::Crossed || found.share() > 1.0
            });
            assert!(passed.is_none(), "{passed:?} at {}", states[1].time);
            let deep = within(&run.problem, pair, end, 0.5);
            assert!(deep.is_empty(), "{:?} at {}", deep[0], states[1].time);
        }
    }
}

fn assert_completed(run: &Run) {
    let said: Vec<String> = run.cuts.iter().map(|(_, cut)| cut.to_string()).collect();
    assert_eq!(run.ending, Ending::Completed, "{}\n{said:#?}", run.ending);
    assert_apart(run);
}

/// Force on the first side of the first pair at the end.
fn force(run: &Run) -> Vec3 {
    pairs(&run.problem, run.last())[0].sides[0].force
}

#[test]
fn a_gap_is_closed_alike_in_any_number_of_increments() {
    for friction in [Friction::frictionless(), coulomb(0.3)] {
        let forces: Vec<Vec3> = [1, 2, 3, 10, 20]
            .into_iter()
            .map(|count| {
                let lower = block([0.0; 3], [1.0, 1.0, 1.0], [4, 4, 2]);
                let upper = block([0.0, 0.0, 1.4], [1.0, 1.0, 1.0], [3, 3, 2]);
                let mut model = model(vec![
                    body("lower", lower.mesh().unwrap(), rubber(1.0, 0.3)),
                    body("upper", upper.mesh().unwrap(), rubber(1.0, 0.3)),
                ]);
                model.touch(("lower", "zmax"), ("upper", "zmin"), friction.clone());
                let mut step = step();
                step.increments = increments(1.0 / f64::from(count), 1e-4);
                step.displacements = vec![
                    model.hold("lower", "zmin", [Some(0.0); 3]),
                    model.hold("upper", "zmax", [Some(0.0), Some(0.0), Some(-0.6)]),
                ];
                model.steps = vec![step];
                let run = Run::of(model);
                assert_completed(&run);
                force(&run)
            })
            .collect();
        // Where friction slips, the way matters a little. The beddings of supports that are not
        // closed wholly are those of the increment before.
        let is_rough = !friction.is_frictionless();
        let [lateral, normal] = if is_rough { [1e-5, 1e-3] } else { [1e-6, 1e-4] };
        let last = forces[4];
        for force in &forces {
            let lateral = lateral * force.z.abs();
            assert!(force.xy().norm() < lateral, "{is_rough} {forces:?}");
            assert!((force.z / last.z - 1.0).abs() < normal, "{forces:?}");
        }
    }
}

/// A thin plate that is held at its edges.
fn plate() -> Model {
    let mesh = block([-1.0, -1.0, 0.0], [2.0, 2.0, 0.1], [8, 8, 1]);
    model(vec![body("plate", mesh.mesh().unwrap(), rubber(1.0, 0.3))])
}

fn edges(model: &mut Model) {
    for set in ["xmin", "xmax", "ymin", "ymax"] {
        let hold = model.hold("plate", set, [Some(0.0); 3]);
        model.steps[0].displacements.push(hold);
    }
}

#[test]
fn a_block_does_not_cross_a_plate_in_one_increment() {
    for depth in [0.25, 0.5] {
        let mut model = plate();
        let punch = block([-0.3, -0.3, 0.2], [0.6, 0.6, 0.3], [3, 3, 2]);
        model
            .bodies
            .push(body("punch", punch.mesh().unwrap(), rubber(5.0, 0.3)));
        model.touch(("plate", "zmax"), ("punch", "zmin"), coulomb(0.2));
        let mut step = step();
        step.increments = increments(1.0, 1e-3);
        step.displacements =
            vec![model.hold("punch", "zmax", [Some(0.0), Some(0.0), Some(-0.1 - depth)])];
        model.steps = vec![step];
        edges(&mut model);
        let run = Run::of(model);
        assert_completed(&run);
        assert!(force(&run).z < -1e-4, "{}", force(&run));
    }
}

/// The skin of a ball.
fn ball(centre: Vec3, radius: f64) -> RigidShape {
    const COUNT: usize = 4;
    let (mut positions, mut facets): (Vec<Vec3>, Vec<[NodeId; 4]>) = Default::default();
    let mut node = |x: Vec3| -> NodeId {
        let x = centre + x.normalize() * radius;
        let known = positions.iter().position(|y| (x - y).norm() < 1e-9);
        NodeId::new(known.unwrap_or_else(|| {
            positions.push(x);
            positions.len() - 1
        }))
    };
    for (axis, sign) in (0..3).flat_map(|axis| [(axis, 1.0), (axis, -1.0)]) {
        let n = Vec3::ith(axis, sign);
        let u = Vec3::ith((axis + 1) % 3, 1.0);
        let v = n.cross(&u);
        for k in 0..COUNT * COUNT {
            let corner = |i: usize, j: usize| {
                let at = |k: usize| {
                    (std::f64::consts::FRAC_PI_4 * (2.0 * k as f64 / COUNT as f64 - 1.0)).tan()
                };
                n + u * at(k % COUNT + i) + v * at(k / COUNT + j)
            };
            facets.push([(0, 0), (1, 0), (1, 1), (0, 1)].map(|(i, j)| node(corner(i, j))));
        }
    }
    RigidShape::Facets { positions, facets }
}

/// A plate under a ball that moves down by `way` in one increment.
fn shot(way: f64, procedure: Procedure) -> Model {
    let mut model = plate();
    let centre = Vec3::new(0.02, 0.03, 0.6);
    model.touch_rigid(("plate", "zmax"), ball(centre, 0.3), coulomb(0.2));
    model.rigid_surfaces[0].reference = centre;
    let mut step = step();
    step.procedure = procedure;
    step.increments = increments(1.0, 1e-3);
    let mut coordinates = [Freedom::AsBefore; 6];
    coordinates[2] = Freedom::To(-way);
    step.rigid_motions = vec![RigidMotion {
        surface: RigidId(0),
        coordinates,
        force: None,
        torque: None,
        curve: Curve::Ramp,
    }];
    model.steps = vec![step];
    edges(&mut model);
    model.bodies[0].density = 1.0;
    model
}

#[test]
fn a_ball_is_not_shot_through_a_plate_in_one_increment() {
    // The gap is 0.2; beyond it the plate is dented, or the run says why not.
    for way in [0.4, 0.6] {
        let run = Run::of(shot(way, Procedure::QuasiStatic));
        assert_completed(&run);
        assert!(force(&run).z < -1e-4, "{}", force(&run));
    }
    for way in [1.2, 3.0] {
        let run = Run::of(shot(way, Procedure::QuasiStatic));
        assert_apart(&run);
        assert!(
            run.ending == Ending::Completed && force(&run).z < -1e-4
                || matches!(run.ending, Ending::Stopped { .. }),
            "{}",
            run.ending
        );
    }
}

#[test]
fn a_ball_is_not_shot_through_a_plate_in_motion() {
    for way in [0.6, 1.5] {
        let run = Run::of(shot(
            way,
            Procedure::Dynamic {
                spectral_radius: 0.5,
            },
        ));
        assert_apart(&run);
        let named = match &run.ending {
            Ending::Completed => force(&run).z < -1e-4,
            Ending::Stopped { .. } => true,
            Ending::Interrupted { .. } => false,
        };
        assert!(named, "{}", run.ending);
    }
}

#[test]
fn a_fast_block_does_not_end_behind_a_plane() {
    for speed in [1.0, 10.0, 100.0] {
        let mesh = block([0.0, 0.0, 0.1], [1.0; 3], [2, 2, 2]).mesh().unwrap();
        let mut model = model(vec![body("block", mesh, rubber(1000.0, 0.3))]);
        model.touch_rigid(
            ("block", "zmin"),
            plane([0.0; 3], [0.0, 0.0, 1.0]),
            coulomb(0.3),
        );
        model.bodies[0].density = 1.0;
        let mut step = step();
        step.procedure = Procedure::Dynamic {
            spectral_radius: 0.5,
        };
        step.duration = 0.3;
        step.increments = increments(1.0, 1e-4);
        step.velocities = vec![Velocity {
            body: Mover::Deformable(BodyId(0)),
            velocity: Vec3::new(0.0, 0.0, -speed),
            spin: Vec3::zeros(),
            about: Vec3::zeros(),
        }];
        model.steps = vec![step];
        let run = Run::of(model);
        assert_apart(&run);
        assert!(
            run.ending == Ending::Completed || speed > 50.0,
            "{}",
            run.ending
        );
        let lowest = run
            .last()
            .positions
            .iter()
            .map(|x| x.z)
            .fold(f64::INFINITY, f64::min);
        assert!(lowest > -0.1, "{speed}: {lowest}");
    }
}

#[test]
fn what_is_not_avoided_is_named() {
    // A pair that is given the wrong face of the punch never sees the other one.
    let mut model = plate();
    let punch = block([-0.3, -0.3, 0.2], [0.6, 0.6, 0.3], [3, 3, 2]);
    model
        .bodies
        .push(body("punch", punch.mesh().unwrap(), rubber(5.0, 0.3)));
    model.touch(("plate", "zmax"), ("punch", "zmax"), coulomb(0.2));
    let mut step = step();
    step.increments = increments(0.5, 0.1);
    step.displacements = vec![
        model.hold("punch", "zmax", [Some(0.0), Some(0.0), Some(-1.0)]),
        model.hold("punch", "zmin", [Some(0.0), Some(0.0), Some(-1.0)]),
    ];
    model.steps = vec![step];
    edges(&mut model);
    let run = Run::of(model);
    let Ending::Stopped { reason, .. } = &run.ending else {
        panic!("{}", run.ending);
    };
    assert!(matches!(reason, CutBack::Passage { .. }), "{reason}");
}

/// A pad over a floor at a height, with a clearance, of which faces move down by a way.
fn above(height: f64, clearance: Option<f64>, faces: &[&str], way: f64) -> Run {
    let pad = block([0.0; 3], [1.0, 1.0, 1.0], [2, 2, 2]);
    let mut model = model(vec![body("pad", pad.mesh().unwrap(), rubber(1.0, 0.3))]);
    model.touch_rigid(
        ("pad", "zmin"),
        plane([0.0, 0.0, height], [0.0, 0.0, 1.0]),
        Friction::frictionless(),
    );
    model.pairs[0].search_distance = Some(1.0);
    model.pairs[0].interference = clearance.map(|clearance| InterferenceFit {
        value: -clearance,
        curve: Curve::Constant,
    });
    let mut step = step();
    step.increments = increments(0.5, 0.5);
    let down = [Some(0.0), Some(0.0), Some(-way)];
    step.displacements = faces
        .iter()
        .map(|faces| model.hold("pad", faces, down))
        .collect();
    model.steps = vec![step];
    Run::of(model)
}

#[test]
fn bodies_are_in_each_other_by_a_clearance_before_they_touch() {
    // A floor that is lower by the clearance, and one with the clearance.
    let forces = [(-0.6, None), (0.0, Some(0.6))].map(|(height, clearance)| {
        let run = above(height, clearance, &["zmax"], 0.7);
        assert_eq!(run.ending, Ending::Completed, "{}", run.ending);
        assert!(run.interferences.iter().flatten().all(Vec::is_empty));
        force(&run).z
    });
    assert!(forces[0] > 0.0);
    assert!((forces[1] / forces[0] - 1.0).abs() < 1e-9, "{forces:?}");
}

#[test]
fn what_is_deeper_than_a_clearance_is_told() {
    let run = above(0.0, Some(0.6), &["zmin", "zmax"], 1.9);
    let Ending::Stopped { reason, .. } = run.ending else {
        panic!("{}", run.ending);
    };
    assert!(matches!(reason, CutBack::Passage { .. }), "{reason}");
}
