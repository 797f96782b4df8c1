//! The part of the stored energy that depends on the volume ratio `J` alone.
//!
//! ```text
//! quadratic    U = k/2 (J - 1)^2      J U' = k (J - 1) J      J (J U')' = k (2 J - 1) J
//! logarithmic  U = k/2 ln^2 J         J U' = k ln J           J (J U')' = k
//! ```
//!
//! Both are zero and free of stress at `J = 1`, where `U'' = k`. The quadratic term keeps
//! a finite stress as `J -> 0`; the logarithmic one grows without bound there, but its
//! stress `U'` falls again beyond `J = e`.

use num_dual::DualNum;
use serde::Serialize;

/// Form of the volumetric energy.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub enum Volumetric {
    /// `k/2 (J - 1)^2`.
    #[default]
    Quadratic,
    /// `k/2 ln^2 J`.
    Logarithmic,
}

impl Volumetric {
    /// `U(J)` for the modulus `k`.
    pub(super) fn energy<D: DualNum<Primitive = f64> + Copy>(self, modulus: f64, j: D) -> D {
        let strain = match self {
            Self::Quadratic => j - 1.0,
            Self::Logarithmic => j.ln(),
        };
        strain * strain * (0.5 * modulus)
    }

    /// `J U'` and `J (J U')'`: the Kirchhoff pressure and its derivative by `ln J`.
    pub(super) fn pressure(self, modulus: f64, j: f64) -> (f64, f64) {
        match self {
            Self::Quadratic => (modulus * (j - 1.0) * j, modulus * (2.0 * j - 1.0) * j),
            Self::Logarithmic => (modulus * j.ln(), modulus),
        }
    }
}
