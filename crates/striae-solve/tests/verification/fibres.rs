//! Bodies with fibres.

use crate::scene::{
    Places, Run, block, body, coulomb, increments, model, plane, rubber, step, whole,
};
use striae_law::bulk::{
    Direction, FibreStiffness, Fibres, Fibrous, Hyperelastic, Isochoric, LinesAbout, Material,
    Volumetric,
};
use striae_mesh::{ElementId, Vec3};
use striae_model::{BodySection, Formulation, Increments, Model};

fn linear(ground: Material, modulus: f64, direction: Direction) -> Material {
    let stiffness = FibreStiffness::Linear { modulus };
    let fibres = Fibres {
        stiffness,
        direction,
    };
    Material::fibrous(Fibrous::new(ground, &[fibres]).unwrap())
}

/// A cube that slides on three planes of symmetry and is stretched along `z` in quarters.
fn stretched(material: Material, formulation: Formulation, stretch: f64) -> Run {
    stretched_in(increments(0.25, 0.05), material, formulation, stretch)
}

fn stretched_in(
    increments: Increments,
    material: Material,
    formulation: Formulation,
    stretch: f64,
) -> Run {
    let mesh = block([0.0; 3], [1.0; 3], [2, 2, 1]).mesh().unwrap();
    let mut model = model(vec![body("cube", mesh, material)]);
    model.bodies[0].formulation = formulation;
    let mut pull = step();
    pull.increments = increments;
    pull.displacements = vec![
        model.hold("cube", "xmin", [Some(0.0), None, None]),
        model.hold("cube", "ymin", [None, Some(0.0), None]),
        model.hold("cube", "zmin", [None, None, Some(0.0)]),
        model.hold("cube", "zmax", [None, None, Some(stretch - 1.0)]),
    ];
    model.steps = vec![pull];
    Run::completed(model)
}

fn force(run: &Run) -> f64 {
    let top = (run.problem.reference.iter().enumerate()).filter(|(_, x)| x.z == 1.0);
    let reactions = &run.last().forces.reaction;
    top.map(|(node, _)| reactions[node].z).sum()
}

#[test]
fn a_bar_bears_what_its_ground_and_its_fibres_bear() {
    // The sides of a transversely isotropic bar are free of what its fibres do.
    let (modulus, stretch) = (3.0, 1.3);
    for formulation in [
        Formulation::Standard,
        Formulation::MeanDilatation,
        Formulation::AssumedStrain,
    ] {
        let ground = rubber(1.0, 0.3);
        let plain = force(&stretched(ground.clone(), formulation, stretch));
        for (direction, expected) in [
            (
                Vec3::z(),
                0.5 * modulus * stretch * (stretch * stretch - 1.0),
            ),
            (
                Vec3::z() * -2.0,
                0.5 * modulus * stretch * (stretch * stretch - 1.0),
            ),
        ] {
            let material = linear(ground.clone(), modulus, Direction::Uniform(direction));
            let run = stretched(material, formulation, stretch);
            let off = force(&run) - plain - expected;
            assert!(off.abs() < 1e-9, "{formulation:?} {off}");
        }
    }
}

#[test]
fn incompressible_tissue_has_its_closed_form_in_tension() {
    let (shear, bulk, k1, k2, stretch) = (1.0, 1e4, 2.0, 0.8, 1.2_f64);
    let isochoric = Isochoric::NeoHookean { shear };
    let ground = Hyperelastic::new(isochoric, bulk, Volumetric::Logarithmic).unwrap();
    let stiffness = FibreStiffness::Exponential {
        k1,
        k2,
        dispersion: 0.0,
    };
    let fibres = Fibres {
        stiffness,
        direction: Direction::Uniform(Vec3::z()),
    };
    let material = Fibrous::new(Material::hyperelastic(ground), &[fibres]).unwrap();
    let run = stretched(
        Material::fibrous(material),
        Formulation::MeanDilatation,
        stretch,
    );
    let strain = stretch * stretch - 1.0;
    let nominal = shear * (stretch - stretch.powi(-2))
        + 2.0 * k1 * stretch * strain * (k2 * strain * strain).exp();
    // The volume changes by stress over bulk modulus.
    let off = force(&run) / nominal - 1.0;
    assert!(off.abs() < 4.0 * nominal / bulk, "{off:e}");
}

#[test]
fn incompressible_tissue_is_stretched_in_one_increment() {
    // Fibres at rest are slack everywhere, not by the round-off of each point.
    let isochoric = Isochoric::NeoHookean { shear: 1.0 };
    let ground = Hyperelastic::new(isochoric, 1e4, Volumetric::Logarithmic).unwrap();
    let stiffness = FibreStiffness::Exponential {
        k1: 2.0,
        k2: 0.8,
        dispersion: 0.0,
    };
    let fibres = Fibres {
        stiffness,
        direction: Direction::Uniform(Vec3::z()),
    };
    let material = Fibrous::new(Material::hyperelastic(ground), &[fibres]).unwrap();
    let material = Material::fibrous(material);
    for stretch in [1.02, 1.2] {
        let mean = Formulation::MeanDilatation;
        let whole = stretched_in(whole(), material.clone(), mean, stretch);
        assert!(whole.iterations[0].len() <= 10, "{:?}", whole.iterations);
        let quarters = stretched(material.clone(), mean, stretch);
        let off = force(&whole) / force(&quarters) - 1.0;
        assert!(off.abs() < 1e-9, "{off:e}");
    }
}

/// A block with fibres wound about an axis in half of it, pressed on a plane and slid.
fn pressed() -> Model {
    let mesh = block([0.0; 3], [1.0, 1.0, 0.5], [3, 3, 2]).mesh().unwrap();
    let direction = Direction::About {
        point: Vec3::new(0.5, -1.0, 0.0),
        axis: Vec3::z(),
        lines: LinesAbout::Circumferential { turn: 0.4 },
    };
    let stiffness = FibreStiffness::Exponential {
        k1: 1.5,
        k2: 2.0,
        dispersion: 0.05,
    };
    let fibres = [Fibres {
        stiffness,
        direction,
    }];
    let material = Material::fibrous(Fibrous::new(rubber(1.0, 0.3), &fibres).unwrap());
    let upper = BodySection {
        set: "upper".into(),
        elements: (9..18).map(ElementId::new).collect(),
        formulation: Formulation::Standard,
        material,
        density: 0.0,
    };
    let mut model = model(vec![body("block", mesh, rubber(1.0, 0.3))]);
    model.bodies[0].sections = vec![upper];
    model.touch_rigid(
        ("block", "zmin"),
        plane([0.0; 3], [0.0, 0.0, 1.0]),
        coulomb(0.4),
    );
    for target in [[0.0, 0.0, -0.06], [0.15, 0.0, -0.06]] {
        let mut step = step();
        step.increments = increments(0.25, 0.05);
        step.displacements = vec![model.hold("block", "zmax", target.map(Some))];
        model.steps.push(step);
    }
    model
}

#[test]
fn fibres_keep_their_directions_and_lose_no_energy() {
    let run = Run::completed(pressed());
    let rest = &run.states[0].histories[0];
    assert_eq!(rest.len(), 9 * 8 * 3);
    for direction in rest.chunks_exact(3) {
        assert!((Vec3::from_column_slice(direction).norm() - 1.0).abs() < 1e-15);
    }
    for state in &run.states {
        assert_eq!(state.histories[0], *rest);
        assert_eq!(state.energies.inelastic, 0.0);
        let off = state.energies.imbalance().abs();
        assert!(off <= 1e-9 * state.energies.external.abs(), "{off}");
    }
    let most = run.iterations.iter().map(Vec::len).max();
    assert!(most <= Some(10), "{most:?}");
}
