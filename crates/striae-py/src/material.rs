//! Bulk materials.

use pyo3::prelude::*;
use striae::law::bulk;

use crate::fault::refused;

/// A bulk material.
#[pyclass(frozen, module = "striae._striae")]
pub struct Material(pub bulk::Material);

#[pymethods]
impl Material {
    #[staticmethod]
    fn neo_hookean(youngs_modulus: f64, poissons_ratio: f64) -> PyResult<Self> {
        let constants = engineering("NeoHookean", youngs_modulus, poissons_ratio)?;
        Ok(Self(bulk::Material::neo_hookean(constants)))
    }

    #[staticmethod]
    fn linear_elastic(youngs_modulus: f64, poissons_ratio: f64) -> PyResult<Self> {
        let constants = engineering("LinearElastic", youngs_modulus, poissons_ratio)?;
        Ok(Self(bulk::Material::linear_elastic(constants)))
    }

    /// Energy per reference volume, first Piola-Kirchhoff stress by rows.
    fn response(&self, deformation_gradient: [[f64; 3]; 3]) -> PyResult<(f64, [[f64; 3]; 3])> {
        let gradient = nalgebra::Matrix3::from(deformation_gradient).transpose();
        let response = self.0.response(&gradient);
        let response = response.map_err(|error| refused("deformation_gradient", error))?;
        Ok((response.energy, response.first_piola.transpose().into()))
    }
}

fn engineering(law: &str, youngs_modulus: f64, ratio: f64) -> PyResult<bulk::LameConstants> {
    bulk::LameConstants::from_youngs_modulus(youngs_modulus, ratio)
        .map_err(|error| refused(law, error))
}
