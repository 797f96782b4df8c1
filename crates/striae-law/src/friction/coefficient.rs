//! Coefficient of friction, constant or dependent on pressure, slip rate, accumulated slip and
//! state.
//!
//! ```text
//! varpi = mu R(v) W(s) P(p) ,   or   mu(v, theta) W(s) P(p) ,   or   mu R(v) W(s) P(p) F
//! ```
//!
//! with the stated coefficient `mu`, a function `R` of the slip rate, see
//! [`RateDependence`], a function `W` of the accumulated slip, see [`SlipDependence`], and a
//! function `P` of the pressure, see [`PressureDependence`]. A coefficient that depends on slip
//! rate and state, see [`StateDependence`], takes the place of `mu R(v)`. The factor `F` is that of
//! healing, or one of one's own, see [`FactorLaw`](super::FactorLaw).

use num_dual::DualNum;
use serde::Serialize;

use super::by_pressure::PressureDependence;
use super::by_rate::RateDependence;
use super::by_slip::SlipDependence;
use super::by_state::StateDependence;
use super::error::{FrictionError, not_negative};
use super::factor::{Course, FactorBatch, OwnFactor};

/// Coefficient of friction `mu R(v) W(s) P(p)/p`.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Coefficient {
    at_rest: f64,
    by_pressure: PressureDependence,
    by_rate: RateDependence,
    by_slip: SlipDependence,
    by_state: StateDependence,
    #[serde(skip_serializing_if = "Option::is_none")]
    own: Option<OwnFactor>,
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
            by_state: StateDependence::default(),
            own: None,
        })
    }

    /// The coefficient with a dependence on the pressure, in place of one it had.
    pub fn with_pressure(self, by_pressure: PressureDependence) -> Self {
        Self {
            by_pressure,
            ..self
        }
    }

    /// The coefficient with a dependence on the slip rate, in place of one it had and of one on
    /// slip rate and state.
    pub fn with_rate(self, by_rate: RateDependence) -> Self {
        Self {
            by_rate,
            by_state: StateDependence::default(),
            ..self
        }
    }

    /// The coefficient with a dependence on the accumulated slip, in place of one it had.
    pub fn with_slip(self, by_slip: SlipDependence) -> Self {
        Self { by_slip, ..self }
    }

    /// The coefficient with a dependence on slip rate and state, in place of one it had, of one
    /// on the slip rate alone, and of a factor of one's own.
    pub fn with_state(self, by_state: StateDependence) -> Self {
        Self {
            by_state,
            by_rate: RateDependence::default(),
            own: None,
            ..self
        }
    }

    /// The coefficient with a factor of one's own, in place of one it had and of a dependence on
    /// slip rate and state.
    pub fn with_factor(self, factor: OwnFactor) -> Self {
        Self {
            own: Some(factor),
            by_state: StateDependence::default(),
            ..self
        }
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

    /// Dependence on slip rate and state.
    pub fn by_state(&self) -> &StateDependence {
        &self.by_state
    }

    /// Factor of one's own.
    pub fn own(&self) -> Option<&OwnFactor> {
        self.own.as_ref()
    }

    /// Factor by healing or of one's own.
    pub fn factor(&self) -> Option<&dyn FactorBatch> {
        match self.by_state.of_healing() {
            Some(law) => Some(law),
            None => self.own.as_ref().map(OwnFactor::law),
        }
    }

    /// Course of the factor with the slip rate, if there is one.
    pub(super) fn course(&self) -> Option<Course> {
        match self.by_state.of_healing() {
            Some(law) => Some(law.by_rate()),
            None => self.own.as_ref().map(OwnFactor::course),
        }
    }

    /// `mu R(v)` at the slip rate `v >= 0`, without a factor of one's own; of a coefficient that depends on the state, the one of
    /// steady slip.
    pub fn at_slip_rate<D: DualNum<Primitive = f64> + Copy>(&self, slip_rate: D) -> D {
        match self.by_state.constants() {
            Some(law) => law.steady(self.at_rest, slip_rate),
            None => match self.by_state.of_healing() {
                Some(law) => law.factor(law.steady_state(slip_rate)) * self.at_rest,
                None => self.by_rate.of(self.at_rest, slip_rate),
            },
        }
    }

    /// `mu R(v) W(s) P(p) F` at a pressure `p > 0`.
    pub(super) fn bound_with<D: DualNum<Primitive = f64> + Copy>(
        &self,
        pressure: D,
        slip_rate: D,
        slip: f64,
        factor: D,
    ) -> D {
        let bound = self.by_rate.of(self.at_rest, slip_rate) * factor;
        bound * self.by_pressure.at(self.at_rest, pressure) * self.by_slip.at(slip)
    }

    /// `W(s) P(p)` at a pressure `p > 0`.
    pub(super) fn scaled<D: DualNum<Primitive = f64> + Copy>(&self, pressure: D, slip: f64) -> D {
        self.by_pressure.at(self.at_rest, pressure) * self.by_slip.at(slip)
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
