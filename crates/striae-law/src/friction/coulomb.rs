//! Isotropic Coulomb friction.
//!
//! ```text
//! |tau| <= mu p ,   tau = -mu p d while slipping
//! ```
//!
//! that is the kernel `L = K = I`, `eta = 0` with `varpi = mu p`. Admissible for
//! `mu >= 0`. Source: any textbook, e.g. Wriggers, *Computational Contact
//! Mechanics* (2006), chapter 4. As a sum: `w = mu (c, s)`.

use super::basis::{Basis, Direction, Meaning, Sum};
use super::coefficient::Coefficient;
use super::ellipse::Ellipse;
use super::error::FrictionError;
use super::kernel::Kernel;
use super::slip_sample::SlipRule;
use super::{Friction, Law};
use num_dual::DualNum;
use striae_declared::{Declared, NO_UNIT, NOT_NEGATIVE, Parameter, Values};

/// No friction.
pub static FRICTIONLESS: Declared<Friction> = Declared {
    name: "frictionless",
    summary: "No friction.",
    parameters: &[],
    build: |_| {
        Ok(Friction::new(
            Law::Frictionless,
            Coefficient::constant(0.0)?,
        ))
    },
    fit: None,
};

/// The law.
pub static COULOMB: Declared<Friction> = Declared {
    name: "coulomb",
    summary: "Isotropic Coulomb friction.",
    parameters: &[Parameter::number(
        "mu",
        NOT_NEGATIVE,
        NO_UNIT,
        "Coefficient of friction.",
    )],
    build: |values| {
        let coefficient = Coefficient::constant(values.number("mu"))?;
        Ok(Friction::new(Law::Coulomb, coefficient))
    },
    fit: Some(Basis::Sum(Sum {
        needed: "a reading",
        constants: &[Meaning::Parameter(0)],
        vectors: |direction, _, _| vec![direction.d()],
        judged: || vec![Direction::new(0.0, 0.0)],
    })),
};

impl Friction {
    /// No friction.
    pub fn frictionless() -> Self {
        let made = FRICTIONLESS.made(&Values::default());
        made.expect("zero is a coefficient of friction")
    }

    /// Isotropic Coulomb friction.
    ///
    /// # Errors
    /// When `mu` is negative or not finite.
    pub fn coulomb(mu: f64) -> Result<Self, FrictionError> {
        COULOMB.made(&[("mu", mu)].into())
    }
}

/// `L = K = I`, `eta = 0`.
pub(super) fn kernel<D: DualNum<Primitive = f64> + Copy>() -> Kernel<'static, D> {
    Kernel::identity()
}

/// The unit circle.
pub(super) fn slip_surface() -> Ellipse {
    Ellipse::new(1.0, 1.0, 0.0, SlipRule::Opposing)
}
