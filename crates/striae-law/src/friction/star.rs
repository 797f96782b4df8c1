//! A star-shaped slip surface with slip along the force it opposes.
//!
//! ```text
//! w = -tau/varpi = rho(phi) d ,   d = (cos phi, sin phi) ,   Gamma(v) = |v|/rho(phi of v)
//! ```
//!
//! in the axes in which `phi` is measured, see [`Tabulated`](super::Tabulated).

use nalgebra::Vector2;

use super::periodic::Periodic;
use super::slip_sample::{Extremes, SlipSample};

/// The polar curve `rho(phi)`.
#[derive(Clone, Debug, PartialEq)]
pub struct Star {
    rho: Periodic,
}

impl Star {
    pub(super) fn new(rho: Periodic) -> Self {
        Self { rho }
    }

    /// The point at the angle `phi`.
    pub fn at(&self, angle: f64) -> SlipSample {
        let (sine, cosine) = angle.sin_cos();
        let slip = Vector2::new(cosine, sine);
        SlipSample {
            angle,
            slip,
            traction: slip * self.rho.at(angle),
            deviation: 0.0,
        }
    }

    /// `Gamma(v)`: the least `varpi` whose slip surface holds `v = -tau`.
    pub fn gauge(&self, v: &Vector2<f64>) -> f64 {
        v.norm() / self.rho.at(self.angle(v))
    }

    /// The angle `phi` of `v = -tau`.
    pub fn angle(&self, v: &Vector2<f64>) -> f64 {
        v.y.atan2(v.x)
    }

    /// Largest traction; slip and traction do not deviate.
    pub fn extremes(&self) -> Extremes {
        let sizes = self.rho.points().map(|[_, rho]| rho);
        Extremes {
            traction: sizes.fold(0.0, f64::max),
            deviation: 0.0,
        }
    }

    /// The point where slip dissipates least: that of the least given coefficient.
    pub fn least_dissipation(&self) -> SlipSample {
        let least = self
            .rho
            .points()
            .fold([0.0, f64::INFINITY], |least, point| {
                if point[1] < least[1] { point } else { least }
            });
        self.at(least[0])
    }
}
