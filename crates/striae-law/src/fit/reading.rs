//! Measured friction.

use super::{
    FitError,
    range::{LARGEST_FRICTION, SPREADS},
};

/// Friction measured in one direction of slip.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reading {
    /// Direction of slip of the textured surface from `e`, counter-clockwise as seen from
    /// outside that surface (radians).
    pub slip: f64,
    /// Friction that opposes slip over pressure, `w . d`.
    pub against: f64,
    /// Friction a quarter turn from there, `w . d_perp`, where it was measured.
    pub across: Option<f64>,
    /// Angle between the textures `a_a` and `a_b'` of two textured surfaces (radians).
    pub theta: f64,
    /// Standard deviation in proportion to that of other readings.
    pub spread: f64,
    /// Number of the specimen that was measured; readings of one specimen share its error.
    pub specimen: usize,
}

impl Reading {
    /// Friction that was measured in the direction of slip only.
    pub fn against(slip: f64, friction: f64) -> Self {
        Self {
            slip,
            against: friction,
            across: None,
            theta: 0.0,
            spread: 1.0,
            specimen: 0,
        }
    }

    /// Friction of the size `|w|` with its direction: the angle of `w = -tau/p` from `e`.
    pub fn directed(slip: f64, friction: f64, direction: f64) -> Self {
        let (sine, cosine) = (direction - slip).sin_cos();
        Self {
            across: Some(friction * sine),
            ..Self::against(slip, friction * cosine)
        }
    }
}

/// The mean friction against slip of readings that are sound.
pub(super) fn mean_friction(readings: &[Reading]) -> Result<f64, FitError> {
    for (number, reading) in readings.iter().enumerate() {
        let quantities = [
            ("angle of slip", reading.slip),
            ("friction", reading.against),
            ("friction across slip", reading.across.unwrap_or(0.0)),
            ("angle between the textures", reading.theta),
            ("spread", reading.spread),
        ];
        if let Some((quantity, value)) = quantities.into_iter().find(|(_, x)| !x.is_finite()) {
            return Err(FitError::NotFinite {
                reading: number,
                quantity,
                value,
            });
        }
        let frictions = [reading.against, reading.across.unwrap_or(0.0)];
        if let Some(friction) = frictions.into_iter().find(|x| x.abs() > LARGEST_FRICTION) {
            return Err(FitError::TooLarge {
                reading: number,
                friction,
            });
        }
        if !SPREADS.contains(&reading.spread) {
            let spread = reading.spread;
            return Err(FitError::Spread {
                reading: number,
                spread,
            });
        }
    }
    let sum: f64 = readings.iter().map(|reading| reading.against).sum();
    let mean = sum / readings.len().max(1) as f64;
    if mean <= 0.0 && !readings.is_empty() {
        return Err(FitError::NotOpposing { mean });
    }
    Ok(mean)
}
