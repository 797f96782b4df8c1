//! The slip surface of a law at one contact point, of whatever shape.
//!
//! Lengths are stresses over `varpi`; angles are in radians, in the frame `(e, e_perp)`
//! that the law states.

use nalgebra::Vector2;

use super::{
    ellipse::Ellipse,
    oblique::Oblique,
    slip_sample::{Extremes, SlipSample, sampled},
    star::Star,
};

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
