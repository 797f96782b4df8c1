//! The energy `c10 (I1 - 3) + c20 (I1 - 3)^2 + c30 (I1 - 3)^3`, with `G = 2 c10`.
//!
//! Source: Yeoh, Rubber Chem. Technol. 66 (1993) 754-771, doi:10.5254/1.3538343.

use super::{Invariant, Isochoric};
use crate::bulk::{Material, RUBBER};
use striae_declared::{ANY, Declared, POSITIVE, Parameter};

/// The law.
pub static YEOH: Declared<Material> = Declared {
    name: "yeoh",
    summary: "Rubber with a cubic energy of `I1 - 3`, nearly incompressible.",
    parameters: &[
        Parameter::number(
            "c10",
            POSITIVE,
            "force per area",
            "Constant of `I1 - 3`, half the shear modulus at rest.",
        ),
        Parameter::number("c20", ANY, "force per area", "Constant of `(I1 - 3)^2`."),
        Parameter::number("c30", ANY, "force per area", "Constant of `(I1 - 3)^3`."),
        RUBBER,
    ],
    build: |values| {
        let [c10, c20, c30] = ["c10", "c20", "c30"].map(|name| values.number(name));
        Material::rubber(Isochoric::Yeoh { c10, c20, c30 }, values)
    },
    fit: None,
};

pub(super) fn energy([c10, c20, c30]: [f64; 3], i1: Invariant) -> Invariant {
    let strain = i1 - 3.0;
    strain * (strain * (strain * c30 + c20) + c10)
}
