//! Friction with, against and across the nap, from three measured coefficients.
//!
//! Exactly one of the two surfaces carries the texture: scales, hair or pile with
//! `a` from root to free edge. Let `e` be that texture as seen from the surface
//! that carries the point (`a_a` or `a_b'`). The textured surface slides against the
//! nap, its free edges ahead, when slip follows `+e`; so with the largest of the
//! three coefficients, `mu`, as scale (`varpi = mu p`),
//!
//! ```text
//! L   = (mu_t I + ((mu_b + mu_f)/2 - mu_t) e e^T) / mu
//! eta = (mu_b - mu_f)/(2 mu) e ,   K = I
//! d = -e:  -tau = mu_f p d    with the nap  (forward)
//! d = +e:  -tau = mu_b p d    against it    (backward)
//! d _|_ e: -tau = mu_t p d + (mu_b - mu_f)/2 p e    across it  (lateral)
//! ```
//!
//! Source: the slip rule of [`TwoTextures`](super::TwoTextures) with its constants
//! fitted to the three coefficients. Forward, backward and lateral are the usual
//! terms for snake scales, Hu, Nirody, Scott & Shelley (2009), "The mechanics of
//! slithering locomotion", PNAS 106, 10081-10085, doi:10.1073/pnas.0812533106.
//!
//! Admissible iff slip dissipates in all directions, see [`Ellipse::least_dissipation`]: with `P =
//! (mu_b + mu_f)/2`, `h = (mu_b - mu_f)/2` and `P > mu_t`, `|h| < 2 (P - mu_t)` this requires
//! `mu_t > h^2/(4 (P - mu_t))`.
//!
//! As a sum of parameters times vectors, for fits:
//! `w = (mu_f (c - 1)/2 + mu_b (c + 1)/2, mu_t s)`.

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
use striae_declared::{Declared, NO_UNIT, POSITIVE, Parameter};

/// The law.
pub static NAP: Declared<Friction> = Declared {
    name: "nap",
    summary: "One textured surface with different friction with, against and across its nap.",
    parameters: &[
        Parameter::number(
            "mu_forward",
            POSITIVE,
            NO_UNIT,
            "Coefficient of friction of slip with the nap.",
        ),
        Parameter::number(
            "mu_backward",
            POSITIVE,
            NO_UNIT,
            "Coefficient of friction of slip against the nap.",
        ),
        Parameter::number(
            "mu_lateral",
            POSITIVE,
            NO_UNIT,
            "Coefficient of friction of slip across the nap.",
        ),
    ],
    build: |values| {
        let [forward, backward, lateral] =
            ["mu_forward", "mu_backward", "mu_lateral"].map(|name| values.number(name));
        let law = Nap::new(forward, backward, lateral)?;
        let coefficient = Coefficient::constant(forward.max(backward).max(lateral))?;
        Ok(Friction::new(Law::Nap(law), coefficient))
    },
    fit: Some(Basis::Sum(Sum {
        needed: "slip in three directions, such as with, against and across the nap",
        constants: &[
            Meaning::Parameter(0),
            Meaning::Parameter(1),
            Meaning::Parameter(2),
        ],
        vectors: |direction, _, _| {
            let (d, e) = (direction.d(), Vector2::x());
            vec![
                e * (0.5 * (d.x - 1.0)),
                e * (0.5 * (d.x + 1.0)),
                Vector2::new(0.0, d.y),
            ]
        },
        judged: || Direction::around(0.0).collect(),
    })),
};

impl Friction {
    /// One textured surface with different friction with, against and across its
    /// nap; see [`Nap`]. The coefficient of the result is the largest one.
    ///
    /// # Errors
    /// When a coefficient is not positive, or friction would create energy for some
    /// slip direction.
    pub fn nap(mu_forward: f64, mu_backward: f64, mu_lateral: f64) -> Result<Self, FrictionError> {
        let values = [
            ("mu_forward", mu_forward),
            ("mu_backward", mu_backward),
            ("mu_lateral", mu_lateral),
        ];
        NAP.made(&values.into())
    }
}

/// Coefficients of the law over the largest one.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Nap {
    forward: f64,
    backward: f64,
    lateral: f64,
}

impl Nap {
    /// Coefficients with the nap, against it and across it.
    ///
    /// # Errors
    /// When a coefficient is not positive, or friction would create energy for some
    /// slip direction.
    pub fn new(mu_forward: f64, mu_backward: f64, mu_lateral: f64) -> Result<Self, FrictionError> {
        let mu = positive("mu_forward", mu_forward)?
            .max(positive("mu_backward", mu_backward)?)
            .max(positive("mu_lateral", mu_lateral)?);
        let law = Self {
            forward: mu_forward / mu,
            backward: mu_backward / mu,
            lateral: mu_lateral / mu,
        };
        let least = law.slip_surface().least_dissipation();
        if least.dissipation() > 0.0 {
            Ok(law)
        } else {
            Err(FrictionError::CreatesEnergyAlong {
                degrees: least.angle.to_degrees(),
                dissipation: least.dissipation() * mu,
            })
        }
    }

    /// `L`, `eta` and `K` for the unit texture `e` of the textured surface.
    #[allow(non_snake_case)]
    pub fn kernel<D: DualNum<Primitive = f64> + Copy>(&self, e: &Vector3<D>) -> Kernel<'static, D> {
        let A = D::from(self.lateral);
        let P = D::from(self.mean());
        let L = Matrix3::identity() * A + e * e.transpose() * (P - A);
        Kernel::affine(L, e * D::from(self.offset()))
    }

    /// The slip surface in the frame `e` (against the nap) and across it.
    pub fn slip_surface(&self) -> Ellipse {
        Ellipse::new(self.mean(), self.lateral, self.offset(), SlipRule::Opposing)
    }

    fn mean(&self) -> f64 {
        0.5 * (self.backward + self.forward)
    }

    fn offset(&self) -> f64 {
        0.5 * (self.backward - self.forward)
    }
}
