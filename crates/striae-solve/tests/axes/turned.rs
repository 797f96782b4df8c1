//! Models turned in space against what they were before.

use nalgebra::{Matrix3, Rotation3};
use striae_law::friction::Friction;
use striae_mesh::Vec3;
use striae_model::{Axes, Curve, Gravity, LoadExtent, LoadKind, Model, Procedure};
use striae_solve::report::reactions;

use crate::scene::{Places, Run, block, body, coulomb, increments, model, rubber, step};

/// A rotation about no axis of the model.
fn rotation() -> Matrix3<f64> {
    *Rotation3::new(Vec3::new(0.5, -0.3, 0.7)).matrix()
}

/// The model turned in space, with displacements in turned axes.
fn turned(mut model: Model) -> Model {
    let r = rotation();
    for body in &mut model.bodies {
        body.mesh.positions.iter_mut().for_each(|x| *x = r * *x);
    }
    for step in &mut model.steps {
        if let Some(gravity) = &mut step.gravity {
            gravity.acceleration = r * gravity.acceleration;
        }
        for condition in &mut step.displacements {
            let only_z = matches!(condition.components, [None, None, Some(_)]);
            condition.axes = match only_z {
                true => Axes::Normal(r.column(2) * 2.0),
                false => Axes::Skew {
                    x: r.column(0) * 0.5,
                    y: r.column(1) + r.column(0),
                },
            };
            if only_z {
                condition.components.swap(0, 2);
            }
        }
        for load in &mut step.loads {
            if let LoadKind::DeadTraction(t) = &load.kind {
                let t = t.map(|component| component.number().unwrap());
                load.kind = LoadKind::DeadTraction((r * t).map(Into::into));
            }
        }
    }
    model
}

/// Derivative of velocities by positions of time integration with increments of 0.1.
const VELOCITY: f64 = 20.0;

/// Asserts that a model gives the same states and reactions turned in space.
fn assert_turns(model: Model, iterative: bool) {
    let run = |model| match iterative {
        true => Run::iterated(model),
        false => Run::completed(model),
    };
    let (plain, turned) = (run(model.clone()), run(turned(model)));
    assert_eq!(plain.states.len(), turned.states.len());
    let r = rotation();
    for (a, b) in plain.states.iter().zip(&turned.states) {
        for (a, b, scale) in [
            (&a.positions, &b.positions, 1.0),
            (&a.velocities, &b.velocities, VELOCITY),
            (&a.forces.contact, &b.forces.contact, 1.0),
        ] {
            let errors = a.iter().zip(b).map(|(a, b)| (r * a - b).norm());
            let error = errors.fold(0.0, f64::max);
            assert!(error < 1e-12 * scale, "{error:e}");
        }
        let [a, b] = [a, b].map(|state| &state.energies);
        for (a, b) in [
            (a.external, b.external),
            (a.numerical, b.numerical),
            (a.strain, b.strain),
        ] {
            assert!((a - b).abs() < 1e-12, "{a:e} {b:e}");
        }
    }
    let told = |run: &Run| reactions(&run.problem, run.last());
    for ((name, a), (_, b)) in told(&plain).iter().zip(told(&turned)) {
        assert!((r * a - b).norm() < 1e-11, "{name}: {a} {b}");
    }
}

/// A block on a frictionless rest, pressed at the top and held against sliding at one side.
fn on_a_rest() -> Model {
    let mesh = block([0.0; 3], [1.0, 0.8, 1.2], [3, 2, 3]).mesh().unwrap();
    let mut model = model(vec![body("block", mesh, rubber(1.0, 0.3))]);
    model.bodies[0].density = 1.0;
    let mut press = step();
    press.increments = increments(0.5, 0.1);
    press.displacements = vec![
        model.hold("block", "zmin", [None, None, Some(0.0)]),
        model.hold("block", "xmin", [Some(0.05), Some(0.0), None]),
    ];
    press.loads = vec![
        model.load("block", "zmax", LoadKind::Pressure(0.1), LoadExtent::Whole),
        model.load(
            "block",
            "xmax",
            LoadKind::DeadTraction(Vec3::new(0.03, 0.02, -0.01)),
            LoadExtent::Whole,
        ),
    ];
    model.steps = vec![press];
    model
}

#[test]
fn a_block_on_an_inclined_rest_is_one_on_a_level_rest() {
    assert_turns(on_a_rest(), false);
}

#[test]
fn an_iterative_solver_finds_it_too() {
    assert_turns(on_a_rest(), true);
}

#[test]
fn it_moves_alike_with_inertia() {
    let mut model = on_a_rest();
    let step = &mut model.steps[0];
    step.procedure = Procedure::Dynamic {
        spectral_radius: 0.8,
    };
    step.increments = increments(0.1, 0.05);
    step.gravity = Some(Gravity {
        acceleration: Vec3::new(0.1, 0.0, -0.2),
        curve: Curve::Smooth,
    });
    step.displacements[1].curve = Curve::Smooth;
    assert_turns(model, false);
}

/// Two blocks pressed together, with a plane of symmetry through the contact.
fn pressed_together(friction: Friction) -> Model {
    let lower = block([0.0; 3], [1.0, 1.0, 0.5], [3, 2, 2]).mesh().unwrap();
    let upper = block([0.1, 0.0, 0.5], [0.8, 1.0, 0.5], [2, 2, 2]).mesh();
    let bodies = vec![
        body("lower", lower, rubber(1.0, 0.3)),
        body("upper", upper.unwrap(), rubber(3.0, 0.2)),
    ];
    let mut model = model(bodies);
    model.touch(("lower", "zmax"), ("upper", "zmin"), friction);
    let mut press = step();
    press.increments = increments(0.25, 0.05);
    press.displacements = vec![
        model.hold("lower", "zmin", [Some(0.0); 3]),
        model.hold("lower", "ymin", [None, Some(0.0), None]),
        model.hold("upper", "ymin", [None, Some(0.0), None]),
        model.hold("upper", "zmax", [Some(0.02), Some(0.0), Some(-0.03)]),
    ];
    model.steps = vec![press];
    model
}

#[test]
fn contact_beside_a_plane_of_symmetry_turns() {
    for friction in [Friction::frictionless(), coulomb(0.3), coulomb(5.0)] {
        assert_turns(pressed_together(friction), false);
    }
}
