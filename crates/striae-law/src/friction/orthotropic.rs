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
//!
//! As a sum of parameters times vectors, for fits:
//!
//! ```text
//! q = (mu_1, mu_2)   w = (mu_2 c, mu_1 s)                                               opposing
//!                    w = (mu_2^2 c, mu_1^2 s)/g ,  g^2 = mu_2^2 c^2 + mu_1^2 s^2        associated
//! ```
//!
//! The associated `w` is of degree one, `w = sum q_k dw/dq_k`.

use std::f64::consts::FRAC_PI_2;

use nalgebra::{Matrix3, Vector2, Vector3};
use num_dual::DualNum;
use serde::Serialize;

use super::basis::{Basis, Direction, Meaning, Sum};
use super::coefficient::Coefficient;
use super::ellipse::Ellipse;
use super::error::{FrictionError, positive};
use super::kernel::Kernel;
use super::slip_sample::SlipRule;
use super::{Friction, Law};
use striae_declared::{Declared, NO_UNIT, POSITIVE, Parameter, Values};

/// The law.
pub static ORTHOTROPIC: Declared<Friction> = Declared {
    name: "orthotropic",
    summary: "One textured surface with different friction along and across its texture.",
    parameters: &[
        Parameter::number(
            "mu_along",
            POSITIVE,
            NO_UNIT,
            "Coefficient of friction along the texture.",
        ),
        Parameter::number(
            "mu_across",
            POSITIVE,
            NO_UNIT,
            "Coefficient of friction across the texture.",
        ),
        Parameter::word(
            "slip_rule",
            &[
                (
                    "opposing",
                    "Each component of friction opposes that component of slip.",
                ),
                ("associated", "Slip is normal to the slip surface."),
            ],
            "Direction of slip.",
        ),
    ],
    build: |values| {
        let [along, across] = ["mu_along", "mu_across"].map(|name| values.number(name));
        let law = Orthotropic::new(along, across, SlipRule::named(values.word("slip_rule")))?;
        let coefficient = Coefficient::constant(along.max(across))?;
        Ok(Friction::new(Law::Orthotropic(law), coefficient))
    },
    fit: Some(Basis::Sum(Sum {
        needed: "slip in two directions, such as along and across the grooves",
        constants: &[Meaning::Parameter(0), Meaning::Parameter(1)],
        vectors: |direction, q, words| {
            let d = direction.d();
            match SlipRule::named(words.word("slip_rule")) {
                SlipRule::Opposing => vec![Vector2::new(0.0, d.y), Vector2::new(d.x, 0.0)],
                SlipRule::Associated => associated(q[0], q[1], d),
            }
        },
        judged: || {
            [0.0, FRAC_PI_2]
                .map(|slip| Direction::new(0.0, slip))
                .to_vec()
        },
    })),
};

impl Friction {
    /// One textured surface with different friction along and across its grooves;
    /// see [`Orthotropic`]. The coefficient of the result is the larger one.
    ///
    /// # Errors
    /// When a coefficient is not positive.
    pub fn orthotropic(
        mu_along: f64,
        mu_across: f64,
        rule: SlipRule,
    ) -> Result<Self, FrictionError> {
        let values = [("mu_along", mu_along), ("mu_across", mu_across)].into();
        ORTHOTROPIC.made(&Values::with(values, "slip_rule", rule.name()))
    }
}

/// Derivatives of the associated law by its constants along and across the grooves.
fn associated(along: f64, across: f64, d: Vector2<f64>) -> Vec<Vector2<f64>> {
    let g = (across * d.x).hypot(along * d.y);
    let w = Vector2::new(across * across * d.x, along * along * d.y) / g;
    let by_along = Vector2::new(0.0, 2.0 * along * d.y) / g - w * (along * d.y * d.y / (g * g));
    let by_across = Vector2::new(2.0 * across * d.x, 0.0) / g - w * (across * d.x * d.x / (g * g));
    vec![by_along, by_across]
}

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
