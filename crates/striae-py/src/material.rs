//! Bulk materials.

use pyo3::prelude::*;
use striae::law::bulk;

use crate::{fault::refused, raised::Raised, texture::Texture};

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
    #[staticmethod]
    fn neo_hookean(youngs_modulus: f64, poissons_ratio: f64, logarithmic: bool) -> PyResult<Self> {
        let constants = engineering("NeoHookean", youngs_modulus, poissons_ratio)?;
        let form = volumetric(logarithmic);
        let made = bulk::Material::neo_hookean_with(constants, form);
        Ok(Self(made, None))
    }

    #[staticmethod]
    fn linear_elastic(youngs_modulus: f64, poissons_ratio: f64) -> PyResult<Self> {
        let constants = engineering("LinearElastic", youngs_modulus, poissons_ratio)?;
        Ok(Self(bulk::Material::linear_elastic(constants), None))
    }

    /// Rubber: the name of its law, its constants in the order of the law, and its bulk
    /// modulus or Poisson's ratio.
    #[staticmethod]
    fn rubber(
        law: &str,
        constants: Vec<f64>,
        bulk_modulus: Option<f64>,
        poissons_ratio: Option<f64>,
        logarithmic: bool,
    ) -> PyResult<Self> {
        let isochoric = isochoric(law, &constants)
            .ok_or_else(|| refused(law, "it has another number of constants"))?;
        let volumetric = volumetric(logarithmic);
        let made = match (bulk_modulus, poissons_ratio) {
            (Some(modulus), None) => bulk::Hyperelastic::new(isochoric, modulus, volumetric),
            (None, Some(ratio)) => {
                bulk::Hyperelastic::with_poissons_ratio(isochoric, ratio, volumetric)
            }
            _ => {
                let text = "either `bulk_modulus` or `poissons_ratio` is needed";
                return Err(refused(law, text));
            }
        };
        let made = made.map_err(|error| refused(law, error))?;
        Ok(Self(bulk::Material::Hyperelastic(made), None))
    }

    /// Rubber with branches, each a ratio and a time, that relax beside it.
    fn relaxing(&self, branches: Vec<(f64, f64)>) -> PyResult<Self> {
        let bulk::Material::Hyperelastic(slow) = &self.0 else {
            return Err(refused("relaxation", "it needs a law of rubber"));
        };
        let branches = branches.into_iter();
        let branches: Vec<_> = branches
            .map(|(ratio, time)| bulk::Branch { ratio, time })
            .collect();
        let made = bulk::Viscoelastic::new(slow.clone(), &branches);
        let made = made.map_err(|error| refused("relaxation", error))?;
        Ok(Self(bulk::Material::Viscoelastic(made), None))
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
        Ok(Self(bulk::Material::Fibrous(made), None))
    }

    /// Metal: its elastic constants and its yield stress.
    #[staticmethod]
    fn elastic_plastic(
        youngs_modulus: f64,
        poissons_ratio: f64,
        hardening: Hardening,
    ) -> PyResult<Self> {
        const LAW: &str = "ElasticPlastic";
        let constants = engineering(LAW, youngs_modulus, poissons_ratio)?;
        let hardening = match hardening {
            Hardening::Linear((first, modulus)) => bulk::Hardening::linear(first, modulus),
            Hardening::Voce((first, modulus, (stress, rate))) => {
                bulk::Hardening::voce(first, stress, rate, modulus)
            }
            Hardening::Table(pairs) => bulk::Hardening::table(&pairs),
        };
        let hardening = hardening.map_err(|error| refused(LAW, error))?;
        let metal = bulk::Plastic::new(constants, hardening);
        Ok(Self(bulk::Material::Plastic(metal), None))
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

/// Yield stress over the equivalent plastic strain.
#[derive(FromPyObject)]
pub enum Hardening {
    /// First yield stress, hardening modulus, and stress and rate of saturation.
    Voce((f64, f64, (f64, f64))),
    /// First yield stress and hardening modulus.
    Linear((f64, f64)),
    /// Pairs of plastic strain and yield stress.
    Table(Vec<[f64; 2]>),
}

fn isochoric(law: &str, constants: &[f64]) -> Option<bulk::Isochoric> {
    Some(match (law, constants) {
        ("IsochoricNeoHookean", &[shear]) => bulk::Isochoric::NeoHookean { shear },
        ("MooneyRivlin", &[c10, c01]) => bulk::Isochoric::MooneyRivlin { c10, c01 },
        ("Yeoh", &[c10, c20, c30]) => bulk::Isochoric::Yeoh { c10, c20, c30 },
        ("Gent", &[shear, limit]) => bulk::Isochoric::Gent { shear, limit },
        ("ArrudaBoyce", &[mu, locking_stretch]) => bulk::Isochoric::ArrudaBoyce {
            mu,
            locking_stretch,
        },
        ("Ogden", terms) if terms.len().is_multiple_of(2) => {
            let term = |pair: &[f64]| bulk::OgdenTerm {
                mu: pair[0],
                alpha: pair[1],
            };
            bulk::Isochoric::Ogden(terms.chunks(2).map(term).collect())
        }
        _ => return None,
    })
}

fn volumetric(logarithmic: bool) -> bulk::Volumetric {
    match logarithmic {
        true => bulk::Volumetric::Logarithmic,
        false => bulk::Volumetric::Quadratic,
    }
}

fn engineering(law: &str, youngs_modulus: f64, ratio: f64) -> PyResult<bulk::LameConstants> {
    bulk::LameConstants::from_youngs_modulus(youngs_modulus, ratio)
        .map_err(|error| refused(law, error))
}
