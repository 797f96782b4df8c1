//! What can be wrong with the constants of a friction law.

use thiserror::Error;

/// A friction law whose constants are refused.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum FrictionError {
    /// A constant lies outside its range.
    #[error("{name} = {value} is refused: it must be {expected}")]
    Constant {
        /// Name of the constant.
        name: &'static str,
        /// Its value.
        value: f64,
        /// What it has to be, to complete "it must be ...".
        expected: &'static str,
    },
    /// Friction between two textured surfaces would create energy.
    #[error(
        "friction would create energy: textures with a_a . a_b' = I0 = {i0:.6} and slip with \
         a_ba . d = I1 = {i1:.6} give a dissipation -tau . d / varpi = {dissipation:.6}"
    )]
    CreatesEnergy {
        /// Cosine of the angle between the textures.
        i0: f64,
        /// Slip direction, `a_ba . d`.
        i1: f64,
        /// Dissipation over `varpi |du|`, zero or negative.
        dissipation: f64,
    },
    /// Friction on one textured surface would create energy.
    #[error(
        "friction would create energy: slip at {degrees:.3} degrees from the texture `a` gives a \
         dissipation -tau . d / p = {dissipation:.6}"
    )]
    CreatesEnergyAlong {
        /// Angle of slip from the texture, in degrees.
        degrees: f64,
        /// Dissipation over `p |du|`, zero or negative.
        dissipation: f64,
    },
}

/// Accepts a finite value that is positive.
pub(super) fn positive(name: &'static str, value: f64) -> Result<f64, FrictionError> {
    within(name, value, "positive and finite", value > 0.0)
}

/// Accepts a finite value that is not negative.
pub(super) fn not_negative(name: &'static str, value: f64) -> Result<f64, FrictionError> {
    within(name, value, "zero or positive, and finite", value >= 0.0)
}

/// Accepts a finite value.
pub(super) fn finite(name: &'static str, value: f64) -> Result<f64, FrictionError> {
    within(name, value, "finite", true)
}

fn within(
    name: &'static str,
    value: f64,
    expected: &'static str,
    inside: bool,
) -> Result<f64, FrictionError> {
    if inside && value.is_finite() {
        Ok(value)
    } else {
        Err(FrictionError::Constant {
            name,
            value,
            expected,
        })
    }
}
