//! The energy `c10 (I1 - 3) + c01 (I2 - 3)`, with `G = 2 (c10 + c01)`.
//!
//! Source: Mooney, J. Appl. Phys. 11 (1940) 582-592, doi:10.1063/1.1712836.

use super::{Invariant, Isochoric};
use crate::bulk::{Material, RUBBER};
use striae_declared::{ANY, Declared, Parameter};

/// The law.
pub static MOONEY_RIVLIN: Declared<Material> = Declared {
    name: "mooney-rivlin",
    summary: "Rubber with the energy `c10 (I1 - 3) + c01 (I2 - 3)`, nearly incompressible.",
    parameters: &[
        Parameter::number(
            "c10",
            ANY,
            "force per area",
            "Constant of the first invariant.",
        ),
        Parameter::number(
            "c01",
            ANY,
            "force per area",
            "Constant of the second invariant; `c10 + c01` must be positive.",
        ),
        RUBBER,
    ],
    build: |values| {
        let [c10, c01] = ["c10", "c01"].map(|name| values.number(name));
        Material::rubber(Isochoric::MooneyRivlin { c10, c01 }, values)
    },
    fit: None,
};

pub(super) fn energy(c10: f64, c01: f64, i1: Invariant, i2: Invariant) -> Invariant {
    (i1 - 3.0) * c10 + (i2 - 3.0) * c01
}
