//! Checks of the element, alone and in small assemblies.

mod assembly;
mod patch;
mod rates;
mod single;

use striae_law::bulk::{LameConstants, Material};
use striae_mesh::Vec3;
use striae_verify::Random;

fn neo_hookean() -> Material {
    Material::neo_hookean(LameConstants::from_youngs_modulus(1.0, 0.3).unwrap())
}

fn linear_elastic() -> Material {
    Material::linear_elastic(LameConstants::from_youngs_modulus(1.0, 0.3).unwrap())
}

/// Corners of the cube `[0, 1]^3`, each disturbed by at most `amplitude`.
fn distorted_cube(random: &mut Random, amplitude: f64) -> [Vec3; 8] {
    super::shape::CORNERS
        .map(|corner| (Vec3::from(corner).add_scalar(1.0)) * 0.5 + random.vector3() * amplitude)
}

/// Each position disturbed by at most `amplitude`.
fn disturbed(random: &mut Random, positions: &[Vec3; 8], amplitude: f64) -> [Vec3; 8] {
    positions.map(|x| x + random.vector3() * amplitude)
}
