//! What can be wrong with the constants of a friction law.

use thiserror::Error;

/// A friction law whose constants are refused.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
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
}

/// Accepts a finite value that is positive.
pub(super) fn positive(name: &'static str, value: f64) -> Result<f64, FrictionError> {
    within(name, value, "positive and finite", value > 0.0)
}

/// Accepts a finite value that is not negative.
pub(super) fn not_negative(name: &'static str, value: f64) -> Result<f64, FrictionError> {
    within(name, value, "zero or positive, and finite", value >= 0.0)
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
