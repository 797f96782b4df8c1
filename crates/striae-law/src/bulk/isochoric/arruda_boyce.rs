//! The eight-chain model, by the first five terms of its series:
//! `mu sum_i C_i/lm^(2i-2) (I1^i - 3^i)`.
//!
//! `C_i` = 1/2, 1/20, 11/1050, 19/7000, 519/673750 are the series of the inverse Langevin
//! function; the shear modulus is
//! `G = mu (1 + 3/(5 lm^2) + 99/(175 lm^4) + 513/(875 lm^6) + 42039/(67375 lm^8))`.
//!
//! Source: Arruda & Boyce, J. Mech. Phys. Solids 41 (1993) 389-412,
//! doi:10.1016/0022-5096(93)90013-6.

use super::{Invariant, Isochoric, finite, positive};
use crate::bulk::{InadmissibleHyperelastic, Material, RUBBER};
use num_dual::DualNum;
use striae_declared::{Bound, Declared, NO_UNIT, POSITIVE, Parameter};

/// The law.
pub static ARRUDA_BOYCE: Declared<Material> = Declared {
    name: "arruda-boyce",
    summary: "Rubber by the first five terms of the eight-chain model, nearly incompressible.",
    parameters: &[
        Parameter::number(
            "mu",
            POSITIVE,
            "force per area",
            "Modulus `mu`, near the shear modulus at rest.",
        ),
        Parameter::number(
            "locking_stretch",
            &[Bound::Above(1.0)],
            NO_UNIT,
            "Stretch at which the chains lock.",
        ),
        RUBBER,
    ],
    build: |values| {
        let isochoric = Isochoric::ArrudaBoyce {
            mu: values.number("mu"),
            locking_stretch: values.number("locking_stretch"),
        };
        Material::rubber(isochoric, values)
    },
    fit: None,
};

/// Coefficients of the series of the inverse Langevin function.
const LANGEVIN: [f64; 5] = [
    1.0 / 2.0,
    1.0 / 20.0,
    11.0 / 1050.0,
    19.0 / 7000.0,
    519.0 / 673_750.0,
];

pub(super) fn energy(mu: f64, locking_stretch: f64, i1: Invariant) -> Invariant {
    let square = locking_stretch.powi(-2);
    let mut sum = Invariant::from(0.0);
    for (i, c) in (1..=5).zip(LANGEVIN) {
        sum += (i1.powi(i) - 3f64.powi(i)) * (c * square.powi(i - 1));
    }
    sum * mu
}

/// The shear modulus at rest.
pub(super) fn shear(mu: f64, locking_stretch: f64) -> f64 {
    let square = locking_stretch.powi(-2);
    let series = (1..=5).rev().fold(0.0, |sum, i| {
        let slope = 2.0 * f64::from(i) * LANGEVIN[i as usize - 1] * 3f64.powi(i - 1);
        sum * square + slope
    });
    mu * series
}

pub(super) fn check(mu: f64, locking_stretch: f64) -> Result<(), InadmissibleHyperelastic> {
    positive("mu", mu)?;
    finite([("locking_stretch", locking_stretch)])?;
    if locking_stretch > 1.0 {
        Ok(())
    } else {
        Err(InadmissibleHyperelastic::Locked(locking_stretch))
    }
}
