//! Friction laws and their slip surfaces.

use numpy::PyArray1;
use pyo3::prelude::*;
use striae::law::friction::{
    self, Decay, FrictionError, Logarithm, PressureDependence, RateDependence, SlipDependence,
    SlipRule,
};

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

    /// User-defined law by the harmonics of its kernel over the angle between the textures. The law
    /// must pass the battery of friction laws.
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

    #[pyo3(signature = (exponent, pressure, floor))]
    fn with_power_law(&self, exponent: f64, pressure: f64, floor: Option<f64>) -> PyResult<Self> {
        let law = PressureDependence::power_law(exponent, pressure, floor);
        self.by_pressure("power law", law)
    }

    #[pyo3(signature = (pressure, floor))]
    fn with_adhesion(&self, pressure: f64, floor: Option<f64>) -> PyResult<Self> {
        self.by_pressure("adhesion", PressureDependence::adhesion(pressure, floor))
    }

    fn with_saturation(&self, shear_stress: f64) -> PyResult<Self> {
        let law = PressureDependence::saturation(shear_stress);
        self.by_pressure("saturation", law)
    }

    fn with_pressure_table(&self, pressures: Vec<f64>, factors: Vec<f64>) -> PyResult<Self> {
        let law = PressureDependence::table(&pressures, &factors);
        self.by_pressure("pressure table", law)
    }

    fn with_stribeck(
        &self,
        kinetic_over_static: f64,
        slip_rate: f64,
        exponent: f64,
        viscous: f64,
    ) -> PyResult<Self> {
        let law = RateDependence::decay(Decay {
            kinetic_over_static,
            slip_rate,
            exponent,
            viscous,
        });
        self.by_rate("Stribeck curve", law)
    }

    #[pyo3(signature = (factor, slip_rate, limit))]
    fn with_logarithm(&self, factor: f64, slip_rate: f64, limit: Option<f64>) -> PyResult<Self> {
        let law = RateDependence::logarithm(Logarithm {
            factor,
            slip_rate,
            limit,
        });
        self.by_rate("logarithm", law)
    }

    fn with_slip_rate_table(&self, slip_rates: Vec<f64>, factors: Vec<f64>) -> PyResult<Self> {
        let law = RateDependence::table(&slip_rates, &factors);
        self.by_rate("slip rate table", law)
    }

    fn with_running_in(&self, final_over_initial: f64, slip: f64) -> PyResult<Self> {
        let law = SlipDependence::exponential(final_over_initial, slip);
        self.by_slip("running in", law)
    }

    fn with_accumulated_slip_table(&self, slips: Vec<f64>, factors: Vec<f64>) -> PyResult<Self> {
        let law = SlipDependence::table(&slips, &factors);
        self.by_slip("accumulated slip table", law)
    }

    /// The radius `varpi` of the slip surface at pressures, slip rates and accumulated slips, all
    /// of one length.
    fn bound<'py>(
        &self,
        py: Python<'py>,
        pressures: Vec<f64>,
        slip_rates: Vec<f64>,
        slips: Vec<f64>,
    ) -> Array1<'py, f64> {
        let places = pressures.into_iter().zip(slip_rates).zip(slips);
        let found = places.map(|((pressure, rate), slip)| self.0.cap_after(slip, pressure, rate));
        PyArray1::from_vec(py, found.collect())
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

impl Friction {
    fn by_pressure(
        &self,
        what: &str,
        law: Result<PressureDependence, FrictionError>,
    ) -> PyResult<Self> {
        made(what, law.map(|law| self.0.clone().with_pressure(law)))
    }

    fn by_slip(&self, what: &str, law: Result<SlipDependence, FrictionError>) -> PyResult<Self> {
        made(what, law.map(|law| self.0.clone().with_slip(law)))
    }

    fn by_rate(&self, what: &str, law: Result<RateDependence, FrictionError>) -> PyResult<Self> {
        made(what, law.map(|law| self.0.clone().with_rate(law)))
    }
}

fn made(law: &str, friction: Result<friction::Friction, FrictionError>) -> PyResult<Friction> {
    friction.map(Friction).map_err(|error| refused(law, error))
}
