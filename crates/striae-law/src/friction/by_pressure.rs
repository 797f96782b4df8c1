//! Coefficients of friction that depend on the pressure.
//!
//! The bound on friction is `varpi = mu P(p)` with a function `P` that has the unit of pressure
//! and is `p` for a constant coefficient; the coefficient is `mu P(p)/p`.
//!
//! ```text
//! power law     P = p0 (p/p0)^m                     mu at the pressure p0
//! adhesion      P = p + p_ad                        mu for p >> p_ad (Derjaguin)
//! saturation    P = (tau/mu) tanh(mu p/tau)         mu for p -> 0, varpi below tau
//! table         P = f(p) p                          f monotone and cubic between points
//! ```
//!
//! # Pressures near zero
//!
//! A power law with `m < 1` has an infinite slope at `p = 0`, and with adhesion `P` jumps there
//! from the zero of an open contact. The increment is not well posed with either: the slip row of
//! a node that closes has the slope `varpi'`. So below a floor `p_f` friction is the parabola that
//! leaves zero and continues `P` with its value and slope,
//!
//! ```text
//! P = (2 V - S p_f) x + (S p_f - V) x^2 ,   x = p/p_f ,   V = P(p_f) ,   S = P'(p_f) .
//! ```
//!
//! As `S p_f <= V` in both, `P` is concave there, ascends, and its largest slope is
//! `(2 V - S p_f)/p_f`: of a power law `(2 - m) (p_f/p0)^(m-1)`, with adhesion
//! `1 + 2 p_ad/p_f`.
//!
//! # Admissible functions
//!
//! Slip dissipates `varpi` times what the law of the directions does, so `P > 0` for `p > 0`
//! suffices; all slopes `P'` are finite. Only a table can let friction fall as the pressure rises;
//! [`falling`](PressureDependence::falling) finds where.
//!
//! Sources: power law by Archard (1957), "Elastic deformation and the laws of friction", Proc. R.
//! Soc. Lond. A 243, 190-205, `m = 2/3` for a single elastic contact; the offset by Derjaguin
//! (1934), "Molekulartheorie der äußeren Reibung", Z. Phys. 88, 661-675.

use std::fmt;

use num_dual::{Dual64, DualNum};
use serde::Serialize;

use super::error::{FrictionError, positive};
use super::monotone::Monotone;

/// Dependence of coefficients of friction on the pressure.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct PressureDependence(Form);

/// Its forms.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
enum Form {
    #[default]
    None,
    PowerLaw {
        exponent: f64,
        pressure: f64,
        floor: f64,
    },
    Adhesion {
        pressure: f64,
        floor: f64,
    },
    Saturation {
        shear_stress: f64,
    },
    Table(Monotone),
}

/// The constants of a dependence on pressure.
#[derive(Clone, Debug, PartialEq)]
pub enum PressureConstants<'a> {
    /// Coefficients do not depend on the pressure.
    None,
    /// `(p/p0)^(m-1)`.
    PowerLaw {
        /// `m`.
        exponent: f64,
        /// `p0`.
        pressure: f64,
        /// `p_f`; without effect for `m >= 1`.
        floor: f64,
    },
    /// `(p + p_ad)/p`.
    Adhesion {
        /// `p_ad`.
        pressure: f64,
        /// `p_f`.
        floor: f64,
    },
    /// `tau tanh(mu p/tau)/(mu p)`.
    Saturation {
        /// `tau`.
        shear_stress: f64,
    },
    /// Pressures and factors of a table.
    Table(&'a [[f64; 2]]),
}

/// Floor of a power law over its reference pressure, where none is given.
pub const FLOOR_OF_POWER_LAW: f64 = 1e-3;
/// Floor of adhesion over its pressure, where none is given.
pub const FLOOR_OF_ADHESION: f64 = 0.05;

/// Number of points of an interval of a table at which its slope is checked.
const SAMPLES: u32 = 64;

/// Pressure over that of a power law below which there is no friction: with `m > 1` it has
/// vanished long before.
const VANISHING: f64 = 1e-90;

impl PressureDependence {
    /// Coefficients that are the stated ones at the pressure `p0` and vary with `(p/p0)^(m-1)`;
    /// below `floor`, by default [`FLOOR_OF_POWER_LAW`] times `p0`, as the module describes.
    ///
    /// # Errors
    /// When a constant is not positive.
    pub fn power_law(
        exponent: f64,
        pressure: f64,
        floor: Option<f64>,
    ) -> Result<Self, FrictionError> {
        let pressure = positive("pressure", pressure)?;
        Ok(Self(Form::PowerLaw {
            exponent: positive("exponent", exponent)?,
            pressure,
            floor: positive("floor", floor.unwrap_or(FLOOR_OF_POWER_LAW * pressure))?,
        }))
    }

    /// Friction that adhesion adds to, `varpi = mu (p + p_ad)`; below `floor`, by default
    /// [`FLOOR_OF_ADHESION`] times `p_ad`, as the module describes.
    ///
    /// # Errors
    /// When a constant is not positive.
    pub fn adhesion(pressure: f64, floor: Option<f64>) -> Result<Self, FrictionError> {
        let pressure = positive("pressure", pressure)?;
        Ok(Self(Form::Adhesion {
            pressure,
            floor: positive("floor", floor.unwrap_or(FLOOR_OF_ADHESION * pressure))?,
        }))
    }

    /// Friction that approaches the shear stress `tau` smoothly, `varpi = tau tanh(mu p/tau)` at
    /// rest.
    ///
    /// # Errors
    /// When the shear stress is not positive.
    pub fn saturation(shear_stress: f64) -> Result<Self, FrictionError> {
        Ok(Self(Form::Saturation {
            shear_stress: positive("shear_stress", shear_stress)?,
        }))
    }

    /// Coefficients that are those stated times `factors` at `pressures`: a monotone cubic
    /// between them, constant beyond the first and the last.
    ///
    /// # Errors
    /// When there are fewer than two pressures or not as many factors, pressures do not ascend
    /// from zero or above, or a factor is not positive.
    pub fn table(pressures: &[f64], factors: &[f64]) -> Result<Self, FrictionError> {
        let table = Monotone::through(pressures, factors, ["pressures", "factors"])?;
        Ok(Self(Form::Table(table)))
    }

    /// Its constants.
    pub fn constants(&self) -> PressureConstants<'_> {
        match &self.0 {
            Form::None => PressureConstants::None,
            &Form::PowerLaw {
                exponent,
                pressure,
                floor,
            } => PressureConstants::PowerLaw {
                exponent,
                pressure,
                floor,
            },
            &Form::Adhesion { pressure, floor } => PressureConstants::Adhesion { pressure, floor },
            &Form::Saturation { shear_stress } => PressureConstants::Saturation { shear_stress },
            Form::Table(table) => PressureConstants::Table(table.points()),
        }
    }

    /// Largest coefficient over the stated one.
    pub fn largest_factor(&self) -> f64 {
        match &self.0 {
            Form::None | Form::Saturation { .. } => 1.0,
            Form::PowerLaw { exponent, .. } if *exponent > 1.0 => f64::INFINITY,
            Form::PowerLaw {
                exponent,
                pressure,
                floor,
            } => (2.0 - exponent) * (floor / pressure).powf(exponent - 1.0),
            Form::Adhesion { pressure, floor } => 1.0 + 2.0 * pressure / floor,
            Form::Table(table) => table.points().iter().map(|[_, f]| *f).fold(0.0, f64::max),
        }
    }

    /// Pressure up to which the dependence is visible; `None` if there is none.
    pub fn scale(&self) -> Option<f64> {
        match &self.0 {
            Form::None => None,
            Form::PowerLaw { pressure, .. } => Some(3.0 * pressure),
            Form::Adhesion { pressure, .. } => Some(10.0 * pressure),
            Form::Saturation { shear_stress } => Some(10.0 * shear_stress),
            Form::Table(table) => Some(1.1 * table.last()),
        }
    }

    /// Pressures between which friction falls as the pressure rises, `P' < 0`, if it does
    /// anywhere: those of the first interval of a table.
    pub fn falling(&self) -> Option<[f64; 2]> {
        let Form::Table(table) = &self.0 else {
            return None;
        };
        let points = table.points().windows(2);
        points
            .map(|pair| [pair[0][0], pair[1][0]])
            .find(|[from, to]| {
                (0..SAMPLES).any(|i| {
                    let p = from + (to - from) * f64::from(i) / f64::from(SAMPLES);
                    let p = Dual64::from(p).derivative();
                    (table.at(p) * p).eps < 0.0
                })
            })
    }

    /// `P(p)` for `p > 0` and the coefficient `mu`.
    pub(super) fn at<D: DualNum<Primitive = f64> + Copy>(&self, mu: f64, p: D) -> D {
        match &self.0 {
            Form::None => p,
            &Form::PowerLaw {
                exponent,
                pressure,
                floor,
            } => {
                if exponent < 1.0 && p.re() < floor {
                    let value = pressure * (floor / pressure).powf(exponent);
                    return from_zero(p / floor, value, exponent * value);
                }
                let x = p / pressure;
                if x.re() < VANISHING {
                    return D::zero();
                }
                (x.ln() * exponent).exp() * pressure
            }
            &Form::Adhesion { pressure, floor } => {
                if p.re() < floor {
                    from_zero(p / floor, floor + pressure, floor)
                } else {
                    p + pressure
                }
            }
            &Form::Saturation { shear_stress } => {
                if mu == 0.0 {
                    return p;
                }
                (p * (mu / shear_stress)).tanh() * (shear_stress / mu)
            }
            Form::Table(table) => table.at(p) * p,
        }
    }
}

impl fmt::Display for PressureDependence {
    /// The formula of `P` with its constants.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.0 {
            Form::None => write!(f, "p"),
            Form::PowerLaw {
                exponent,
                pressure,
                floor,
            } => {
                write!(f, "{pressure} (p/{pressure})^{exponent}")?;
                match *exponent < 1.0 {
                    true => write!(f, ", a parabola below p = {floor}"),
                    false => Ok(()),
                }
            }
            Form::Adhesion { pressure, floor } => {
                write!(f, "p + {pressure}, a parabola below p = {floor}")
            }
            Form::Saturation { shear_stress } => {
                write!(f, "({shear_stress}/mu) tanh(mu p/{shear_stress})")
            }
            Form::Table(table) => write!(f, "p times {table}"),
        }
    }
}

/// The parabola over `x` that is zero at 0, and at 1 has a value and a slope.
fn from_zero<D: DualNum<Primitive = f64> + Copy>(x: D, value: f64, slope: f64) -> D {
    (x * (slope - value) + (2.0 * value - slope)) * x
}
