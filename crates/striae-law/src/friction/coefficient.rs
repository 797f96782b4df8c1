//! Coefficient of friction, constant or dependent on pressure, slip rate and accumulated slip.
//!
//! ```text
//! varpi = mu R(v) W(s) P(p)
//! ```
//!
//! with the stated coefficient `mu`, a function `R` of the slip rate, see
//! [`RateDependence`], a function `W` of the accumulated slip, see [`SlipDependence`], and a
//! function `P` of the pressure, see [`PressureDependence`].

use num_dual::DualNum;
use serde::Serialize;

use super::by_pressure::PressureDependence;
use super::by_rate::RateDependence;
use super::by_slip::SlipDependence;
use super::error::{FrictionError, not_negative};

/// Coefficient of friction `mu R(v) W(s) P(p)/p`.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Coefficient {
    at_rest: f64,
    by_pressure: PressureDependence,
    by_rate: RateDependence,
    by_slip: SlipDependence,
}

impl Coefficient {
    /// A coefficient that is equal at every pressure and slip rate.
    ///
    /// # Errors
    /// When `mu` is negative or not finite.
    pub fn constant(mu: f64) -> Result<Self, FrictionError> {
        Ok(Self {
            at_rest: not_negative("mu", mu)?,
            by_pressure: PressureDependence::default(),
            by_rate: RateDependence::default(),
            by_slip: SlipDependence::default(),
        })
    }

    /// The coefficient with a dependence on the pressure, in place of one it had.
    pub fn with_pressure(self, by_pressure: PressureDependence) -> Self {
        Self {
            by_pressure,
            ..self
        }
    }

    /// The coefficient with a dependence on the slip rate, in place of one it had.
    pub fn with_rate(self, by_rate: RateDependence) -> Self {
        Self { by_rate, ..self }
    }

    /// The coefficient with a dependence on the accumulated slip, in place of one it had.
    pub fn with_slip(self, by_slip: SlipDependence) -> Self {
        Self { by_slip, ..self }
    }

    /// The stated value `mu`: at rest, without accumulated slip, and where
    /// `P(p) = p`.
    pub fn at_rest(&self) -> f64 {
        self.at_rest
    }

    /// Dependence on the pressure.
    pub fn by_pressure(&self) -> &PressureDependence {
        &self.by_pressure
    }

    /// Dependence on the slip rate.
    pub fn by_rate(&self) -> &RateDependence {
        &self.by_rate
    }

    /// Dependence on the accumulated slip.
    pub fn by_slip(&self) -> &SlipDependence {
        &self.by_slip
    }

    /// `mu R(v)` at the slip rate `v >= 0`.
    pub fn at_slip_rate<D: DualNum<Primitive = f64> + Copy>(&self, slip_rate: D) -> D {
        self.by_rate.of(self.at_rest, slip_rate)
    }

    /// `mu R(v) W(s) P(p)` at a pressure `p > 0`.
    pub(super) fn bound<D: DualNum<Primitive = f64> + Copy>(
        &self,
        pressure: D,
        slip_rate: D,
        slip: f64,
    ) -> D {
        let bound = self.at_slip_rate(slip_rate) * self.by_pressure.at(self.at_rest, pressure);
        bound * self.by_slip.at(slip)
    }
}
