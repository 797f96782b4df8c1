//! The slip function (37) as published, for comparison only.
//!
//! The paper derives its slip function from its (30)_2, where the middle term
//! lacks a factor 2. With `alpha_0 = A`, `alpha_1 = B (c_cen + I1)`,
//! `J1 = a_ba . v` and `v = -tau` this becomes
//!
//! ```text
//! |w|^2 = alpha_0^2 + alpha_0 alpha_1 I1 + alpha_1^2 m^2                      (30)_2
//! |v|^2 = A^2 Gamma^2 + (A B c_cen / P) J1 Gamma + (B / P) J1^2 ,
//! Gamma(v) = [-(B c_cen/P) J1 + sqrt((B c_cen/P)^2 J1^2 + 4 (|v|^2 - B J1^2/P))]/(2 A) .
//! ```
//!
//! The sign of the term linear in `J1` is the derived one. The slip surface is an
//! ellipse with centre `h/2`, semi-axes `R` along `e` and `R sqrt(A/P)` across it,
//! `R^2 = A P + h^2/4`. It contradicts the slip rule (36): for aligned textures and
//! `c = (0.1, 0.1, 0.5)` it reaches 1.55 and 1.35 along `+e` and `-e`, where the
//! slip rule gives 2.10 and 1.70. So it serves to redraw figures 5 and 6 of
//! Jones & Papadopoulos (2006) and is no [`Law`](super::Law).

use nalgebra::Vector2;

use super::TwoTextures;
use super::ellipse::Ellipse;
use super::slip_sample::{SlipSample, sampled};

/// The published slip function at one contact point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Published {
    exact: Ellipse,
}

impl Published {
    /// For the constants of `law` and textures at the angle `theta` (radians).
    pub fn new(law: &TwoTextures, theta: f64) -> Self {
        Self {
            exact: law.slip_surface(theta),
        }
    }

    /// `Gamma(v)` for `v = -tau` in the frame `(e, e_perp)` of `a_ba`.
    #[allow(non_snake_case)]
    pub fn gauge(&self, v: &Vector2<f64>) -> f64 {
        let (P, A, h) = (self.exact.along, self.exact.across, self.exact.offset);
        let linear = h / P * v.x;
        let square = A / P * v.x * v.x + v.y * v.y;
        ((linear * linear + 4.0 * square).sqrt() - linear) / (2.0 * A)
    }

    /// The point of the slip surface that belongs to the slip direction at the
    /// angle `phi` from `e`: the direction of traction is that of the slip rule
    /// (36), its size that of the published slip function.
    pub fn at(&self, angle: f64) -> SlipSample {
        let sample = self.exact.at(angle);
        SlipSample {
            traction: sample.traction / self.gauge(&sample.traction),
            ..sample
        }
    }

    /// `count` points, at equal steps of `phi` from 0.
    pub fn sampled(&self, count: usize) -> Vec<SlipSample> {
        sampled(count, |angle| self.at(angle))
    }
}
