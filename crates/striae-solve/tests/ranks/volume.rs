//! Materials with a memory, sections, fibres, and bodies that are tied to each other.

use striae_law::bulk::{
    Branch, Hardening, Hyperelastic, Isochoric, LameConstants, Material, Plastic, Viscoelastic,
    Volumetric,
};
use striae_mesh::{ElementId, Face};
use striae_model::{BodyId, BodySection, ContactSurface, Formulation, Model, Tie};

use crate::{
    scene::{Places, block, body, coulomb, increments, model, plane, rubber, step},
    told::assert_same,
};

fn viscoelastic() -> Material {
    let slow = Isochoric::NeoHookean { shear: 1.0 };
    let slow = Hyperelastic::new(slow, 5.0, Volumetric::Logarithmic).unwrap();
    let branch = Branch {
        ratio: 1.5,
        time: 0.5,
    };
    Material::viscoelastic(Viscoelastic::new(slow, &[branch]).unwrap())
}

fn metal() -> Material {
    let constants = LameConstants::from_youngs_modulus(100.0, 0.3).unwrap();
    let hardening = Hardening::voce(0.5, 0.8, 6.0, 0.4).unwrap();
    Material::plastic(Plastic::new(constants, hardening))
}

/// A block on a plane, pressed and slid.
fn pressed(material: Material, [by, slide]: [f64; 2]) -> Model {
    let mesh = block([0.0; 3], [1.0, 1.0, 0.5], [3, 3, 3]).mesh().unwrap();
    let mut model = model(vec![body("block", mesh, material)]);
    model.touch_rigid(
        ("block", "zmin"),
        plane([0.0; 3], [0.0, 0.0, 1.0]),
        coulomb(0.3),
    );
    for target in [[0.0, 0.0, -by], [slide, 0.5 * slide, -by]] {
        let mut step = step();
        step.increments = increments(0.5, 0.1);
        step.displacements = vec![model.hold("block", "zmax", target.map(Some))];
        model.steps.push(step);
    }
    model
}

#[test]
fn rubber_that_relaxes() {
    assert_same(&pressed(viscoelastic(), [0.05, 0.1]));
}

#[test]
fn metal_that_yields() {
    let told = assert_same(&pressed(metal(), [0.01, 0.001]));
    assert_eq!(told.ending, "all steps completed");
}

#[test]
fn sections_of_other_materials() {
    let mut model = pressed(rubber(1.0, 0.3), [0.05, 0.1]);
    let elements = (0..27).filter(|at| at % 5 == 2).map(ElementId::new);
    model.bodies[0].sections = vec![BodySection {
        set: "hard".to_owned(),
        elements: elements.collect(),
        material: rubber(20.0, 0.2),
        formulation: Formulation::Standard,
        density: 0.0,
    }];
    assert_same(&model);
}

#[test]
fn bodies_that_are_tied() {
    let lower = block([0.0; 3], [1.0, 1.0, 0.5], [4, 4, 2]).mesh().unwrap();
    let upper = block([0.0, 0.0, 0.5], [1.0, 1.0, 0.5], [3, 3, 2]);
    let mut model = model(vec![
        body("lower", lower, rubber(1.0, 0.3)),
        body("upper", upper.mesh().unwrap(), rubber(3.0, 0.3)),
    ]);
    let side = |body: usize, faces: Vec<Face>| ContactSurface::Deformable {
        body: BodyId(body),
        faces,
    };
    model.ties.push(Tie {
        name: "glue".to_owned(),
        a: side(0, model.faces("lower", "zmax")),
        b: side(1, model.faces("upper", "zmin")),
        within: None,
        moved: 0.0,
    });
    model.touch_rigid(
        ("lower", "zmin"),
        plane([0.0; 3], [0.0, 0.0, 1.0]),
        coulomb(0.3),
    );
    let mut shear = step();
    shear.increments = increments(0.25, 0.01);
    shear.displacements = vec![model.hold("upper", "zmax", [Some(0.1), Some(0.05), Some(-0.1)])];
    model.steps.push(shear);
    assert_same(&model);
}
