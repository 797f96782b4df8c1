//! Bodies that move themselves, against closed forms.

#[path = "../verification/scene.rs"]
#[allow(dead_code, reason = "shared with another test program")]
mod scene;

mod bars;
mod bilayer;
mod energies;

use nalgebra::Matrix3;
use scene::{Places, block, body, increments, model, step};
use striae_law::bulk::Material;
use striae_model::{Actuation, ActuationKind, BodyId, Curve, Formulation, Model, Procedure, Step};

const FORMULATIONS: [Formulation; 3] = [
    Formulation::Standard,
    Formulation::MeanDilatation,
    Formulation::AssumedStrain,
];

/// Actuation of all of the first body along a ramp.
fn actuation(kind: ActuationKind) -> Actuation {
    Actuation {
        body: BodyId(0),
        section: None,
        kind,
        curve: Curve::Ramp,
    }
}

/// A bar of 1 x 1 x 2 that slides on three planes of symmetry, in quarters of a step.
fn bar(material: Material, formulation: Formulation, kinds: &[ActuationKind]) -> Model {
    let mesh = block([0.0; 3], [1.0, 1.0, 2.0], [2, 1, 2]).mesh().unwrap();
    let mut model = model(vec![body("bar", mesh, material)]);
    model.bodies[0].formulation = formulation;
    let mut drive = step();
    drive.increments = increments(0.25, 0.05);
    drive.displacements = vec![
        model.hold("bar", "xmin", [Some(0.0), None, None]),
        model.hold("bar", "ymin", [None, Some(0.0), None]),
        model.hold("bar", "zmin", [None, None, Some(0.0)]),
    ];
    drive.actuations = kinds.iter().copied().map(actuation).collect();
    model.steps = vec![drive];
    model
}

/// Stretch across, and stress along, of a material that is stretched along `z` alone.
fn uniaxial(material: &Material, stretch: f64) -> [f64; 2] {
    let response = |across: f64| {
        let f = Matrix3::from_diagonal(&[across, across, stretch].into());
        material.response(&f).unwrap().first_piola
    };
    let (mut low, mut high) = (0.2, 5.0);
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if response(middle)[(0, 0)] > 0.0 {
            high = middle;
        } else {
            low = middle;
        }
    }
    [low, response(low)[(2, 2)]]
}

/// Force on the bar at its end, from the reactions there.
fn force(run: &scene::Run, height: f64) -> f64 {
    let nodes = run.problem.reference.iter().enumerate();
    let end = nodes.filter(|(_, x)| x.z == height);
    let reactions = &run.last().forces.reaction;
    end.map(|(node, _)| reactions[node].z).sum()
}

/// Returns the step with inertia.
fn dynamic(step: &Step) -> Step {
    Step {
        procedure: Procedure::Dynamic {
            spectral_radius: 0.8,
        },
        ..step.clone()
    }
}
