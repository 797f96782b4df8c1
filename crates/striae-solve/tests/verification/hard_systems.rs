//! Linear systems that are hard for a solver: `Run::completed` holds the answers
//! of the condensed one against those of the multifrontal LU.

use crate::scene::{Places, Run, block, body, coulomb, model, rubber, step};
use striae_law::bulk::Material;
use striae_linalg::Method;
use striae_mesh::Vec3;
use striae_solve::model::{LoadExtent, LoadKind, Model};

/// A block of the given width, `gap` above the middle of a larger one whose bottom is held.
fn blocks(materials: [Material; 2], width: f64, gap: f64) -> Model {
    let lower = block([0.0; 3], [1.0, 1.0, 0.5], [3, 3, 2]).mesh().unwrap();
    let begin = 0.5 * (1.0 - width);
    let upper = block([begin, begin, 0.5 + gap], [width, width, 0.5], [2, 2, 2]);
    let mut model = model(vec![
        body("lower", lower, materials[0]),
        body("upper", upper.mesh().unwrap(), materials[1]),
    ]);
    model.touch(("lower", "zmax"), ("upper", "zmin"), coulomb(0.4));
    let mut step = step();
    step.displacements = vec![model.hold("lower", "zmin", [Some(0.0); 3])];
    model.steps = vec![step];
    model
}

/// The same, with the upper block's top moved.
fn pressed(materials: [Material; 2], width: f64, gap: f64, to: [f64; 3]) -> Run {
    let mut model = blocks(materials, width, gap);
    let top = model.hold("upper", "zmax", to.map(Some));
    model.steps[0].displacements.push(top);
    Run::completed(model)
}

/// Nodes under pressure, in a run without fall-backs.
fn touching(run: &Run) -> usize {
    for work in &run.work {
        assert_eq!((work.method, work.fall_back), (Method::Condensed, None));
    }
    let nodes = run.last().pairs[0].nodes.iter().flatten();
    nodes.filter(|node| node.pressure > 0.0).count()
}

#[test]
fn nearly_incompressible_bodies() {
    let soft = rubber(1.0, 0.499);
    let run = pressed([soft, soft], 0.6, 0.0, [0.002, 0.0, -0.01]);
    assert!(touching(&run) > 0);
}

#[test]
fn steel_on_rubber() {
    for stiffness in [[1e5, 1.0], [1.0, 1e5]] {
        let materials = stiffness.map(|modulus| rubber(modulus, 0.3));
        let run = pressed(materials, 0.6, 0.0, [0.002, 0.0, -0.01]);
        assert!(touching(&run) > 0);
    }
}

#[test]
fn contact_much_smaller_than_an_element() {
    let soft = rubber(1.0, 0.3);
    let run = pressed([soft, soft], 0.05, 0.0, [0.0, 0.0, -0.002]);
    assert!(touching(&run) > 0);
}

#[test]
fn contact_over_whole_faces() {
    let soft = rubber(1.0, 0.3);
    let run = pressed([soft, soft], 1.0, 0.0, [0.002, 0.0, -0.01]);
    assert!(touching(&run) >= 16);
}

#[test]
fn no_contact_at_all() {
    let soft = rubber(1.0, 0.3);
    let run = pressed([soft, soft], 0.6, 1.0, [0.01, 0.0, -0.05]);
    assert_eq!(touching(&run), 0);
}

#[test]
fn a_body_held_by_friction_alone() {
    let soft = rubber(1.0, 0.3);
    let mut model = blocks([soft, soft], 0.6, 0.0);
    let pull = LoadKind::DeadTraction(Vec3::new(0.001, 0.0, -0.01));
    let load = model.load("upper", "zmax", pull, LoadExtent::Whole);
    model.steps[0].loads = vec![load];
    let run = Run::completed(model);
    assert!(touching(&run) > 0);
}
