//! Friction laws and their slip surfaces.

use numpy::PyArray1;
use pyo3::prelude::*;
use striae::law::friction::{self, FrictionError, SlipRule};

use crate::{
    array::Array1,
    fault::{model_error, refused},
    own_friction::{Harmonic, Periodic},
};

/// Friction between two surfaces.
#[pyclass(frozen, module = "striae._striae")]
pub struct Friction(pub friction::Friction);

/// Angle of slip, components of friction, angle of friction and dissipation along a slip surface.
type Samples<'py> = [Array1<'py, f64>; 5];

#[pymethods]
impl Friction {
    #[staticmethod]
    fn frictionless() -> Self {
        Self(friction::Friction::frictionless())
    }

    #[staticmethod]
    fn coulomb(mu: f64) -> PyResult<Self> {
        made("Coulomb", friction::Friction::coulomb(mu))
    }

    #[staticmethod]
    fn two_textures(mu: f64, c_mag: f64, c_ang: f64, c_cen: f64) -> PyResult<Self> {
        let law = friction::Friction::two_textures(mu, c_mag, c_ang, c_cen);
        made("TwoTextures", law)
    }

    #[staticmethod]
    fn orthotropic(along: f64, across: f64, associated: bool) -> PyResult<Self> {
        let rule = if associated {
            SlipRule::Associated
        } else {
            SlipRule::Opposing
        };
        let law = friction::Friction::orthotropic(along, across, rule);
        made("Orthotropic", law)
    }

    #[staticmethod]
    fn nap(forward: f64, backward: f64, lateral: f64) -> PyResult<Self> {
        made("Nap", friction::Friction::nap(forward, backward, lateral))
    }

    #[staticmethod]
    fn tabulated(radians: Vec<f64>, mu: Vec<f64>) -> PyResult<Self> {
        made("Tabulated", friction::Friction::tabulated(&radians, &mu))
    }

    /// A law of one's own by the harmonics of its kernel over the angle between the textures.
    /// It is judged by the battery of friction laws.
    #[staticmethod]
    fn own(name: String, two: bool, harmonics: Vec<Harmonic>, mu: f64) -> PyResult<Self> {
        let law = Periodic::new(name.clone(), two, harmonics);
        let made = made(&name, friction::Friction::own(law, mu))?;
        let violations = friction::battery(&made.0);
        if violations.is_empty() {
            return Ok(made);
        }
        let told = violations.iter().map(|one| (name.clone(), one.to_string()));
        Err(model_error(told.collect()))
    }

    fn with_decay(&self, kinetic_over_static: f64, slip_rate: f64) -> PyResult<Self> {
        let law = self.0.clone().with_decay(kinetic_over_static, slip_rate);
        made("decay", law)
    }

    fn with_shear_cap(&self, shear_cap: f64) -> PyResult<Self> {
        made("shear_cap", self.0.clone().with_shear_cap(shear_cap))
    }

    /// The largest coefficient at rest, with which the slip surface is scaled.
    #[getter]
    fn coefficient(&self) -> f64 {
        self.0.coefficient().at_rest()
    }

    /// Samples of the slip surface over `varpi` for textures at an angle.
    fn slip_surface<'py>(&self, py: Python<'py>, theta: f64, count: usize) -> Samples<'py> {
        let samples = self.0.slip_surface(theta).sampled(count);
        let column = |value: &dyn Fn(&friction::SlipSample) -> f64| {
            PyArray1::from_vec(py, samples.iter().map(value).collect())
        };
        [
            column(&|sample| sample.slip.y.atan2(sample.slip.x)),
            column(&|sample| sample.traction.x),
            column(&|sample| sample.traction.y),
            column(&|sample| sample.traction.y.atan2(sample.traction.x)),
            column(&friction::SlipSample::dissipation),
        ]
    }
}

fn made(law: &str, friction: Result<friction::Friction, FrictionError>) -> PyResult<Friction> {
    friction.map(Friction).map_err(|error| refused(law, error))
}
