//! Shape of a friction law at one angle between the two textures: the slip surface for polar plots,
//! the angle between traction and slip, extremes, and the margin by which slip dissipates.
//!
//! Shapes as in [`SlipSurface`]: over `varpi`, in the frame `(e, e_perp)` where `e`
//! is the direction of `a_ba` (two textures) or the texture `a` (one texture), and
//! `e_perp` a quarter turn from it; the angle between the textures has no effect on
//! laws for a single one.

use super::two_textures::LeastDissipation;
use super::{Extremes, Friction, Law, SlipSample, SlipSurface};

/// A friction law at one angle between the textures.
#[derive(Clone, Debug, PartialEq)]
pub struct Analysis {
    /// Angle between the textures `a_a` and `a_b'`, in radians.
    pub theta: f64,
    /// The slip surface.
    pub surface: SlipSurface,
    /// Points of the slip surface, at equal steps of the angle of `z`.
    pub samples: Vec<SlipSample>,
    /// Largest traction and largest angle between traction and slip.
    pub extremes: Extremes,
    /// Slip that dissipates least at this angle between the textures.
    pub least: SlipSample,
    /// Slip that dissipates least over all angles between the textures; `None` if the law does not
    /// depend on this angle.
    pub least_over_textures: Option<LeastDissipation>,
}

impl Analysis {
    /// Looks at `friction` with textures at the angle `theta` (radians), at
    /// `count` points of the slip surface.
    pub fn new(friction: &Friction, theta: f64, count: usize) -> Self {
        let surface = friction.slip_surface(theta);
        let least_over_textures = match friction.law() {
            Law::TwoTextures(law) => Some(law.least_dissipation()),
            _ => None,
        };
        Self {
            theta,
            samples: surface.sampled(count),
            extremes: surface.extremes(),
            least: surface.least_dissipation(),
            surface,
            least_over_textures,
        }
    }
}
