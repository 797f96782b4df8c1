//! Bulk materials.

use pyo3::prelude::*;
use striae::law::bulk;

use crate::{
    declared::{self, Given},
    fault::refused,
    raised::Raised,
    texture::Texture,
};

/// A bulk material.
#[pyclass(frozen, module = "striae._striae")]
pub struct Material(
    /// The material.
    pub bulk::Material,
    /// Exception raised by a function that states its law.
    pub Option<Raised>,
);

#[pymethods]
impl Material {
    /// A declared law of values by their names; `class` is what faults call it.
    #[staticmethod]
    fn declared(class: &str, law: &str, values: Vec<(String, Given)>) -> PyResult<Self> {
        let made = declared::made(bulk::LAWS, law, class, &values)?;
        Ok(Self(made, None))
    }

    /// A solid with families of fibres: `k1`, `k2` and dispersion of exponential ones or the
    /// modulus of linear ones, and their direction.
    fn with_fibres(&self, families: Vec<(Stiffness, PyRef<'_, Texture>)>) -> PyResult<Self> {
        const WHAT: &str = "fibres";
        let family = |(stiffness, direction): &(Stiffness, PyRef<'_, Texture>)| {
            let stiffness = match *stiffness {
                Stiffness::Exponential((k1, k2, dispersion)) => {
                    bulk::FibreStiffness::Exponential { k1, k2, dispersion }
                }
                Stiffness::Linear(modulus) => bulk::FibreStiffness::Linear { modulus },
            };
            let direction = direction.fibres();
            let direction = direction.ok_or_else(|| {
                refused(WHAT, "only lines along or around an axis can be rotated")
            })?;
            Ok(bulk::Fibres {
                stiffness,
                direction,
            })
        };
        let families: PyResult<Vec<bulk::Fibres>> = families.iter().map(family).collect();
        let made = bulk::Fibrous::new(self.0.clone(), &families?);
        let made = made.map_err(|error| refused(WHAT, error))?;
        Ok(Self(bulk::Material::fibrous(made), None))
    }

    /// Young's modulus and Poisson's ratio at rest.
    fn constants(&self) -> (f64, f64) {
        let constants = self.0.lame_constants();
        (constants.youngs_modulus(), constants.poissons_ratio())
    }

    /// Energy per reference volume, first Piola-Kirchhoff stress by rows.
    fn response(&self, deformation_gradient: [[f64; 3]; 3]) -> PyResult<(f64, [[f64; 3]; 3])> {
        let gradient = nalgebra::Matrix3::from(deformation_gradient).transpose();
        let response = self.0.response(&gradient);
        let response = response.map_err(|error| refused("deformation_gradient", error))?;
        Ok((response.energy, response.first_piola.transpose().into()))
    }
}

/// Stiffness of fibres.
#[derive(FromPyObject)]
pub enum Stiffness {
    /// `k1`, `k2` and dispersion.
    Exponential((f64, f64, f64)),
    /// Modulus.
    Linear(f64),
}
