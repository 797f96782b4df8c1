//! Coefficient of friction, constant or decaying with the slip rate.
//!
//! ```text
//! mu(v) = mu_k + (mu_s - mu_k) exp(-v / v_d)
//! ```
//!
//! with the static value `mu_s`, the kinetic value `mu_k`, the slip rate
//! `v >= 0` and the decay rate `v_d` (length per time). Source: the exponential
//! model of Oden & Martins (1985), "Models and computational methods for dynamic
//! friction phenomena", Comput. Methods Appl. Mech. Engrg. 52, 527-634.

use num_dual::DualNum;
use serde::Serialize;

use super::error::{FrictionError, not_negative, positive};

/// Coefficient of friction `mu(v)`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Coefficient {
    at_rest: f64,
    decay: Option<Decay>,
}

/// How the coefficient falls from its static to its kinetic value.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
struct Decay {
    kinetic_over_static: f64,
    rate: f64,
}

impl Coefficient {
    /// The same coefficient at every slip rate.
    ///
    /// # Errors
    /// When `mu` is negative or not finite.
    pub fn constant(mu: f64) -> Result<Self, FrictionError> {
        Ok(Self {
            at_rest: not_negative("mu", mu)?,
            decay: None,
        })
    }

    /// Lets the coefficient decay to `kinetic_over_static` times its value at
    /// rest, with the slip rate `rate` as scale.
    ///
    /// # Errors
    /// When the ratio is negative or the rate is not positive.
    pub fn with_decay(self, kinetic_over_static: f64, rate: f64) -> Result<Self, FrictionError> {
        let decay = Decay {
            kinetic_over_static: not_negative("kinetic_over_static", kinetic_over_static)?,
            rate: positive("decay_rate", rate)?,
        };
        Ok(Self {
            at_rest: self.at_rest,
            decay: Some(decay),
        })
    }

    /// Value at rest, `mu_s`.
    pub fn at_rest(&self) -> f64 {
        self.at_rest
    }

    /// Whether it depends on the slip rate.
    pub fn decays(&self) -> bool {
        self.decay.is_some()
    }

    /// Kinetic over static value and decay rate, where it decays.
    pub fn decay(&self) -> Option<[f64; 2]> {
        self.decay
            .map(|decay| [decay.kinetic_over_static, decay.rate])
    }

    /// Value at the slip rate `v >= 0`.
    pub fn at_slip_rate<D: DualNum<Primitive = f64> + Copy>(&self, slip_rate: D) -> D {
        let mu_s = D::from(self.at_rest);
        match self.decay {
            None => mu_s,
            Some(Decay {
                kinetic_over_static,
                rate,
            }) => {
                let mu_k = mu_s * kinetic_over_static;
                mu_k + (mu_s - mu_k) * (-slip_rate / rate).exp()
            }
        }
    }
}
