//! Friction laws on the common kernel `-tau = L z + varpi eta`, `|z| <= varpi`.
//!
//! A [`Friction`] joins a [`Law`] (the shape of the slip surface and the slip
//! rule), a [`Coefficient`] and, if wanted, a cap on the shear stress. It gives
//! the solver two functions: the radius [`Friction::cap`] of the disc of `z`
//! and the [`Kernel`] that turns `z` into a traction. Both are generic over
//! dual numbers, so their derivatives are exact.
//!
//! Conventions: `p >= 0` is compressive; slip is the motion of the surface that
//! carries the point relative to the other one; the traction acts on the
//! surface that carries the point.

mod coefficient;
mod error;
mod kernel;

pub use coefficient::Coefficient;
pub use error::FrictionError;
pub use kernel::{Kernel, Textures};

use error::positive;
use nalgebra::Vector3;
use num_dual::DualNum;

/// Friction between two surfaces.
#[derive(Clone, Debug, PartialEq)]
pub struct Friction {
    law: Law,
    coefficient: Coefficient,
    shear_cap: Option<f64>,
}

/// Shape of the slip surface, and slip rule.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Law {
    /// No friction.
    Frictionless,
    /// Isotropic Coulomb friction.
    Coulomb,
}

/// Which of the two surfaces must carry a texture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RequiredTextures {
    /// Textures are not looked at.
    Any,
    /// Exactly one of the two surfaces.
    One,
    /// Both surfaces.
    Both,
}

impl Friction {
    /// No friction.
    pub fn frictionless() -> Self {
        let coefficient = Coefficient::constant(0.0).expect("zero is a coefficient of friction");
        Self::new(Law::Frictionless, coefficient)
    }

    /// Isotropic Coulomb friction.
    ///
    /// # Errors
    /// When `mu` is negative or not finite.
    pub fn coulomb(mu: f64) -> Result<Self, FrictionError> {
        Ok(Self::new(Law::Coulomb, Coefficient::constant(mu)?))
    }

    /// Lets all coefficients decay with the slip rate, from the stated values
    /// at rest to `kinetic_over_static` times them; see [`Coefficient`].
    ///
    /// # Errors
    /// When the ratio is negative or the rate is not positive.
    pub fn with_decay(self, kinetic_over_static: f64, rate: f64) -> Result<Self, FrictionError> {
        let coefficient = self.coefficient.with_decay(kinetic_over_static, rate)?;
        Ok(Self {
            coefficient,
            ..self
        })
    }

    /// Bounds the radius of the slip surface: `varpi = min(mu p, tau_max)`.
    ///
    /// # Errors
    /// When the bound is not positive.
    pub fn with_shear_cap(self, tau_max: f64) -> Result<Self, FrictionError> {
        let shear_cap = Some(positive("shear_cap", tau_max)?);
        Ok(Self { shear_cap, ..self })
    }

    /// The law.
    pub fn law(&self) -> &Law {
        &self.law
    }

    /// The coefficient of friction the law is scaled with.
    pub fn coefficient(&self) -> &Coefficient {
        &self.coefficient
    }

    /// The bound on `varpi`, if any.
    pub fn shear_cap(&self) -> Option<f64> {
        self.shear_cap
    }

    /// Which surfaces must carry a texture for [`Friction::kernel`] to exist.
    pub fn required_textures(&self) -> RequiredTextures {
        match self.law {
            Law::Frictionless | Law::Coulomb => RequiredTextures::Any,
        }
    }

    /// Radius of the disc of `z`: `varpi = mu(v) p`, at most the shear cap, and
    /// zero where the pressure is not compressive.
    ///
    /// Kinks, with one-sided derivatives taken on the side the value lies on: at
    /// `p = 0` and where `mu p` meets the cap.
    pub fn cap<D: DualNum<Primitive = f64> + Copy>(&self, pressure: D, slip_rate: D) -> D {
        if pressure.re() <= 0.0 {
            return D::zero();
        }
        let varpi = self.coefficient.at_slip_rate(slip_rate) * pressure;
        match self.shear_cap {
            Some(tau_max) if varpi.re() > tau_max => D::from(tau_max),
            _ => varpi,
        }
    }

    /// `L`, `eta` and `K` at a point with the unit normal `n` of the surface
    /// that carries it.
    ///
    /// # Panics
    /// When a texture the law requires is missing; see
    /// [`Friction::required_textures`].
    pub fn kernel<D: DualNum<Primitive = f64> + Copy>(
        &self,
        _normal: &Vector3<D>,
        _textures: &Textures<D>,
    ) -> Kernel<D> {
        match &self.law {
            Law::Frictionless | Law::Coulomb => Kernel::identity(),
        }
    }

    fn new(law: Law, coefficient: Coefficient) -> Self {
        Self {
            law,
            coefficient,
            shear_cap: None,
        }
    }
}
