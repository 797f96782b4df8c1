//! Errors of fits to measurements.

use thiserror::Error;

use super::range::{LARGEST_FRICTION, SPREADS};
use crate::friction::FrictionError;

/// Reason why a law cannot be fitted.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum FitError {
    /// A reading is no number.
    #[error("reading {reading} has the {quantity} {value}, but a finite number is needed")]
    NotFinite {
        /// Its number, from 0.
        reading: usize,
        /// Quantity that is wrong.
        quantity: &'static str,
        /// Its value.
        value: f64,
    },
    /// Friction is too large to be tangential over normal force.
    #[error(
        "reading {reading} has the friction {friction:e}, but it must lie between -{LARGEST_FRICTION} \
         and {LARGEST_FRICTION}: divide the tangential by the normal force"
    )]
    TooLarge {
        /// Its number, from 0.
        reading: usize,
        /// The friction.
        friction: f64,
    },
    /// A spread is out of range.
    #[error(
        "reading {reading} has the spread {spread}, but it must lie between {} and {}",
        SPREADS.start(),
        SPREADS.end()
    )]
    Spread {
        /// Its number, from 0.
        reading: usize,
        /// The spread.
        spread: f64,
    },
    /// Friction does not oppose slip on the whole.
    #[error(
        "the mean friction against slip is {mean}, but it must be positive: state the angle of slip, \
         not that of the force on the surface"
    )]
    NotOpposing {
        /// The mean.
        mean: f64,
    },
    /// The measurements leave constants open.
    #[error(
        "the measurements do not determine the constants of the law `{law}`: it needs {needed}"
    )]
    Undetermined {
        /// Name of the law.
        law: &'static str,
        /// Requirement on the quantity.
        needed: &'static str,
    },
    /// A level of confidence is none.
    #[error("the level of confidence {0} is refused: it must lie between 0 and 1, such as 0.95")]
    Level(f64),
    /// The fitted constants do not form a valid law.
    #[error(transparent)]
    Refused(#[from] FrictionError),
}
