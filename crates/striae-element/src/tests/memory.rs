//! Elements of materials with a memory.

use super::*;
use nalgebra::Matrix3;
use striae_law::bulk::{
    Branch, Hardening, Hyperelastic, Isochoric, Plastic, Viscoelastic, Volumetric,
};

fn materials() -> [Material; 2] {
    let slow = Isochoric::MooneyRivlin {
        c10: 0.2,
        c01: 0.05,
    };
    let slow = Hyperelastic::new(slow, 2.0, Volumetric::Logarithmic).unwrap();
    let branches = [1.5, 0.3].map(|time| Branch { ratio: 0.7, time });
    let constants = LameConstants::from_youngs_modulus(1.0, 0.3).unwrap();
    let hardening = Hardening::linear(0.02, 0.1).unwrap();
    [
        Material::viscoelastic(Viscoelastic::new(slow, &branches).unwrap()),
        Material::plastic(Plastic::new(constants, hardening)),
    ]
}

#[test]
fn the_stress_of_what_points_have_come_to_is_that_of_the_increment() {
    for material in materials() {
        for formulation in FORMULATIONS {
            let mut random = Random::new(32);
            let kind = CellKind::Hexahedron;
            let single = Single::distorted(kind, formulation, &mut random, 0.0);
            let shape = random.near_identity(0.1);
            let x: Vec<Vec3> = single.reference.iter().map(|x| shape * x).collect();
            let rest = vec![0.0; material.variables() * single.elements.points()];
            let past = Past {
                variables: &rest,
                elapsed: 0.4,
            };
            let response = single.element().response(&x, &material, past).unwrap();
            let stress = single.element().stress(&x, &material, &response.variables);
            // Virtual power at a uniform stress: the moments of the forces are `J sigma`.
            let forces = response.force.iter().zip(&x);
            let moments: Matrix3<f64> = forces.map(|(f, x)| Vec3::from(*f) * x.transpose()).sum();
            let volume = single.element().volume() * shape.determinant();
            for stress in stress.unwrap() {
                assert!((stress * volume - moments).norm() < 1e-13, "{stress}");
            }
        }
    }
}
