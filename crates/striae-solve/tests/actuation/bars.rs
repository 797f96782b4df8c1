//! Bars and blocks whose stress is uniform.

use nalgebra::Matrix3;
use striae_law::bulk::{Direction, FibreStiffness, Fibres, Fibrous, Material};
use striae_mesh::Vec3;
use striae_model::{
    ActuationKind, BodySection, ContactSurface, Formulation, LoadExtent, LoadKind, Pair, RigidId,
    RigidSurface,
};

use crate::{
    FORMULATIONS, bar, force,
    scene::{Places, Run, coulomb, plane, rubber},
    uniaxial,
};

#[test]
fn a_free_bar_takes_its_new_shape_without_stress() {
    let strain = Matrix3::from_diagonal(&[0.3, -0.2, 0.1].into());
    for formulation in FORMULATIONS {
        let kinds = [
            ActuationKind::Strain(strain),
            ActuationKind::Thermal {
                expansion: 1e-3,
                temperature: 50.0,
            },
        ];
        let run = Run::completed(bar(rubber(1.0, 0.3), formulation, &kinds));
        let growth = Matrix3::identity() * 1.05 + strain;
        for (x, at_rest) in run.positions(0).iter().zip(&run.problem.reference) {
            assert!((x - growth * at_rest).norm() < 1e-12, "{formulation:?}");
        }
        let energies = run.last().energies;
        assert!(energies.strain.abs() < 1e-14, "{energies:?}");
        let forces = &run.last().forces.internal;
        assert!(forces.iter().all(|force| force.norm() < 1e-12));
    }
}

#[test]
fn a_held_bar_has_the_stress_in_closed_form() {
    let strain = 0.2;
    for formulation in FORMULATIONS {
        let kinds = [ActuationKind::isotropic(strain)];
        let mut model = bar(rubber(1.0, 0.3), formulation, &kinds);
        let held = model.hold("bar", "zmax", [None, None, Some(0.0)]);
        model.steps[0].displacements.push(held);
        let run = Run::completed(model);
        let growth = 1.0 + strain;
        let [across, stress] = uniaxial(&rubber(1.0, 0.3), 1.0 / growth);
        let expected = growth * growth * stress;
        assert!(expected < -0.1);
        assert!((force(&run, 2.0) - expected).abs() < 1e-10);
        let widest = run.positions(0).iter().map(|x| x.x).fold(0.0, f64::max);
        assert!((widest - growth * across).abs() < 1e-10);
    }
}

#[test]
fn tension_lifts_a_weight_as_high_as_the_closed_form() {
    let (weight, tension) = (0.1, 0.25);
    let material = rubber(1.0, 0.3);
    // Of the tension T + P(l) = weight.
    let stress = weight - tension;
    let (mut low, mut high) = (0.5, 1.5);
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        if uniaxial(&material, middle)[1] > stress {
            high = middle;
        } else {
            low = middle;
        }
    }
    for formulation in FORMULATIONS {
        let along = Vec3::z();
        let value = tension;
        let kinds = [ActuationKind::Tension { along, value }];
        let mut model = bar(material.clone(), formulation, &kinds);
        let kind = LoadKind::DeadTraction(Vec3::z() * weight);
        let load = model.load("bar", "zmax", kind, LoadExtent::Whole);
        model.steps[0].loads.push(load);
        let run = Run::completed(model);
        let length = run.positions(0).iter().map(|x| x.z).fold(0.0, f64::max);
        assert!((length - 2.0 * low).abs() < 1e-9, "{formulation:?}");
    }
}

#[test]
fn fibres_pull_and_grow_as_lines_along_them() {
    let (modulus, direction) = (0.7, Vec3::new(0.0, 0.6, 0.8));
    let fibres = Fibres {
        stiffness: FibreStiffness::Linear { modulus },
        direction: Direction::Uniform(direction * 3.0),
    };
    let material = Material::fibrous(Fibrous::new(rubber(1.0, 0.3), &[fibres]).unwrap());
    let value = 0.1;
    let along = direction;
    for (of_fibres, of_lines) in [
        (
            ActuationKind::FibreTension(value),
            ActuationKind::Tension { along, value },
        ),
        (
            ActuationKind::FibreStrain(-0.1),
            ActuationKind::along(-0.1, &direction),
        ),
    ] {
        let ends = [of_fibres, of_lines].map(|kind| {
            let model = bar(material.clone(), Formulation::Standard, &[kind]);
            Run::completed(model).positions(0).to_vec()
        });
        let [one, other] = &ends;
        let length = one.iter().map(|x| x.z).fold(0.0, f64::max);
        assert!(length < 1.99);
        for (one, other) in one.iter().zip(other) {
            assert!((one - other).norm() < 1e-10);
        }
    }
}

#[test]
fn sections_grow_by_themselves_and_keep_what_steps_before_gave_them() {
    // Halves one above the other, of which the upper one grows, then both.
    let mut model = bar(rubber(1.0, 0.0), Formulation::Standard, &[]);
    let body = &model.bodies[0];
    let upper = body.mesh.elements().enumerate().filter(|(_, corners)| {
        let mut corners = corners.iter();
        corners.all(|node| body.mesh.positions[node.index()].z >= 1.0)
    });
    let elements: Vec<_> = upper
        .map(|(at, _)| striae_mesh::ElementId::new(at))
        .collect();
    assert_eq!(elements.len(), 2);
    let section = BodySection {
        set: "upper".into(),
        elements,
        material: body.material.clone(),
        formulation: body.formulation,
        density: 0.0,
    };
    model.bodies[0].sections.push(section);
    let along = |strain: f64| ActuationKind::along(strain, &Vec3::z());
    let first = crate::Actuation {
        section: Some(1),
        ..crate::actuation(along(0.3))
    };
    model.steps[0].actuations = vec![first];
    let hold = model.steps[0].clone();
    model.steps.push(crate::Step {
        actuations: vec![crate::Actuation {
            section: Some(0),
            ..crate::actuation(along(-0.1))
        }],
        ..hold
    });
    let run = Run::completed(model);
    let length = |state: usize| {
        let x = run.states[state].positions.iter();
        x.map(|x| x.z).fold(0.0, f64::max)
    };
    assert!((length(4) - 2.3).abs() < 1e-12);
    assert!((length(8) - 2.2).abs() < 1e-12);
}

#[test]
fn a_block_that_expands_between_two_walls_presses_on_them_as_the_closed_form() {
    let (strain, gap) = (0.1, 0.1);
    for formulation in FORMULATIONS {
        let kinds = [ActuationKind::isotropic(strain)];
        let mut model = bar(rubber(1.0, 0.3), formulation, &kinds);
        model.steps[0].displacements.pop();
        model.touch_rigid(
            ("bar", "zmin"),
            plane([0.0; 3], [0.0, 0.0, 1.0]),
            coulomb(0.0),
        );
        let wall = plane([0.0, 0.0, 2.0 + gap], [0.0, 0.0, -1.0]);
        model
            .rigid_surfaces
            .push(RigidSurface::new("ceiling", wall));
        let upper = Pair {
            name: "upper".into(),
            a: match &model.pairs[0].a {
                ContactSurface::Deformable { body, .. } => ContactSurface::Deformable {
                    body: *body,
                    faces: model.faces("bar", "zmax"),
                },
                _ => unreachable!("a body on side a"),
            },
            b: ContactSurface::Rigid(RigidId(1)),
            ..model.pairs[0].clone()
        };
        model.pairs.push(upper);
        model.pairs[0].stabilised = true;
        model.pairs[1].stabilised = true;
        let run = Run::completed(model);
        let growth = 1.0 + strain;
        let [across, stress] = uniaxial(&rubber(1.0, 0.3), (1.0 + 0.5 * gap) / growth);
        let expected = growth * growth * stress;
        assert!(expected < -0.02);
        let pressed: f64 = run.last().forces.contact.iter().map(|f| f.z.abs()).sum();
        assert!(
            (0.5 * pressed + expected).abs() < 1e-8,
            "{formulation:?} {pressed} {expected}"
        );
        let widest = run.positions(0).iter().map(|x| x.x).fold(0.0, f64::max);
        assert!((widest - growth * across).abs() < 1e-8);
    }
}
