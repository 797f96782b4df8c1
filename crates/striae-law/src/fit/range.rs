//! Ranges of what is measured.

use std::ops::RangeInclusive;

/// Friction over pressure beyond which a reading is refused: a force that was not divided.
pub const LARGEST_FRICTION: f64 = 1e3;
/// Spreads beside each other that readings can be weighted by without loss of digits.
pub const SPREADS: RangeInclusive<f64> = 1e-6..=1e6;
