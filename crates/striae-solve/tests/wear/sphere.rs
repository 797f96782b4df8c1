//! A sphere that slides on a plane and is lowered until its cap has worn off.

use std::f64::consts::PI;

use striae_law::bulk::{LameConstants, Material};
use striae_mesh::generate::{CappedBlock, Part};
use striae_solve::{outcome::Ending, report::pairs};

use crate::scene::{Places, Run, body, coulomb, increments, model, plane, step};

const RADIUS: f64 = 1200.0;
/// Way by which the sphere is lowered, far more than it yields.
const LOWERED: f64 = 0.007;
const WEAR: f64 = 1000.0;

/// Half of a block with a spherical lower face, lowered as it slides along the plane, then slid on.
fn sphere() -> Run {
    let mesh = CappedBlock {
        size: [14.0; 2],
        height: 7.0,
        radius: RADIUS,
        element_size: 0.5,
        fine_depth: 0.5,
        part: Part::Half,
        ..CappedBlock::default()
    };
    let material = Material::neo_hookean(LameConstants::from_youngs_modulus(1.0, 0.3).unwrap());
    let mut model = model(vec![body("block", mesh.mesh().unwrap(), material)]);
    let floor = plane([0.0; 3], [0.0, 0.0, 1.0]);
    model.touch_rigid(("block", "cap"), floor, coulomb(0.05));
    model.pairs[0].wear = [WEAR, 0.0];
    let (mut lower, mut slide) = (step(), step());
    lower.displacements = vec![
        model.hold("block", "ymin", [None, Some(0.0), None]),
        model.hold("block", "zmax", [Some(0.5), Some(0.0), Some(-LOWERED)]),
    ];
    lower.increments = increments(0.05, 1e-4);
    slide.displacements = vec![model.hold("block", "zmax", [Some(1.0), None, None])];
    slide.increments = increments(0.25, 1e-3);
    model.steps = vec![lower, slide];
    Run::of(model)
}

/// The volume `pi R d^2 = pi a^4/(4 R)` of the cap, and the area `pi a^2 = 2 pi R d` of its base.
#[test]
fn a_sphere_loses_its_cap() {
    let run = sphere();
    assert_eq!(run.ending, Ending::Completed);
    let volume = 2.0 * run.last().pairs[0].worn[0];
    let error = volume / (PI * RADIUS * LOWERED * LOWERED) - 1.0;
    assert!(error.abs() < 0.05, "volume {error:.4}");
    let area = 2.0 * pairs(&run.problem, run.last())[0].sides[0].pressed;
    let error = area / (2.0 * PI * RADIUS * LOWERED) - 1.0;
    assert!(error.abs() < 0.05, "area {error:.4}");
    let worn = run.last().pairs[0].tractions.worn[0].iter();
    let deepest = worn.copied().fold(0.0, f64::max);
    assert!((deepest / LOWERED - 1.0).abs() < 0.02, "depth {deepest}");
}
