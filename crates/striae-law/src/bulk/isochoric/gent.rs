//! The energy `-G Jm/2 ln(1 - (I1 - 3)/Jm)` of chains of finite length, for `I1 - 3 < Jm`.
//!
//! Source: Gent, Rubber Chem. Technol. 69 (1996) 59-61, doi:10.5254/1.3538357.

use super::{Invariant, Isochoric};
use crate::bulk::{Material, RUBBER};
use num_dual::DualNum;
use striae_declared::{Declared, NO_UNIT, POSITIVE, Parameter};

/// The law.
pub static GENT: Declared<Material> = Declared {
    name: "gent",
    summary: "Rubber with chains of finite length: energy `-G Jm/2 ln(1 - (I1 - 3)/Jm)`, nearly incompressible.",
    parameters: &[
        Parameter::number(
            "shear_modulus",
            POSITIVE,
            "force per area",
            "Shear modulus `G`.",
        ),
        Parameter::number("limit", POSITIVE, NO_UNIT, "`Jm`, the limit of `I1 - 3`."),
        RUBBER,
    ],
    build: |values| {
        let [shear, limit] = ["shear_modulus", "limit"].map(|name| values.number(name));
        Material::rubber(Isochoric::Gent { shear, limit }, values)
    },
    fit: None,
};

pub(super) fn energy(shear: f64, limit: f64, i1: Invariant) -> Invariant {
    (-(i1 - 3.0) / limit).ln_1p() * (-0.5 * shear * limit)
}
