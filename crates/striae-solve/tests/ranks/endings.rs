//! Failures on one rank, which end or cut increments on all.

use striae_mesh::Vec3;
use striae_model::{LoadExtent, LoadKind, Model};

use crate::{
    scene::{Places, block, body, coulomb, increments, model, plane, rubber, step},
    told::assert_same,
};

fn bar() -> Model {
    let mesh = block([0.0; 3], [1.0, 1.0, 4.0], [2, 2, 8]).mesh().unwrap();
    model(vec![body("bar", mesh, rubber(1.0, 0.3))])
}

#[test]
fn an_inverted_element_is_named_by_all() {
    let mut model = bar();
    let mut press = step();
    press.displacements = vec![
        model.hold("bar", "zmin", [Some(0.0); 3]),
        model.hold("bar", "zmax", [None, None, Some(-5.0)]),
    ];
    model.steps = vec![press];
    let told = assert_same(&model);
    assert!(told.ending.contains("turned inside out"), "{}", told.ending);
}

#[test]
fn increments_are_cut_by_all() {
    let mut model = bar();
    let mut shear = step();
    shear.displacements = vec![
        model.hold("bar", "zmin", [Some(0.0); 3]),
        model.hold("bar", "zmax", [Some(8.0), Some(0.0), Some(0.0)]),
    ];
    shear.increments = increments(1.0, 1e-3);
    model.steps = vec![shear];
    let told = assert_same(&model);
    assert!(!told.cuts.is_empty());
}

#[test]
fn what_nothing_holds_is_named_by_all() {
    let mut model = bar();
    let mut pull = step();
    let traction = LoadKind::DeadTraction(Vec3::new(0.1, 0.0, 0.0));
    pull.loads = vec![model.load("bar", "zmax", traction, LoadExtent::Whole)];
    model.steps = vec![pull];
    let told = assert_same(&model);
    assert!(told.ending.contains("is not restrained"), "{}", told.ending);
}

#[test]
fn a_mechanism_is_named_by_all() {
    let mut model = bar();
    let mut pull = step();
    pull.displacements = vec![model.hold("bar", "zmin", [Some(0.0), Some(0.0), None])];
    let traction = LoadKind::DeadTraction(Vec3::new(0.1, 0.0, 0.1));
    pull.loads = vec![model.load("bar", "zmax", traction, LoadExtent::Whole)];
    model.steps = vec![pull];
    let told = assert_same(&model);
    assert!(told.ending.contains("along z"), "{}", told.ending);
}

#[test]
fn the_limit_of_friction_is_named_by_all() {
    let mesh = block([0.0; 3], [1.0, 1.0, 1.0], [2, 2, 3]).mesh().unwrap();
    let mut model = model(vec![body("block", mesh, rubber(1.0, 0.3))]);
    model.touch_rigid(
        ("block", "zmin"),
        plane([0.0; 3], [0.0, 0.0, 1.0]),
        coulomb(0.3),
    );
    let push = |model: &Model, traction: [f64; 3]| {
        let kind = LoadKind::DeadTraction(traction.into());
        model.load("block", "zmax", kind, LoadExtent::Whole)
    };
    let mut press = step();
    press.loads = vec![push(&model, [0.0, 0.0, -0.02])];
    let mut shear = step();
    shear.increments = increments(0.25, 0.05);
    shear.loads = vec![
        push(&model, [0.02, 0.0, 0.0]),
        push(&model, [0.0, 0.0, -0.02]),
    ];
    model.steps = vec![press, shear];
    let told = assert_same(&model);
    assert!(told.ending.contains("limit of friction"), "{}", told.ending);
}
