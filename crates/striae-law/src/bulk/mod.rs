//! Bulk laws: stored energy, first Piola-Kirchhoff stress and its tangent as
//! functions of the deformation gradient.
//!
//! ```text
//! P = dW/dF,   A = dP/dF = d2W/dF dF
//! ```
//!
//! `W` is energy per reference volume, `P` force per reference area, `A` the
//! first elasticity tensor: a 9x9 matrix whose row and column `3 i + J` belong
//! to the component `F_iJ` (`i` current, `J` reference), symmetric because `W`
//! exists. Units are those of the moduli.
//!
//! A law is one file: parameters, formula, source, response. Laws of one's own implement
//! [`BulkLaw`] in any crate.

mod analysis;
mod battery;
mod hyperelastic;
mod invariants;
mod linear_elastic;
mod moduli;
mod neo_hookean;
mod ogden;
mod own;
#[cfg(test)]
mod tests;
mod volumetric;

pub use analysis::{Mode, TestState};
pub use battery::{Violation, battery};
pub use hyperelastic::{Hyperelastic, InadmissibleHyperelastic, Isochoric};
pub use moduli::{InadmissibleModuli, LameConstants};
pub use ogden::OgdenTerm;
pub use own::{BulkLaw, Own};
pub use volumetric::Volumetric;

use nalgebra::{Matrix3, SMatrix};

/// First elasticity tensor `dP/dF`; row and column `3 i + J` for `F_iJ`.
pub type Tangent = SMatrix<f64, 9, 9>;

/// A bulk material.
#[derive(Clone, Debug, PartialEq)]
pub enum Material {
    /// Compressible neo-Hookean solid.
    NeoHookean {
        /// First Lame constant.
        lambda: f64,
        /// Shear modulus `G`.
        shear: f64,
        /// Form of the volumetric energy.
        volumetric: Volumetric,
    },
    /// Linear elasticity of small strains.
    LinearElastic {
        /// First Lame constant.
        lambda: f64,
        /// Shear modulus `G`.
        shear: f64,
    },
    /// Rubber, with isochoric and volumetric energies apart.
    Hyperelastic(Hyperelastic),
    /// A law from outside the crate.
    Own(Own),
}

/// Answer of a material to a deformation gradient.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Response {
    /// Stored energy `W` per reference volume.
    pub energy: f64,
    /// First Piola-Kirchhoff stress `P`.
    pub first_piola: Matrix3<f64>,
    /// First elasticity tensor `A = dP/dF`.
    pub tangent: Tangent,
}

/// Why a material has no answer to a deformation gradient.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum ResponseError {
    /// The material is turned inside out.
    #[error("the deformation gradient has determinant {determinant:.6e}, it must be positive")]
    Inverted {
        /// Determinant `J` of the deformation gradient.
        determinant: f64,
    },
    /// The material is stretched beyond what its law allows.
    #[error("the invariant I1 - 3 is {strain:.6e}, the law ends at {limit:.6e}")]
    Overstretched {
        /// `I1 - 3` of the isochoric deformation.
        strain: f64,
        /// The limit of the law.
        limit: f64,
    },
}

impl Material {
    /// The neo-Hookean solid with the given Lame constants.
    pub fn neo_hookean(constants: LameConstants) -> Self {
        Self::neo_hookean_with(constants, Volumetric::Quadratic)
    }

    /// The neo-Hookean solid with the given Lame constants and volumetric energy.
    pub fn neo_hookean_with(constants: LameConstants, volumetric: Volumetric) -> Self {
        let LameConstants { lambda, shear } = constants;
        Self::NeoHookean {
            lambda,
            shear,
            volumetric,
        }
    }

    /// Linear elasticity with the given Lame constants.
    pub fn linear_elastic(constants: LameConstants) -> Self {
        let LameConstants { lambda, shear } = constants;
        Self::LinearElastic { lambda, shear }
    }

    /// A law from outside the crate.
    pub fn own(law: impl BulkLaw + 'static) -> Self {
        Self::Own(Own::new(law))
    }

    /// The name of the law.
    pub fn name(&self) -> &str {
        match self {
            Self::NeoHookean { .. } => "neo-Hookean",
            Self::LinearElastic { .. } => "linear elastic",
            Self::Hyperelastic(law) => law.isochoric().name(),
            Self::Own(own) => own.law().name(),
        }
    }

    /// Energy, stress and tangent at the deformation gradient `F`.
    ///
    /// # Errors
    ///
    /// [`ResponseError`] where the law needs `det F > 0` and does not get it, or ends
    /// at a smaller stretch.
    pub fn response(&self, deformation_gradient: &Matrix3<f64>) -> Result<Response, ResponseError> {
        let f = deformation_gradient;
        match self {
            Self::NeoHookean {
                lambda,
                shear,
                volumetric,
            } => neo_hookean::response(*lambda, *shear, *volumetric, f),
            Self::LinearElastic { lambda, shear } => {
                Ok(linear_elastic::response(*lambda, *shear, f))
            }
            Self::Hyperelastic(law) => law.response(f),
            Self::Own(own) => own.law().response(f),
        }
    }

    /// Cauchy stress at the deformation gradient `F`: `P F^T / J`, and `P`
    /// itself for the law of small strains, which does not tell the two apart.
    ///
    /// # Errors
    ///
    /// As [`Material::response`].
    pub fn cauchy_stress(
        &self,
        deformation_gradient: &Matrix3<f64>,
    ) -> Result<Matrix3<f64>, ResponseError> {
        let first_piola = self.response(deformation_gradient)?.first_piola;
        Ok(match self {
            Self::LinearElastic { .. } => first_piola,
            _ => {
                first_piola * deformation_gradient.transpose() / deformation_gradient.determinant()
            }
        })
    }

    /// The Lame constants of the small-strain limit.
    pub fn lame_constants(&self) -> LameConstants {
        match self {
            Self::NeoHookean { lambda, shear, .. } | Self::LinearElastic { lambda, shear } => {
                LameConstants {
                    lambda: *lambda,
                    shear: *shear,
                }
            }
            Self::Hyperelastic(law) => law.lame_constants(),
            Self::Own(own) => own.law().lame_constants(),
        }
    }
}
