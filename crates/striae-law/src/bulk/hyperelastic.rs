//! Rubber: an isochoric energy of the shape and a volumetric one.
//!
//! With `I1`, `I2` of the isochoric part `J^-1/3 F` of the deformation gradient,
//!
//! ```text
//! W = W_iso(I1, I2) + U(J)
//! ```
//!
//! with an [isochoric energy](super::Isochoric), in principal stretches for
//! [Ogden's law](super::OgdenTerm). The bulk modulus `K` is that of the volumetric part.
//!
//! Source: the isochoric split of Flory, Trans. Faraday Soc. 57 (1961) 829-838,
//! doi:10.1039/TF9615700829.

use super::invariants::{self, Invariant};
use super::isochoric::ogden;
use super::rubber::BULK_MODULUS;
use super::volumetric::VOLUMETRIC;
use super::{
    InadmissibleHyperelastic, Isochoric, LameConstants, Law, Material, Response, ResponseError,
    Volumetric,
};
use nalgebra::Matrix3;
use num_dual::DualNum;
use serde::Serialize;
use striae_declared::Statement;

impl Material {
    /// Rubber that does not relax.
    pub fn hyperelastic(law: Hyperelastic) -> Self {
        let statement = law.statement();
        Self::new(Law::Hyperelastic(law), statement)
    }
}

/// A nearly incompressible elastic solid.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Hyperelastic {
    isochoric: Isochoric,
    bulk: f64,
    volumetric: Volumetric,
}

impl Hyperelastic {
    /// The law with an isochoric part and the volumetric energy of a bulk modulus.
    ///
    /// # Errors
    ///
    /// When a constant is not finite, or the solid would not be stable at rest.
    pub fn new(
        isochoric: Isochoric,
        bulk: f64,
        volumetric: Volumetric,
    ) -> Result<Self, InadmissibleHyperelastic> {
        isochoric.check()?;
        let shear = isochoric.shear();
        if shear.is_nan() || shear <= 0.0 {
            return Err(InadmissibleHyperelastic::Shear(shear));
        }
        if !(bulk > 0.0 && bulk.is_finite()) {
            let ratio = (3.0 * bulk - 2.0 * shear) / (6.0 * bulk + 2.0 * shear);
            return Err(InadmissibleHyperelastic::Bulk { bulk, shear, ratio });
        }
        Ok(Self {
            isochoric,
            bulk,
            volumetric,
        })
    }

    /// The law whose bulk modulus follows from Poisson's ratio at rest.
    ///
    /// # Errors
    ///
    /// As [`Hyperelastic::new`].
    pub fn with_poissons_ratio(
        isochoric: Isochoric,
        ratio: f64,
        volumetric: Volumetric,
    ) -> Result<Self, InadmissibleHyperelastic> {
        isochoric.check()?;
        let shear = isochoric.shear();
        let bulk = 2.0 * shear * (1.0 + ratio) / (3.0 * (1.0 - 2.0 * ratio));
        if !(ratio > -1.0 && ratio < 0.5) {
            return Err(InadmissibleHyperelastic::Bulk { bulk, shear, ratio });
        }
        Self::new(isochoric, bulk, volumetric)
    }

    /// The isochoric part.
    pub fn isochoric(&self) -> &Isochoric {
        &self.isochoric
    }

    /// The bulk modulus `K` at rest.
    pub fn bulk(&self) -> f64 {
        self.bulk
    }

    /// The form of the volumetric energy.
    pub fn volumetric(&self) -> Volumetric {
        self.volumetric
    }

    /// Law and values that state it, for energies of this crate.
    pub(super) fn statement(&self) -> Option<Statement> {
        let (law, values) = self.isochoric.stated()?;
        let values = values.with(BULK_MODULUS, self.bulk);
        let values = values.with(VOLUMETRIC.name, self.volumetric.name());
        Some(Statement { law, values })
    }

    /// The Lame constants of the small-strain limit.
    pub fn lame_constants(&self) -> LameConstants {
        let shear = self.isochoric.shear();
        LameConstants {
            lambda: self.bulk - 2.0 / 3.0 * shear,
            shear,
        }
    }

    pub(super) fn response(&self, f: &Matrix3<f64>) -> Result<Response, ResponseError> {
        if let Isochoric::Ogden(terms) = &self.isochoric {
            return ogden::response(terms, self.volumetric, self.bulk, f);
        }
        self.isochoric.within_limit(f)?;
        invariants::response(f, |i1, i2, j| self.energy(i1, i2, j))
    }

    /// `W` of the invariants of `F` itself.
    fn energy(&self, i1: Invariant, i2: Invariant, j: Invariant) -> Invariant {
        let scale = j.powf(-2.0 / 3.0);
        let isochoric = self.isochoric.energy(i1 * scale, i2 * scale * scale);
        isochoric + self.volumetric.energy(self.bulk, j)
    }
}
