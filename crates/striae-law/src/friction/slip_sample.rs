//! A point of a slip surface, and which slip belongs to it.
//!
//! Lengths are stresses over `varpi`; angles are in radians, in the frame `(e, e_perp)`
//! that the law states.

use nalgebra::Vector2;
use serde::Serialize;

/// Rule that assigns a slip direction to a traction on the slip surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub enum SlipRule {
    /// Each component of friction opposes that component of slip: `K = I`.
    Opposing,
    /// Slip is normal to the slip surface: `K = L^-1`.
    Associated,
}

impl SlipRule {
    /// Name of the rule in decks.
    pub fn name(self) -> &'static str {
        match self {
            Self::Opposing => "opposing",
            Self::Associated => "associated",
        }
    }

    /// Returns the rule with a name that the law declares.
    pub(super) fn named(name: &str) -> Self {
        match name == Self::Associated.name() {
            true => Self::Associated,
            false => Self::Opposing,
        }
    }
}

/// One point of a slip surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SlipSample {
    /// Angle `phi` of `z` from `e`.
    pub angle: f64,
    /// Slip direction `d`, a unit vector in `(e, e_perp)`.
    pub slip: Vector2<f64>,
    /// `w = -tau/varpi` in `(e, e_perp)`.
    pub traction: Vector2<f64>,
    /// Angle from `d` to `w`, positive from `e` towards `e_perp`.
    pub deviation: f64,
}

/// Extremes of a slip surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extremes {
    /// Largest `|w|`.
    pub traction: f64,
    /// Largest angle between `d` and `w`.
    pub deviation: f64,
}

impl SlipSample {
    /// Dissipation `w . d` over `varpi |du|`.
    pub fn dissipation(&self) -> f64 {
        self.slip.dot(&self.traction)
    }
}

/// `count` points, at equal steps of the angle from 0.
pub(super) fn sampled(count: usize, at: impl Fn(f64) -> SlipSample) -> Vec<SlipSample> {
    let step = std::f64::consts::TAU / count as f64;
    (0..count).map(|i| at(i as f64 * step)).collect()
}
