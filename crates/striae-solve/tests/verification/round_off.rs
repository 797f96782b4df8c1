//! Residuals that stand at round-off of the forces present, whatever the shape and the
//! stiffness of the elements.

use crate::scene::{Places, Run, block, body, increments, model, rubber, step};
use striae_mesh::Vec3;
use striae_model::{BodyId, Model, Mover, Procedure, Velocity};

/// A plate of elements eight times as wide as high, far from the origin, set spinning.
fn spinning(poissons_ratio: f64) -> Model {
    let mesh = block([3.0, 1.0, 0.0], [2.0, 2.0, 0.25], [4, 4, 4])
        .mesh()
        .unwrap();
    let mut plate = body("plate", mesh, rubber(1e3, poissons_ratio));
    plate.density = 1e-3;
    let mut model = model(vec![plate]);
    let mut step = step();
    step.procedure = Procedure::Dynamic {
        spectral_radius: 0.8,
    };
    step.duration = 0.05;
    step.increments = increments(0.1, 0.09);
    step.velocities = vec![Velocity {
        body: Mover::Deformable(BodyId(0)),
        velocity: Vec3::zeros(),
        spin: Vec3::new(0.1, 0.2, 1.0),
        about: Vec3::new(4.0, 2.0, 0.1),
    }];
    model.steps.push(step);
    model
}

#[test]
fn flat_elements_spin_without_stagnation() {
    for poissons_ratio in [0.3, 0.49] {
        let run = Run::completed(spinning(poissons_ratio));
        assert!(
            run.states.len() == 11,
            "{} increments",
            run.states.len() - 1
        );
    }
}

#[test]
fn a_slender_soft_part_comes_to_rest() {
    let slender = block([0.0, 0.0, 0.0], [0.1, 0.1, 4.0], [1, 1, 40])
        .mesh()
        .unwrap();
    let stiff = block([5.0, 0.0, 0.0], [1.0, 1.0, 1.0], [2, 2, 2])
        .mesh()
        .unwrap();
    let bodies = vec![
        body("slender", slender, rubber(1.0, 0.49)),
        body("stiff", stiff, rubber(1e3, 0.3)),
    ];
    let mut model = model(bodies);
    let mut step = step();
    step.increments = increments(0.25, 0.2);
    step.displacements = vec![
        model.hold("slender", "zmin", [Some(0.0); 3]),
        model.hold("slender", "zmax", [Some(0.3), Some(0.0), Some(-0.01)]),
        model.hold("stiff", "zmin", [Some(0.0); 3]),
        model.hold("stiff", "zmax", [Some(0.0); 3]),
    ];
    model.steps.push(step);
    let run = Run::completed(model);
    assert_eq!(run.states.len(), 5);
}
