//! Balance of the work of actuation.

use nalgebra::Matrix3;
use striae_law::bulk::{
    Branch, Hardening, Hyperelastic, Isochoric, LameConstants, Material, Plastic, Viscoelastic,
    Volumetric,
};
use striae_mesh::Vec3;
use striae_model::{ActuationKind, Curve, Formulation, LoadExtent, LoadKind, Model};
use striae_verify::fitted_rate;

use crate::{
    FORMULATIONS, bar, dynamic,
    scene::{Places, Run, increments, rubber},
};

fn materials() -> [Material; 3] {
    let isochoric = Isochoric::NeoHookean { shear: 0.4 };
    let slow = Hyperelastic::new(isochoric, 2.0, Volumetric::Logarithmic).unwrap();
    let branch = Branch {
        ratio: 0.7,
        time: 0.5,
    };
    let constants = LameConstants::from_youngs_modulus(1.0, 0.3).unwrap();
    let hardening = Hardening::linear(0.02, 0.1).unwrap();
    [
        rubber(1.0, 0.3),
        Material::viscoelastic(Viscoelastic::new(slow, &[branch]).unwrap()),
        Material::plastic(Plastic::new(constants, hardening)),
    ]
}

/// A bar that grows in general directions, and pulls, between its ends and under a load across.
fn held(material: Material, formulation: Formulation, count: usize) -> Model {
    let strain = Matrix3::new(0.1, 0.03, 0.0, 0.03, -0.05, 0.02, 0.0, 0.02, 0.08);
    let (along, value) = (Vec3::new(0.6, 0.0, 0.8), 0.05);
    let kinds = [
        ActuationKind::Strain(strain),
        ActuationKind::Tension { along, value },
    ];
    let mut model = bar(material, formulation, &kinds);
    model.bodies[0].density = 1e-3;
    let end = model.hold("bar", "zmax", [None, Some(0.0), Some(0.0)]);
    let kind = LoadKind::DeadTraction(Vec3::x() * 0.01);
    let load = model.load("bar", "xmax", kind, LoadExtent::Whole);
    let step = &mut model.steps[0];
    step.displacements.push(end);
    step.loads.push(load);
    step.increments = increments(1.0 / count as f64, 1e-3);
    let mut back = step.clone();
    for actuation in &mut back.actuations {
        actuation.curve = Curve::Smooth;
        actuation.kind = match actuation.kind {
            ActuationKind::Strain(strain) => ActuationKind::Strain(strain * -0.5),
            ActuationKind::Tension { along, .. } => ActuationKind::Tension { along, value: 0.1 },
            other => other,
        };
    }
    model.steps.push(back);
    model
}

#[test]
fn no_energy_is_lost_at_rest_or_in_motion() {
    for material in materials() {
        // Enhanced elements that flow plastically all over can buckle under what holds them.
        let is_plastic = material.yields();
        let count = if is_plastic { 2 } else { 3 };
        for &formulation in &FORMULATIONS[..count] {
            let still = held(material.clone(), formulation, 4);
            let mut moving = still.clone();
            moving.steps = moving.steps.iter().map(dynamic).collect();
            for model in [still, moving] {
                let run = Run::of(model);
                assert_eq!(run.ending, striae_solve::outcome::Ending::Completed);
                for state in &run.states {
                    let energies = state.energies;
                    assert!(energies.imbalance().abs() < 1e-10, "{energies:?}");
                }
                assert!(run.last().energies.actuation.abs() > 1e-4);
            }
        }
    }
}

#[test]
fn what_is_lost_to_the_increments_falls_with_their_square() {
    let counts = [4, 8, 16];
    for formulation in FORMULATIONS {
        let lost = counts.map(|count| {
            let run = Run::of(held(rubber(1.0, 0.3), formulation, count));
            run.last().energies.numerical.abs()
        });
        let rate = fitted_rate(&counts.map(|count| 1.0 / count as f64), &lost);
        assert!(rate > 1.8, "{formulation:?} {rate} {lost:?}");
    }
}

#[test]
fn actuation_at_once_in_motion_stores_what_it_works() {
    for kind in [
        ActuationKind::isotropic(0.1),
        ActuationKind::Tension {
            along: Vec3::z(),
            value: 0.2,
        },
    ] {
        let mut model = bar(rubber(1.0, 0.3), Formulation::Standard, &[kind]);
        model.bodies[0].density = 1.0;
        model.steps[0] = dynamic(&model.steps[0]);
        model.steps[0].actuations[0].curve = Curve::Constant;
        model.steps[0].increments = increments(0.02, 1e-3);
        let run = Run::of(model);
        let energies = run.last().energies;
        assert!(energies.imbalance().abs() < 1e-10, "{energies:?}");
        let [kinetic, lost] = [energies.kinetic, energies.numerical];
        assert!(energies.actuation > 0.0 && kinetic > 0.0, "{energies:?}");
        assert!(lost.abs() < 0.1 * energies.actuation, "{energies:?}");
    }
}
