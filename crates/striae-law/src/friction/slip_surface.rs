//! The slip surface of a law at one contact point, of whatever shape.
//!
//! Lengths are stresses over `varpi`; angles are in radians, in the frame `(e, e_perp)`
//! that the law states.

use nalgebra::Vector2;

use super::{ellipse::Ellipse, oblique::Oblique, star::Star};

/// Which slip direction belongs to a traction on the slip surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SlipRule {
    /// Each component of friction opposes that component of slip: `K = I`.
    Opposing,
    /// Slip is normal to the slip surface: `K = L^-1`.
    Associated,
}

/// A slip surface over `varpi`.
#[derive(Clone, Debug, PartialEq)]
pub enum SlipSurface {
    /// Of the laws `-tau = L z + varpi eta`.
    Ellipse(Ellipse),
    /// Of tabulated friction.
    Star(Star),
    /// Of affine laws from outside.
    Oblique(Oblique),
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

impl SlipSurface {
    /// The point with `z` at the angle `phi` from `e`.
    pub fn at(&self, angle: f64) -> SlipSample {
        match self {
            Self::Ellipse(ellipse) => ellipse.at(angle),
            Self::Star(star) => star.at(angle),
            Self::Oblique(oblique) => oblique.at(angle),
        }
    }

    /// `count` points, at equal steps of `phi` from 0.
    pub fn sampled(&self, count: usize) -> Vec<SlipSample> {
        sampled(count, |angle| self.at(angle))
    }

    /// `Gamma(v)`: the least `varpi` whose slip surface holds `v = -tau`.
    pub fn gauge(&self, v: &Vector2<f64>) -> f64 {
        match self {
            Self::Ellipse(ellipse) => ellipse.gauge(v),
            Self::Star(star) => star.gauge(v),
            Self::Oblique(oblique) => oblique.gauge(v),
        }
    }

    /// The angle `phi` at which the ray along `v = -tau` meets the slip surface;
    /// inverse of [`SlipSurface::at`].
    pub fn angle(&self, v: &Vector2<f64>) -> f64 {
        match self {
            Self::Ellipse(ellipse) => ellipse.angle(v),
            Self::Star(star) => star.angle(v),
            Self::Oblique(oblique) => oblique.angle(v),
        }
    }

    /// Largest traction and largest angle between traction and slip.
    pub fn extremes(&self) -> Extremes {
        match self {
            Self::Ellipse(ellipse) => ellipse.extremes(),
            Self::Star(star) => star.extremes(),
            Self::Oblique(oblique) => oblique.extremes(),
        }
    }

    /// The point where slip dissipates least.
    pub fn least_dissipation(&self) -> SlipSample {
        match self {
            Self::Ellipse(ellipse) => ellipse.least_dissipation(),
            Self::Star(star) => star.least_dissipation(),
            Self::Oblique(oblique) => oblique.least_dissipation(),
        }
    }
}

/// `count` points, at equal steps of the angle from 0.
pub(super) fn sampled(count: usize, at: impl Fn(f64) -> SlipSample) -> Vec<SlipSample> {
    let step = std::f64::consts::TAU / count as f64;
    (0..count).map(|i| at(i as f64 * step)).collect()
}
