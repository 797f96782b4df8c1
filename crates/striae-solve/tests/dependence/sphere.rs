//! A sphere on a plane in full slip by a power law, beside the integral over Hertz's pressure.

use std::f64::consts::PI;

use striae_law::{
    bulk::{LameConstants, Material},
    friction::PressureDependence,
};
use striae_mesh::generate::{CappedBlock, Part};
use striae_solve::{outcome::Ending, report::pairs};
use striae_verify::closed_forms::{PointContact, contact_modulus};

use crate::scene::{Places, Run, body, coulomb, increments, model, plane, step};

/// Radius of the sphere, large beside the contact, as Hertz assumes.
const RADIUS: f64 = 1200.0;
/// Lame's first constant and shear modulus of the sphere.
const MODULI: [f64; 2] = [0.657, 0.164];
/// Exponent and pressure of the power law.
const POWER: [f64; 2] = [2.0 / 3.0, 2e-4];

/// Half of a block with a spherical lower face pressed on a plane, then slid far.
fn sphere(element_size: f64) -> Run {
    let mesh = CappedBlock {
        size: [20.0; 2],
        height: 13.0,
        radius: RADIUS,
        element_size,
        fine_depth: 0.5,
        part: Part::Half,
        ..CappedBlock::default()
    };
    let [lambda, shear] = MODULI;
    let material = Material::neo_hookean(LameConstants { lambda, shear });
    let mut model = model(vec![body("block", mesh.mesh().unwrap(), material)]);
    let [exponent, pressure] = POWER;
    let power = PressureDependence::power_law(exponent, pressure, None).unwrap();
    let floor = plane([0.0; 3], [0.0, 0.0, 1.0]);
    model.touch_rigid(("block", "cap"), floor, coulomb(0.1).with_pressure(power));
    let (mut press, mut slide) = (step(), step());
    press.displacements = vec![
        model.hold("block", "ymin", [None, Some(0.0), None]),
        model.hold("block", "zmax", [Some(0.0), Some(0.0), Some(-0.0015)]),
    ];
    press.increments = increments(0.1, 1e-3);
    slide.displacements = vec![model.hold("block", "zmax", [Some(0.01), None, None])];
    slide.increments = increments(0.5, 1e-3);
    model.steps = vec![press, slide];
    Run::of(model)
}

/// `2 pi a^2 mu p0 (p_max/p0)^m/(m + 2)`, the integral of `mu p0 (p/p0)^m` over Hertz's pressure
/// `p_max sqrt(1 - r^2/a^2)`.
fn of_hertz(force: f64) -> f64 {
    let [lambda, shear] = MODULI;
    let young = shear * (3.0 * lambda + 2.0 * shear) / (lambda + shear);
    let poisson = 0.5 * lambda / (lambda + shear);
    let contact = PointContact::new(force, RADIUS, contact_modulus(&[[young, poisson]]));
    let [m, pressure] = POWER;
    let area = PI * contact.radius * contact.radius;
    2.0 * area * 0.1 * pressure * (contact.peak_pressure / pressure).powf(m) / (m + 2.0)
}

#[test]
fn a_sphere_in_full_slip_has_the_friction_of_hertz_pressure() {
    // The ring of facets at the edge, where a part of each support is open, limits what a mesh
    // gives: in it the pressure of nodes stands for a field that falls like a square root.
    for size in [0.4, 0.2] {
        let run = sphere(size);
        assert_eq!(run.ending, Ending::Completed);
        let force = pairs(&run.problem, run.last())[0].sides[0].force * 2.0;
        let error = force.xy().norm() / of_hertz(force.z) - 1.0;
        assert!(error.abs() < 0.015, "{size}: {error:.4}");
    }
}
