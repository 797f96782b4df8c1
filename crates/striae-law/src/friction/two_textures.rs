//! Two textured surfaces, the law of Jones & Papadopoulos.
//!
//! With the textures `a_a` of the surface that carries the point and
//! `a_b' = -a_b` of the other one, both for the normal of the former,
//!
//! ```text
//! a_ba = a_a + a_b' ,   m = |a_ba| ,   I0 = a_a . a_b' ,   I1 = a_ba . d
//! A = 1 + c_mag I0 ,    B = c_ang (1 + I0)
//! tau = -varpi (A d + B (c_cen + I1) a_ba)                                  (36)
//! ```
//!
//! that is the kernel `L = A I + B a_ba a_ba^T`, `eta = B c_cen a_ba`, `K = I`.
//! `c_mag` scales friction with the angle between the textures, `c_ang` turns
//! it towards the common direction, `c_cen` moves the centre of the slip
//! surface: for `c_ang c_cen > 0` friction is larger where slip follows `a_ba`,
//! the way the free edges of scales point. All constants are without unit.
//!
//! Source: Jones & Papadopoulos (2006), "Simulating anisotropic frictional
//! response using smoothly interpolated traction fields", Comput. Methods Appl.
//! Mech. Engrg., equation (36), with the slip direction `d` of the surface that
//! carries the point relative to the other one; the opposite choice, as the
//! paper's (13)-(15) would have it, creates energy.
//!
//! # Admissible constants
//!
//! Slip dissipates `varpi D` per unit of slip,
//!
//! ```text
//! D(I0, I1) = 1 + c_mag I0 + c_ang (1 + I0)(c_cen + I1) I1 ,
//! -1 <= I0 <= 1 ,   I1^2 <= 2 + 2 I0 ,
//! ```
//!
//! which has to be positive for all textures and slip directions. The range the
//! paper prints, `|c_mag| < 1`, `|c_ang| c_cen^2 < 4`, does not ensure that. With
//! `m^2 = 2 + 2 I0`,
//!
//! ```text
//! D = 1 - c_mag + (m^2/2) q(I1) ,   q = c_mag + c_ang (c_cen + I1) I1 ,   |I1| <= m .
//! ```
//!
//! The least `q` falls as `m`, and with it the range of `I1`, grows. If it is negative for `m = 2`,
//! the least `D` is found there; if not, at `m = 0`. So only opposed and aligned textures have to
//! be checked, and the constants are admissible iff `c_mag < 1` and
//!
//! ```text
//! 1 + c_mag > c_ang c_cen^2 / 2            for c_ang >= 0, |c_cen| <= 4
//! 1 + c_mag > c_ang (4 |c_cen| - 8)        for c_ang >= 0, |c_cen| > 4
//! 1 + c_mag > |c_ang| (8 + 4 |c_cen|)      for c_ang < 0
//! ```
//!
//! # As a sum of parameters times vectors, for fits
//!
//! ```text
//! q = mu (1, c_mag, c_ang, c_ang c_cen) ,   m^2 = 2 + 2 I0
//! w = (q_0 + q_1 I0)(c, s) + (1 + I0) m (q_2 m c + q_3, 0)
//! ```

use std::f64::consts::PI;

use nalgebra::{Matrix3, Vector2, Vector3};
use num_dual::DualNum;
use serde::Serialize;

use super::basis::{Basis, Direction, Meaning, Sum};
use super::coefficient::Coefficient;
use super::ellipse::Ellipse;
use super::error::{FrictionError, finite};
use super::kernel::Kernel;
use super::slip_sample::SlipRule;
use super::{Friction, Law};
use striae_declared::{ANY, Declared, NO_UNIT, NOT_NEGATIVE, Parameter};

/// The law.
pub static TWO_TEXTURES: Declared<Friction> = Declared {
    name: "two-textures",
    summary: "Two textured surfaces.",
    parameters: &[
        Parameter::number("mu", NOT_NEGATIVE, NO_UNIT, "Coefficient of friction."),
        Parameter::number(
            "c_mag",
            ANY,
            NO_UNIT,
            "Dependence of the magnitude on the angle between the textures.",
        ),
        Parameter::number(
            "c_ang",
            ANY,
            NO_UNIT,
            "Dependence on the angle between slip and textures.",
        ),
        Parameter::number(
            "c_cen",
            ANY,
            NO_UNIT,
            "Difference between slip with and against the textures.",
        ),
    ],
    build: |values| {
        let [mu, mag, ang, cen] = ["mu", "c_mag", "c_ang", "c_cen"].map(|name| values.number(name));
        let law = TwoTextures::new(mag, ang, cen)?;
        Ok(Friction::new(
            Law::TwoTextures(law),
            Coefficient::constant(mu)?,
        ))
    },
    fit: Some(Basis::Sum(Sum {
        needed: "several directions of slip at two or more angles `theta` between the textures",
        constants: &[
            Meaning::Parameter(0),
            Meaning::Quotient(1, 0),
            Meaning::Quotient(2, 0),
            Meaning::Quotient(3, 2),
        ],
        vectors: |direction, _, _| {
            let (d, i0) = (direction.d(), direction.theta.cos());
            let m = (2.0 + 2.0 * i0).max(0.0).sqrt();
            let turned = Vector2::x() * ((1.0 + i0) * m);
            vec![d, d * i0, turned * (m * d.x), turned]
        },
        // Dissipation is least where textures are opposed or aligned.
        judged: || {
            Direction::around(0.0)
                .chain([Direction::new(PI, 0.0)])
                .collect()
        },
    })),
};

impl Friction {
    /// Two textured surfaces, the law of Jones & Papadopoulos; see [`TwoTextures`].
    ///
    /// # Errors
    /// When `mu` is negative, a constant is not finite, or friction would create
    /// energy for some pair of textures and some slip direction.
    pub fn two_textures(
        mu: f64,
        c_mag: f64,
        c_ang: f64,
        c_cen: f64,
    ) -> Result<Self, FrictionError> {
        let values = [
            ("mu", mu),
            ("c_mag", c_mag),
            ("c_ang", c_ang),
            ("c_cen", c_cen),
        ];
        TWO_TEXTURES.made(&values.into())
    }
}

/// Constants of the law.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct TwoTextures {
    c_mag: f64,
    c_ang: f64,
    c_cen: f64,
}

/// The least dissipation of slip between two textured surfaces.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LeastDissipation {
    /// Cosine of the angle between the textures, `a_a . a_b'`.
    pub i0: f64,
    /// Slip direction, `a_ba . d`.
    pub i1: f64,
    /// Dissipation over `varpi |du|`.
    pub value: f64,
}

impl TwoTextures {
    /// Constants `c_mag`, `c_ang` and `c_cen`.
    ///
    /// # Errors
    /// When a constant is not finite, or friction would create energy for some
    /// pair of textures and some slip direction.
    pub fn new(c_mag: f64, c_ang: f64, c_cen: f64) -> Result<Self, FrictionError> {
        let law = Self {
            c_mag: finite("c_mag", c_mag)?,
            c_ang: finite("c_ang", c_ang)?,
            c_cen: finite("c_cen", c_cen)?,
        };
        let LeastDissipation { i0, i1, value } = law.least_dissipation();
        if value > 0.0 {
            Ok(law)
        } else {
            Err(FrictionError::CreatesEnergy {
                i0,
                i1,
                dissipation: value,
            })
        }
    }

    /// `L`, `eta` and `K` for the unit textures `own = a_a` and `opposite = a_b'`.
    #[allow(non_snake_case)]
    pub fn kernel<D: DualNum<Primitive = f64> + Copy>(
        &self,
        own: &Vector3<D>,
        opposite: &Vector3<D>,
    ) -> Kernel<'static, D> {
        let a = own + opposite;
        let I0 = own.dot(opposite);
        let A = I0 * self.c_mag + 1.0;
        let B = (I0 + 1.0) * self.c_ang;
        let L = Matrix3::identity() * A + a * a.transpose() * B;
        Kernel::affine(L, a * (B * self.c_cen))
    }

    /// The slip surface for textures at the angle `theta` (radians), in the frame
    /// `e = a_ba/m` and across: `P = A + B m^2`, `A`, `h = B m c_cen`.
    #[allow(non_snake_case)]
    pub fn slip_surface(&self, theta: f64) -> Ellipse {
        let I0 = theta.cos();
        let m = (2.0 + 2.0 * I0).max(0.0).sqrt();
        let A = 1.0 + self.c_mag * I0;
        let B = self.c_ang * (1.0 + I0);
        Ellipse::new(A + B * m * m, A, B * m * self.c_cen, SlipRule::Opposing)
    }

    /// Dissipation over `varpi |du|` for textures `I0` and slip direction `I1`.
    pub fn dissipation(&self, i0: f64, i1: f64) -> f64 {
        1.0 + self.c_mag * i0 + self.c_ang * (1.0 + i0) * (self.c_cen + i1) * i1
    }

    /// The least dissipation over all textures and slip directions: that of
    /// opposed or of aligned textures.
    pub fn least_dissipation(&self) -> LeastDissipation {
        let opposed = self.least_over_slip(0.0);
        let aligned = self.least_over_slip(2.0);
        if aligned.value < opposed.value {
            aligned
        } else {
            opposed
        }
    }

    /// The least dissipation over the slip directions for textures with `|a_ba| = m`.
    fn least_over_slip(&self, m: f64) -> LeastDissipation {
        let i0 = 0.5 * m * m - 1.0;
        let i1 = if self.c_ang > 0.0 {
            (-0.5 * self.c_cen).clamp(-m, m)
        } else {
            m.copysign(self.c_cen)
        };
        LeastDissipation {
            i0,
            i1,
            value: self.dissipation(i0, i1),
        }
    }
}
