//! Orthotropic friction: `mu_1` along the grooves `s`, `mu_2` across them.
//!
//! One of the two surfaces carries the texture `a = n x s`. With the larger of the
//! two coefficients, `mu`, as scale (`varpi = mu p`),
//!
//! ```text
//! L = (mu_1 I + (mu_2 - mu_1) a a^T) / mu ,   eta = 0
//! K = I       slip rule `Opposing`:    -tau_s = mu_1 p d_s ,  -tau_a = mu_2 p d_a
//! K = L^-1    slip rule `Associated`:  slip normal to the slip surface
//! ```
//!
//! Both have the ellipse `(tau_s/mu_1)^2 + (tau_a/mu_2)^2 <= p^2` as slip surface.
//! The law is even in `a`, so it is the same seen from either side.
//!
//! Source: Michalowski & Mroz (1978), "Associated and non-associated sliding
//! rules in contact friction problems", Arch. Mech. 30, 259-276; the associated
//! rule is the one of the anisotropic friction of common finite-element programs.
//!
//! Admissible: `mu_1 > 0` and `mu_2 > 0`. Slip by the opposing rule dissipates
//! `mu_1 d_s^2 + mu_2 d_a^2`, by the associated one `|z|^2/varpi`, times a positive
//! factor.

use nalgebra::{Matrix3, Vector3};
use num_dual::DualNum;
use serde::Serialize;

use super::ellipse::Ellipse;
use super::error::{FrictionError, positive};
use super::kernel::Kernel;
use super::slip_sample::SlipRule;

/// Coefficients of the law over the larger one, and slip rule.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Orthotropic {
    along: f64,
    across: f64,
    rule: SlipRule,
}

impl Orthotropic {
    /// Coefficients along the grooves, `mu_1`, and across them, `mu_2`.
    ///
    /// # Errors
    /// When a coefficient is not positive.
    pub fn new(mu_along: f64, mu_across: f64, rule: SlipRule) -> Result<Self, FrictionError> {
        let mu = positive("mu_along", mu_along)?.max(positive("mu_across", mu_across)?);
        Ok(Self {
            along: mu_along / mu,
            across: mu_across / mu,
            rule,
        })
    }

    /// Coefficients along the grooves and across them over the larger one.
    pub fn shares(&self) -> [f64; 2] {
        [self.along, self.across]
    }

    /// The slip rule.
    pub fn rule(&self) -> SlipRule {
        self.rule
    }

    /// `L`, `eta` and `K` for the unit texture `a` of either surface.
    #[allow(non_snake_case)]
    pub fn kernel<D: DualNum<Primitive = f64> + Copy>(&self, a: &Vector3<D>) -> Kernel<'static, D> {
        let aa = a * a.transpose();
        let diagonal = |along: f64, across: f64| {
            Matrix3::identity() * D::from(along) + aa * D::from(across - along)
        };
        let L = diagonal(self.along, self.across);
        match self.rule {
            SlipRule::Opposing => Kernel::affine(L, Vector3::zeros()),
            SlipRule::Associated => {
                let k = diagonal(1.0 / self.along, 1.0 / self.across);
                Kernel::affine(L, Vector3::zeros()).with_slip_map(k, L)
            }
        }
    }

    /// The slip surface in the frame `a` (across the grooves) and along them.
    pub fn slip_surface(&self) -> Ellipse {
        Ellipse::new(self.across, self.along, 0.0, self.rule)
    }
}
