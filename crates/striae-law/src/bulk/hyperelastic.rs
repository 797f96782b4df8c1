//! Rubber: an isochoric energy of the shape and a volumetric one.
//!
//! With `I1`, `I2` of the isochoric part `J^-1/3 F` of the deformation gradient,
//!
//! ```text
//! W = W_iso(I1, I2) + U(J)
//!
//! neo-Hooke      G/2 (I1 - 3)
//! Mooney-Rivlin  c10 (I1 - 3) + c01 (I2 - 3)                              G = 2 (c10 + c01)
//! Yeoh           c10 (I1 - 3) + c20 (I1 - 3)^2 + c30 (I1 - 3)^3           G = 2 c10
//! Gent           -G Jm/2 ln(1 - (I1 - 3)/Jm) ,   I1 - 3 < Jm
//! Arruda-Boyce   mu sum_i C_i/lm^(2i-2) (I1^i - 3^i) ,   i = 1 .. 5
//! ```
//!
//! and [Ogden's law](super::OgdenTerm) in principal stretches. `C_i` = 1/2, 1/20, 11/1050,
//! 19/7000, 519/673750 are the series of the inverse Langevin function; the shear modulus of
//! that law is `G = mu (1 + 3/(5 lm^2) + 99/(175 lm^4) + 513/(875 lm^6) + 42039/(67375 lm^8))`.
//! The bulk modulus `K` is that of the volumetric part.
//!
//! Sources: Mooney, J. Appl. Phys. 11 (1940) 582-592, doi:10.1063/1.1712836; Yeoh, Rubber
//! Chem. Technol. 66 (1993) 754-771, doi:10.5254/1.3538343; Gent, Rubber Chem. Technol. 69
//! (1996) 59-61, doi:10.5254/1.3538357; Arruda & Boyce, J. Mech. Phys. Solids 41 (1993)
//! 389-412, doi:10.1016/0022-5096(93)90013-6; the isochoric split of Flory, Trans. Faraday
//! Soc. 57 (1961) 829-838, doi:10.1039/TF9615700829.

use super::invariants::{self, Invariant};
use super::ogden;
use super::{LameConstants, OgdenTerm, Response, ResponseError, Volumetric};
use nalgebra::{Matrix3, Vector3};
use num_dual::{DualNum, hessian};
use serde::Serialize;

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
}

/// A nearly incompressible elastic solid.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Hyperelastic {
    isochoric: Isochoric,
    bulk: f64,
    volumetric: Volumetric,
}

/// Constants for which a hyperelastic law would not be stable at rest.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum InadmissibleHyperelastic {
    /// A constant is no finite number.
    #[error("`{name}` is {value}, but it must be a finite number")]
    NotFinite {
        /// Name of the constant.
        name: &'static str,
        /// Its value.
        value: f64,
    },
    /// A constant must be positive.
    #[error("`{name}` is {value}, but it must be positive")]
    NotPositive {
        /// Name of the constant.
        name: &'static str,
        /// Its value.
        value: f64,
    },
    /// An exponent of Ogden's law is zero.
    #[error("`alpha` of term {0} is 0, but it must be positive or negative")]
    NoExponent(usize),
    /// Ogden's law without a term.
    #[error("the law has no term, but it needs at least one")]
    NoTerm,
    /// The shear modulus at rest.
    #[error("the constants give the shear modulus {0} at rest, but it must be positive")]
    Shear(f64),
    /// Chains that lock before they are stretched.
    #[error("`locking_stretch` is {0}, but it must be above 1")]
    Locked(f64),
    /// The bulk modulus.
    #[error(
        "the bulk modulus is {bulk} and the shear modulus {shear}: Poisson's ratio would be {ratio}, but it must be above -1 and below 0.5"
    )]
    Bulk {
        /// Bulk modulus.
        bulk: f64,
        /// Shear modulus at rest.
        shear: f64,
        /// Poisson's ratio at rest.
        ratio: f64,
    },
}

/// Coefficients of the series of the inverse Langevin function.
const LANGEVIN: [f64; 5] = [
    1.0 / 2.0,
    1.0 / 20.0,
    11.0 / 1050.0,
    19.0 / 7000.0,
    519.0 / 673_750.0,
];

impl Hyperelastic {
    /// The law with an isochoric part and the volumetric energy of a bulk modulus.
    ///
    /// # Errors
    ///
    /// When a constant is not finite, or the solid would not be stable at rest.
    pub fn new(
        isochoric: Isochoric,
        bulk: f64,
        volumetric: Volumetric,
    ) -> Result<Self, InadmissibleHyperelastic> {
        isochoric.check()?;
        let shear = isochoric.shear();
        if shear.is_nan() || shear <= 0.0 {
            return Err(InadmissibleHyperelastic::Shear(shear));
        }
        if !(bulk > 0.0 && bulk.is_finite()) {
            let ratio = (3.0 * bulk - 2.0 * shear) / (6.0 * bulk + 2.0 * shear);
            return Err(InadmissibleHyperelastic::Bulk { bulk, shear, ratio });
        }
        Ok(Self {
            isochoric,
            bulk,
            volumetric,
        })
    }

    /// The law whose bulk modulus follows from Poisson's ratio at rest.
    ///
    /// # Errors
    ///
    /// As [`Hyperelastic::new`].
    pub fn with_poissons_ratio(
        isochoric: Isochoric,
        ratio: f64,
        volumetric: Volumetric,
    ) -> Result<Self, InadmissibleHyperelastic> {
        isochoric.check()?;
        let shear = isochoric.shear();
        let bulk = 2.0 * shear * (1.0 + ratio) / (3.0 * (1.0 - 2.0 * ratio));
        if !(ratio > -1.0 && ratio < 0.5) {
            return Err(InadmissibleHyperelastic::Bulk { bulk, shear, ratio });
        }
        Self::new(isochoric, bulk, volumetric)
    }

    /// The isochoric part.
    pub fn isochoric(&self) -> &Isochoric {
        &self.isochoric
    }

    /// The bulk modulus `K` at rest.
    pub fn bulk(&self) -> f64 {
        self.bulk
    }

    /// The form of the volumetric energy.
    pub fn volumetric(&self) -> Volumetric {
        self.volumetric
    }

    /// The Lame constants of the small-strain limit.
    pub fn lame_constants(&self) -> LameConstants {
        let shear = self.isochoric.shear();
        LameConstants {
            lambda: self.bulk - 2.0 / 3.0 * shear,
            shear,
        }
    }

    pub(super) fn response(&self, f: &Matrix3<f64>) -> Result<Response, ResponseError> {
        if let Isochoric::Ogden(terms) = &self.isochoric {
            return ogden::response(terms, self.volumetric, self.bulk, f);
        }
        self.isochoric.within_limit(f)?;
        invariants::response(f, |i1, i2, j| self.energy(i1, i2, j))
    }

    /// `W` of the invariants of `F` itself.
    fn energy(&self, i1: Invariant, i2: Invariant, j: Invariant) -> Invariant {
        let scale = j.powf(-2.0 / 3.0);
        let isochoric = self.isochoric.energy(i1 * scale, i2 * scale * scale);
        isochoric + self.volumetric.energy(self.bulk, j)
    }
}

impl Isochoric {
    /// The name of the law.
    pub fn name(&self) -> &'static str {
        match self {
            Self::NeoHookean { .. } => "isochoric neo-Hookean",
            Self::MooneyRivlin { .. } => "Mooney-Rivlin",
            Self::Yeoh { .. } => "Yeoh",
            Self::Gent { .. } => "Gent",
            Self::ArrudaBoyce { .. } => "Arruda-Boyce",
            Self::Ogden(_) => "Ogden",
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
            } => {
                let square = locking_stretch.powi(-2);
                let series = (1..=5).rev().fold(0.0, |sum, i| {
                    let slope = 2.0 * f64::from(i) * LANGEVIN[i as usize - 1] * 3f64.powi(i - 1);
                    sum * square + slope
                });
                mu * series
            }
            Self::Ogden(terms) => ogden::shear(terms),
        }
    }

    /// `W_iso` of isochoric invariants; laws in principal stretches have none.
    fn energy(&self, i1: Invariant, i2: Invariant) -> Invariant {
        let strain = i1 - 3.0;
        match self {
            Self::NeoHookean { shear } => strain * (0.5 * shear),
            Self::MooneyRivlin { c10, c01 } => strain * *c10 + (i2 - 3.0) * *c01,
            Self::Yeoh { c10, c20, c30 } => strain * (strain * (strain * *c30 + *c20) + *c10),
            Self::Gent { shear, limit } => (-strain / *limit).ln_1p() * (-0.5 * shear * limit),
            Self::ArrudaBoyce {
                mu,
                locking_stretch,
            } => {
                let square = locking_stretch.powi(-2);
                let mut sum = Invariant::from(0.0);
                for (i, c) in (1..=5).zip(LANGEVIN) {
                    sum += (i1.powi(i) - 3f64.powi(i)) * (c * square.powi(i - 1));
                }
                sum * *mu
            }
            Self::Ogden(_) => unreachable!("Ogden's law has its own response"),
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
        if let Self::Gent { limit, .. } = self {
            let mean = strains.mean();
            let strain = strains.map(|e| (2.0 * (e - mean)).exp_m1()).sum();
            if strain >= *limit {
                let limit = *limit;
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
    fn within_limit(&self, f: &Matrix3<f64>) -> Result<(), ResponseError> {
        let Self::Gent { limit, .. } = self else {
            return Ok(());
        };
        let determinant = f.determinant();
        let strain = f.norm_squared() * determinant.abs().powf(-2.0 / 3.0) - 3.0;
        if determinant > 0.0 && strain >= *limit {
            return Err(ResponseError::Overstretched {
                strain,
                limit: *limit,
            });
        }
        Ok(())
    }

    fn check(&self) -> Result<(), InadmissibleHyperelastic> {
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
            } => {
                positive("mu", *mu)?;
                finite([("locking_stretch", *locking_stretch)])?;
                if *locking_stretch > 1.0 {
                    Ok(())
                } else {
                    Err(InadmissibleHyperelastic::Locked(*locking_stretch))
                }
            }
            Self::Ogden(terms) => check_terms(terms),
        }
    }
}

fn check_terms(terms: &[OgdenTerm]) -> Result<(), InadmissibleHyperelastic> {
    if terms.is_empty() {
        return Err(InadmissibleHyperelastic::NoTerm);
    }
    for (at, term) in terms.iter().enumerate() {
        finite([("mu", term.mu), ("alpha", term.alpha)])?;
        if term.alpha == 0.0 {
            return Err(InadmissibleHyperelastic::NoExponent(at));
        }
    }
    Ok(())
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
