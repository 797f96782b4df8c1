//! The slip surface of an affine law whose axes are not those of the texture.
//!
//! ```text
//! w = -tau/varpi = L z/varpi + eta ,   |z| = varpi ,   d ~ K z
//! Gamma(v): |L^-1 (v - Gamma eta)| = Gamma
//!         = [-a.b + sqrt((a.b)^2 + (1 - b.b) a.a)]/(1 - b.b) ,   a = L^-1 v , b = L^-1 eta
//! ```
//!
//! An ellipse around the origin as long as `|b| < 1`. Extremes are the best of samples in
//! steps of half a degree.

use nalgebra::{Matrix2, Vector2};
use serde::Serialize;

use super::slip_sample::{Extremes, SlipSample, sampled};

/// Points among which extremes are sought.
const SAMPLES: usize = 720;

/// `L`, `eta` and `K` in the frame `(e, e_perp)`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Oblique {
    l: Matrix2<f64>,
    eta: Vector2<f64>,
    k: Matrix2<f64>,
    /// `L^-1`.
    inverse: Matrix2<f64>,
}

impl Oblique {
    /// The surface, if it encloses the origin.
    pub(super) fn new(l: Matrix2<f64>, eta: Vector2<f64>, k: Matrix2<f64>) -> Option<Self> {
        let inverse = l.try_inverse()?;
        let finite = k.iter().chain(&l).all(|x| x.is_finite());
        (finite && (inverse * eta).norm() < 1.0).then_some(Self { l, eta, k, inverse })
    }

    /// The point with `z` at the angle `phi` from `e`.
    pub fn at(&self, angle: f64) -> SlipSample {
        let (sine, cosine) = angle.sin_cos();
        let z = Vector2::new(cosine, sine);
        let (traction, slip) = (self.l * z + self.eta, (self.k * z).normalize());
        SlipSample {
            angle,
            slip,
            traction,
            deviation: slip.perp(&traction).atan2(slip.dot(&traction)),
        }
    }

    /// `Gamma(v)`: the least `varpi` whose slip surface holds `v = -tau`.
    pub fn gauge(&self, v: &Vector2<f64>) -> f64 {
        let (a, b) = (self.inverse * v, self.inverse * self.eta);
        let inside = 1.0 - b.norm_squared();
        let along = a.dot(&b);
        let root = (along * along + inside * a.norm_squared()).sqrt();
        if along > 0.0 {
            a.norm_squared() / (root + along) // the same, without cancellation
        } else {
            (root - along) / inside
        }
    }

    /// The angle `phi` at which the ray along `v = -tau` meets the slip surface.
    pub fn angle(&self, v: &Vector2<f64>) -> f64 {
        let z = self.inverse * (v / self.gauge(v) - self.eta);
        z.y.atan2(z.x)
    }

    /// Largest traction and largest angle between traction and slip.
    pub fn extremes(&self) -> Extremes {
        let none = Extremes {
            traction: 0.0,
            deviation: 0.0,
        };
        let samples = sampled(SAMPLES, |angle| self.at(angle));
        samples.iter().fold(none, |most, sample| Extremes {
            traction: most.traction.max(sample.traction.norm()),
            deviation: most.deviation.max(sample.deviation.abs()),
        })
    }

    /// The point where slip dissipates least.
    pub fn least_dissipation(&self) -> SlipSample {
        sampled(SAMPLES, |angle| self.at(angle))
            .into_iter()
            .reduce(|least, other| {
                if other.dissipation() < least.dissipation() {
                    other
                } else {
                    least
                }
            })
            .expect("there are samples")
    }
}
