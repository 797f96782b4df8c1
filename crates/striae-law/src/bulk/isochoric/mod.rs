//! Isochoric energies of rubber.
//!
//! Each is a function `W_iso(I1, I2)` of the invariants of the isochoric part `J^-1/3 F` of the
//! deformation gradient, in a file of its own, but for [Ogden's law](super::OgdenTerm) in
//! principal stretches. Further ones implement [`IsochoricLaw`].

pub(super) mod arruda_boyce;
pub(super) mod gent;
mod inadmissible;
pub(super) mod mooney_rivlin;
pub(super) mod neo_hookean;
pub(super) mod ogden;
mod own;
pub(super) mod yeoh;

pub use inadmissible::InadmissibleHyperelastic;
pub use own::{IsochoricLaw, OwnIsochoric};

use super::invariants::Invariant;
use super::{OgdenTerm, ResponseError};
use nalgebra::{Matrix3, Vector3};
use num_dual::{DualNum, hessian};
use serde::Serialize;
use striae_declared::Values;

/// Isochoric part of the stored energy. Moduli are stresses.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub enum Isochoric {
    /// `G/2 (I1 - 3)`.
    NeoHookean {
        /// Shear modulus `G`.
        shear: f64,
    },
    /// `c10 (I1 - 3) + c01 (I2 - 3)`.
    MooneyRivlin {
        /// `c10`.
        c10: f64,
        /// `c01`.
        c01: f64,
    },
    /// `c10 (I1 - 3) + c20 (I1 - 3)^2 + c30 (I1 - 3)^3`.
    Yeoh {
        /// `c10`.
        c10: f64,
        /// `c20`.
        c20: f64,
        /// `c30`.
        c30: f64,
    },
    /// `-G Jm/2 ln(1 - (I1 - 3)/Jm)`: chains of finite length.
    Gent {
        /// Shear modulus `G`.
        shear: f64,
        /// `Jm`, the limit of `I1 - 3`; without unit.
        limit: f64,
    },
    /// The eight-chain model, by the first five terms of its series.
    ArrudaBoyce {
        /// `mu`, near the shear modulus.
        mu: f64,
        /// `lm`, the stretch at which chains lock; without unit.
        locking_stretch: f64,
    },
    /// Ogden's terms in principal stretches.
    Ogden(Box<[OgdenTerm]>),
    /// A law that implements [`IsochoricLaw`].
    Own(OwnIsochoric),
}

impl Isochoric {
    /// An energy that implements [`IsochoricLaw`].
    pub fn own(law: impl IsochoricLaw + 'static) -> Self {
        Self::Own(OwnIsochoric::new(law))
    }

    /// The name of the law.
    pub fn name(&self) -> &str {
        match self {
            Self::NeoHookean { .. } => "isochoric neo-Hookean",
            Self::MooneyRivlin { .. } => "Mooney-Rivlin",
            Self::Yeoh { .. } => "Yeoh",
            Self::Gent { .. } => "Gent",
            Self::ArrudaBoyce { .. } => "Arruda-Boyce",
            Self::Ogden(_) => "Ogden",
            Self::Own(own) => own.law().name(),
        }
    }

    /// The shear modulus `G` at rest.
    pub fn shear(&self) -> f64 {
        match self {
            Self::NeoHookean { shear } | Self::Gent { shear, .. } => *shear,
            Self::MooneyRivlin { c10, c01 } => 2.0 * (c10 + c01),
            Self::Yeoh { c10, .. } => 2.0 * c10,
            Self::ArrudaBoyce {
                mu,
                locking_stretch,
            } => arruda_boyce::shear(*mu, *locking_stretch),
            Self::Ogden(terms) => ogden::shear(terms),
            Self::Own(own) => own.law().shear(),
        }
    }

    /// Name of the declared law and values of its parameters, for energies of this crate.
    pub(super) fn stated(&self) -> Option<(&'static str, Values)> {
        Some(match self {
            Self::NeoHookean { shear } => (
                neo_hookean::ISOCHORIC_NEO_HOOKEAN.name,
                [("shear_modulus", *shear)].into(),
            ),
            Self::MooneyRivlin { c10, c01 } => (
                mooney_rivlin::MOONEY_RIVLIN.name,
                [("c10", *c10), ("c01", *c01)].into(),
            ),
            Self::Yeoh { c10, c20, c30 } => (
                yeoh::YEOH.name,
                [("c10", *c10), ("c20", *c20), ("c30", *c30)].into(),
            ),
            Self::Gent { shear, limit } => (
                gent::GENT.name,
                [("shear_modulus", *shear), ("limit", *limit)].into(),
            ),
            Self::ArrudaBoyce {
                mu,
                locking_stretch,
            } => (
                arruda_boyce::ARRUDA_BOYCE.name,
                [("mu", *mu), ("locking_stretch", *locking_stretch)].into(),
            ),
            Self::Ogden(terms) => (ogden::OGDEN.name, ogden::values(terms)),
            Self::Own(_) => return None,
        })
    }

    /// `W_iso` of isochoric invariants; laws in principal stretches have none.
    pub(super) fn energy(&self, i1: Invariant, i2: Invariant) -> Invariant {
        match self {
            Self::NeoHookean { shear } => neo_hookean::energy(*shear, i1),
            Self::MooneyRivlin { c10, c01 } => mooney_rivlin::energy(*c10, *c01, i1, i2),
            Self::Yeoh { c10, c20, c30 } => yeoh::energy([*c10, *c20, *c30], i1),
            Self::Gent { shear, limit } => gent::energy(*shear, *limit, i1),
            Self::ArrudaBoyce {
                mu,
                locking_stretch,
            } => arruda_boyce::energy(*mu, *locking_stretch, i1),
            Self::Ogden(_) => unreachable!("Ogden's law has its own response"),
            Self::Own(own) => own.law().energy(i1, i2),
        }
    }

    /// `W_iso` with its first and second derivatives by the logarithmic principal stretches,
    /// of which the deviator counts.
    ///
    /// # Errors
    ///
    /// [`ResponseError::Overstretched`] beyond the length of the chains.
    pub(super) fn principal(
        &self,
        strains: &Vector3<f64>,
    ) -> Result<(f64, Vector3<f64>, Matrix3<f64>), ResponseError> {
        if let Some(limit) = self.limit() {
            let mean = strains.mean();
            let strain = strains.map(|e| (2.0 * (e - mean)).exp_m1()).sum();
            if strain >= limit {
                return Err(ResponseError::Overstretched { strain, limit });
            }
        }
        Ok(hessian(
            |strains| {
                let mean = (strains[0] + strains[1] + strains[2]) / 3.0;
                let powers = |exponent: f64| {
                    let power = |a: usize| ((strains[a] - mean) * exponent).exp();
                    power(0) + power(1) + power(2)
                };
                match self {
                    Self::Ogden(terms) => terms.iter().fold(Invariant::from(0.0), |sum, term| {
                        sum + (powers(term.alpha) - 3.0) * (term.mu / term.alpha)
                    }),
                    _ => self.energy(powers(2.0), powers(-2.0)),
                }
            },
            strains,
        ))
    }

    /// Refuses a stretch beyond the length of the chains.
    pub(super) fn within_limit(&self, f: &Matrix3<f64>) -> Result<(), ResponseError> {
        let Some(limit) = self.limit() else {
            return Ok(());
        };
        let determinant = f.determinant();
        let strain = f.norm_squared() * determinant.abs().powf(-2.0 / 3.0) - 3.0;
        if determinant > 0.0 && strain >= limit {
            return Err(ResponseError::Overstretched { strain, limit });
        }
        Ok(())
    }

    /// The limit of `I1 - 3`, if there is one.
    fn limit(&self) -> Option<f64> {
        match self {
            Self::Gent { limit, .. } => Some(*limit),
            Self::Own(own) => own.law().limit(),
            _ => None,
        }
    }

    pub(super) fn check(&self) -> Result<(), InadmissibleHyperelastic> {
        match self {
            Self::NeoHookean { shear } => positive("shear_modulus", *shear),
            Self::MooneyRivlin { c10, c01 } => finite([("c10", *c10), ("c01", *c01)]),
            Self::Yeoh { c10, c20, c30 } => finite([("c10", *c10), ("c20", *c20), ("c30", *c30)]),
            Self::Gent { shear, limit } => {
                positive("shear_modulus", *shear)?;
                positive("limit", *limit)
            }
            Self::ArrudaBoyce {
                mu,
                locking_stretch,
            } => arruda_boyce::check(*mu, *locking_stretch),
            Self::Ogden(terms) => ogden::check(terms),
            Self::Own(_) => Ok(()),
        }
    }
}

fn finite<const N: usize>(
    constants: [(&'static str, f64); N],
) -> Result<(), InadmissibleHyperelastic> {
    match constants.into_iter().find(|(_, value)| !value.is_finite()) {
        Some((name, value)) => Err(InadmissibleHyperelastic::NotFinite { name, value }),
        None => Ok(()),
    }
}

fn positive(name: &'static str, value: f64) -> Result<(), InadmissibleHyperelastic> {
    finite([(name, value)])?;
    if value > 0.0 {
        Ok(())
    } else {
        Err(InadmissibleHyperelastic::NotPositive { name, value })
    }
}
