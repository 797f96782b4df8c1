//! Checks of elements in small assemblies: patch tests, rates, locking.

mod assembly;
mod bending;
mod pad;
mod patch;
mod rates;

use striae_law::bulk::{LameConstants, Material};

fn neo_hookean() -> Material {
    Material::neo_hookean(LameConstants::from_youngs_modulus(1.0, 0.3).unwrap())
}

fn linear_elastic() -> Material {
    Material::linear_elastic(LameConstants::from_youngs_modulus(1.0, 0.3).unwrap())
}
