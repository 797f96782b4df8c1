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
//! A law is one file: parameters, formula, source, response.

mod linear_elastic;
mod moduli;
mod neo_hookean;
#[cfg(test)]
mod tests;

pub use moduli::{InadmissibleModuli, LameConstants};

use nalgebra::{Matrix3, SMatrix};

/// First elasticity tensor `dP/dF`; row and column `3 i + J` for `F_iJ`.
pub type Tangent = SMatrix<f64, 9, 9>;

/// A bulk material.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Material {
    /// Compressible neo-Hookean solid.
    NeoHookean {
        /// First Lame constant.
        lambda: f64,
        /// Shear modulus `G`.
        shear: f64,
    },
    /// Linear elasticity of small strains.
    LinearElastic {
        /// First Lame constant.
        lambda: f64,
        /// Shear modulus `G`.
        shear: f64,
    },
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

/// A deformation gradient that turns the material inside out.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("the deformation gradient has determinant {determinant:.6e}, it must be positive")]
pub struct Inverted {
    /// Determinant `J` of the deformation gradient.
    pub determinant: f64,
}

impl Material {
    /// The neo-Hookean solid with the given Lame constants.
    pub fn neo_hookean(constants: LameConstants) -> Self {
        let LameConstants { lambda, shear } = constants;
        Self::NeoHookean { lambda, shear }
    }

    /// Linear elasticity with the given Lame constants.
    pub fn linear_elastic(constants: LameConstants) -> Self {
        let LameConstants { lambda, shear } = constants;
        Self::LinearElastic { lambda, shear }
    }

    /// Energy, stress and tangent at the deformation gradient `F`.
    ///
    /// # Errors
    ///
    /// [`Inverted`] where the law needs `det F > 0` and does not get it.
    pub fn response(&self, deformation_gradient: &Matrix3<f64>) -> Result<Response, Inverted> {
        match *self {
            Self::NeoHookean { lambda, shear } => {
                neo_hookean::response(lambda, shear, deformation_gradient)
            }
            Self::LinearElastic { lambda, shear } => Ok(linear_elastic::response(
                lambda,
                shear,
                deformation_gradient,
            )),
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
    ) -> Result<Matrix3<f64>, Inverted> {
        let first_piola = self.response(deformation_gradient)?.first_piola;
        Ok(match self {
            Self::NeoHookean { .. } => {
                first_piola * deformation_gradient.transpose() / deformation_gradient.determinant()
            }
            Self::LinearElastic { .. } => first_piola,
        })
    }

    /// The Lame constants of the small-strain limit.
    pub fn lame_constants(&self) -> LameConstants {
        match *self {
            Self::NeoHookean { lambda, shear } | Self::LinearElastic { lambda, shear } => {
                LameConstants { lambda, shear }
            }
        }
    }
}
