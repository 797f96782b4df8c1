//! Bodies of several materials.

use crate::scene::{Places, Run, block, body, coulomb, increments, model, plane, rubber, step};
use striae_law::bulk::{
    Branch, Hardening, Hyperelastic, Isochoric, LameConstants, Material, Plastic, Viscoelastic,
    Volumetric,
};
use striae_mesh::{ElementId, Mesh, Vec3};
use striae_model::{BodySection, Formulation, Model};
use striae_solve::{dynamics::kinetic_energy, problem::Problem, report::bodies, state::State};

fn metal() -> Material {
    let constants = LameConstants::from_youngs_modulus(100.0, 0.3).unwrap();
    let hardening = Hardening::voce(0.5, 0.8, 6.0, 0.4).unwrap();
    Material::plastic(Plastic::new(constants, hardening))
}

fn viscoelastic() -> Material {
    let slow = Isochoric::NeoHookean { shear: 1.0 };
    let slow = Hyperelastic::new(slow, 5.0, Volumetric::Logarithmic).unwrap();
    let branch = Branch {
        ratio: 1.5,
        time: 0.5,
    };
    Material::viscoelastic(Viscoelastic::new(slow, &[branch]).unwrap())
}

/// The elements whose middle meets a condition, of a material.
fn section(mesh: &Mesh, material: Material, holds: impl Fn(&Vec3) -> bool) -> BodySection {
    let middle = |corners: Vec<Vec3>| corners.iter().sum::<Vec3>() / corners.len() as f64;
    let elements = (0..mesh.element_count()).map(ElementId::new);
    BodySection {
        set: "section".into(),
        elements: elements
            .filter(|element| holds(&middle(mesh.element_positions(*element))))
            .collect(),
        formulation: Formulation::suited_to(&material),
        material,
        density: 0.0,
    }
}

/// A bar three high on a unit square, stretched by `stretch` along `z`, free to slide on its
/// ends; what lies where `holds` is of the second material.
fn bar(materials: [Material; 2], stretch: f64, holds: impl Fn(&Vec3) -> bool) -> Model {
    let mesh = block([0.0; 3], [1.0, 1.0, 3.0], [2, 2, 3]).mesh().unwrap();
    let [first, second] = materials;
    let section = section(&mesh, second, holds);
    let mut model = model(vec![body("bar", mesh, first)]);
    model.bodies[0].sections = vec![section];
    let mut pull = step();
    pull.displacements = vec![
        model.hold("bar", "xmin", [Some(0.0), None, None]),
        model.hold("bar", "ymin", [None, Some(0.0), None]),
        model.hold("bar", "zmin", [None, None, Some(0.0)]),
        model.hold("bar", "zmax", [None, None, Some(3.0 * (stretch - 1.0))]),
    ];
    model.steps = vec![pull];
    model
}

fn force(run: &Run) -> f64 {
    let top = (run.problem.reference.iter().enumerate()).filter(|(_, x)| x.z == 3.0);
    let reactions = &run.last().forces.reaction;
    top.map(|(node, _)| reactions[node].z).sum()
}

/// Nominal stress of a bar that does not draw in.
fn nominal(material: &Material, stretch: f64) -> f64 {
    let gradient = nalgebra::Matrix3::from_diagonal(&Vec3::new(1.0, 1.0, stretch));
    material.response(&gradient).unwrap().first_piola[(2, 2)]
}

/// Without Poisson's ratio no layer draws in, and the closed forms hold at large strains.
fn pair() -> [[Material; 2]; 2] {
    let linear = |modulus: f64| {
        let constants = LameConstants::from_youngs_modulus(modulus, 0.0);
        Material::linear_elastic(constants.unwrap())
    };
    [
        [linear(2.0), linear(7.0)],
        [rubber(2.0, 0.0), rubber(7.0, 0.0)],
    ]
}

#[test]
fn layers_side_by_side_share_the_stretch() {
    for materials in pair() {
        let run = Run::completed(bar(materials.clone(), 1.3, |x| x.x > 0.5));
        let stresses = materials.map(|material| nominal(&material, 1.3));
        let expected = 0.5 * (stresses[0] + stresses[1]);
        assert!((force(&run) - expected).abs() < 1e-12 * expected);
    }
}

#[test]
fn layers_in_a_row_share_the_force() {
    for materials in pair() {
        let run = Run::completed(bar(materials.clone(), 1.2, |x| x.z > 1.0));
        // The interface is the plane `z = 1`: one third of the bar is of the first material.
        let at = (run.problem.reference.iter()).position(|x| x.z == 1.0);
        let height = run.last().positions[at.unwrap()].z;
        let stretches = [height, 0.5 * (3.6 - height)];
        for (material, stretch) in materials.iter().zip(stretches) {
            let off = nominal(material, stretch) - force(&run);
            assert!(off.abs() < 1e-10 * force(&run), "{off}");
        }
    }
    let [linear, _] = pair();
    let run = Run::completed(bar(linear, 1.2, |x| x.z > 1.0));
    let expected = 0.2 * 3.0 / (1.0 / 2.0 + 2.0 / 7.0);
    assert!((force(&run) - expected).abs() < 1e-12 * expected);
}

/// A block on a plane, pressed and slid.
fn pressed(material: Material, sections: impl Fn(&Mesh) -> Vec<BodySection>) -> Model {
    let mesh = block([0.0; 3], [1.0, 1.0, 0.5], [3, 2, 2]).mesh().unwrap();
    let sections = sections(&mesh);
    let mut model = model(vec![body("block", mesh, material)]);
    model.bodies[0].sections = sections;
    model.touch_rigid(
        ("block", "zmin"),
        plane([0.0; 3], [0.0, 0.0, 1.0]),
        coulomb(0.3),
    );
    for target in [[0.0, 0.0, -0.03], [0.06, 0.03, -0.03]] {
        let mut step = step();
        step.increments = increments(0.25, 0.05);
        step.displacements = vec![model.hold("block", "zmax", target.map(Some))];
        model.steps.push(step);
    }
    model
}

#[test]
fn sections_of_one_material_leave_every_bit() {
    for material in [rubber(1.0, 0.47), viscoelastic(), metal()] {
        let whole = Run::of(pressed(material.clone(), |_| Vec::new()));
        let cut = Run::of(pressed(material.clone(), |mesh| {
            let odd = |x: &Vec3| (3.0 * x.x) as usize == 1;
            vec![
                section(mesh, material.clone(), odd),
                section(mesh, material.clone(), |x| !odd(x) && x.y > 0.5),
            ]
        }));
        assert_eq!(whole.states.len(), cut.states.len());
        for (whole, cut) in whole.states.iter().zip(&cut.states) {
            assert_eq!(whole.positions, cut.positions, "{}", material.name());
            assert_eq!(whole.histories, cut.histories);
            assert_eq!(whole.forces, cut.forces);
            assert_eq!(whole.energies, cut.energies);
        }
    }
}

#[test]
fn materials_with_and_without_a_memory_balance_their_energy() {
    let run = Run::completed(pressed(metal(), |mesh| {
        let mut bending = section(mesh, rubber(60.0, 0.3), |x| x.x < 0.3);
        bending.formulation = Formulation::AssumedStrain;
        vec![bending, section(mesh, viscoelastic(), |x| x.x > 0.7)]
    }));
    // Two of six points in a layer have seven variables, and two a branch.
    let elements = 4 * 8;
    let branch = viscoelastic().variables();
    assert_eq!(run.last().histories[0].len(), elements * (7 + branch));
    for state in &run.states {
        let off = state.energies.imbalance().abs();
        assert!(
            off <= 1e-9 * state.energies.external,
            "{:?}",
            state.energies
        );
    }
    let plastic = run
        .problem
        .remembered(run.last(), 0, "equivalent_plastic_strain");
    let of_metal = |at: &usize| run.problem.compositions[0].section(ElementId::new(*at)) == 0;
    for (at, strain) in plastic.iter().enumerate() {
        assert_eq!(of_metal(&at), *strain > 0.0, "{at} {strain}");
    }
    let iterations = run.iterations.iter().map(Vec::len).max();
    assert!(iterations <= Some(13), "{iterations:?}");
}

#[test]
fn every_section_has_its_mass() {
    let mut model = bar([rubber(1.0, 0.0), rubber(1.0, 0.0)], 1.0, |x| x.z > 1.0);
    model.bodies[0].density = 0.5;
    model.bodies[0].sections[0].density = 4.0;
    let problem = Problem::new(model).unwrap();
    let mut state = State::undeformed(&problem);
    let count = state.positions.len();
    let energy = kinetic_energy(&problem, &vec![Vec3::new(0.0, 2.0, 0.0); count]);
    let expected = 0.5 * (0.5 + 2.0 * 4.0) * 4.0;
    assert!((energy - expected).abs() < 1e-12, "{energy}");
    // The light part has its middle at 0.5, the heavy one at 2, as the velocities have.
    let speeds = state.positions.iter().map(|x| Vec3::y() * x.z);
    state.velocities = speeds.collect();
    let body = &bodies(&problem, &state)[0];
    let middle = (0.5 * 0.5 + 8.0 * 2.0) / 8.5;
    let centre = Vec3::new(0.5, 0.5, middle);
    assert!((body.centre - centre).norm() < 1e-12, "{}", body.centre);
    assert!((body.velocity - Vec3::y() * middle).norm() < 1e-12);
}
