//! The energy `G/2 (I1 - 3)`.

use super::{Invariant, Isochoric};
use crate::bulk::{Material, RUBBER};
use striae_declared::{Declared, POSITIVE, Parameter};

/// The law.
pub static ISOCHORIC_NEO_HOOKEAN: Declared<Material> = Declared {
    name: "isochoric-neo-hookean",
    summary: "Rubber with the energy `G/2 (I1 - 3)`, nearly incompressible.",
    parameters: &[
        Parameter::number(
            "shear_modulus",
            POSITIVE,
            "force per area",
            "Shear modulus `G`.",
        ),
        RUBBER,
    ],
    build: |values| {
        let shear = values.number("shear_modulus");
        Material::rubber(Isochoric::NeoHookean { shear }, values)
    },
    fit: None,
};

pub(super) fn energy(shear: f64, i1: Invariant) -> Invariant {
    (i1 - 3.0) * (0.5 * shear)
}
