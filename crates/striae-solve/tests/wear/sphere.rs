//! A sphere that slides on a plane and is lowered until its cap has worn off.

use std::f64::consts::PI;

use striae_contact::side::Side;
use striae_law::bulk::{LameConstants, Material};
use striae_mesh::generate::{CappedBlock, Part};
use striae_solve::outcome::Ending;

use crate::scene::{Places, Run, body, coulomb, increments, model, plane, step};

const RADIUS: f64 = 1200.0;
/// Way by which the sphere is lowered, far more than it yields.
const LOWERED: f64 = 0.007;
const WEAR: f64 = 1000.0;

/// Half of a block with a spherical lower face, lowered as it slides along the plane, then slid on.
fn sphere(element_size: f64) -> Run {
    let mesh = CappedBlock {
        size: [9.5; 2],
        height: 1.5,
        radius: RADIUS,
        element_size,
        fine_half_width: 4.0,
        fine_depth: 0.5,
        growth: 1.6,
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
    lower.increments = increments(0.025, 1e-4);
    slide.displacements = vec![model.hold("block", "zmax", [Some(1.0), None, None])];
    slide.increments = increments(0.5, 1e-3);
    model.steps = vec![lower, slide];
    Run::of(model)
}

/// The volume `pi R d^2 = pi a^4/(4 R)` of the cap, and its depth `d - r^2/(2 R)` within the radius
/// `a = sqrt(2 R d)` of the scar.
///
/// Errors of two kinds remain. The edge of the scar moves outwards by whole increments, in which
/// all of what it reaches wears at the pressure of their end: the volume is too large by 3.0 % in 20
/// increments, 1.5 % in 40 and 0.4 % in 80 on a block of twice the height, of first order. And
/// facets are chords: those of the size `h` lie inside the sphere by `h^2/(6 R)` in the mean, which
/// takes away 1.0 % of the cap.
#[test]
fn a_sphere_loses_its_cap() {
    let size = 0.5;
    let run = sphere(size);
    assert_eq!(run.ending, Ending::Completed);
    let cap = PI * RADIUS * LOWERED * LOWERED;
    let error = 2.0 * run.last().pairs[0].worn[0] / cap - 1.0;
    assert!(error.abs() < 0.02, "{error:.4}");
    let radius = (2.0 * RADIUS * LOWERED).sqrt();
    let surface = run.problem.pairs[0].contact.sides[Side::A]
        .surface()
        .unwrap();
    let worn = &run.last().pairs[0].tractions.worn[Side::A];
    for (node, depth) in surface.nodes().iter().zip(worn) {
        let from_axis = run.problem.reference[node.index()].xy().norm();
        let expected = LOWERED - from_axis * from_axis / (2.0 * RADIUS);
        if from_axis < radius - size {
            assert!(
                (depth - expected).abs() < 0.05 * LOWERED,
                "{from_axis} {depth} {expected}"
            );
        } else if from_axis > radius + size {
            assert!(*depth < 1e-3 * LOWERED, "{from_axis} {depth}");
        }
    }
}
