//! Friction laws and their slip surfaces.

use numpy::PyArray1;
use pyo3::prelude::*;
use striae::declared::Kind;
use striae::law::friction::{
    self, BY_PRESSURE, BY_RATE, BY_SLIP, BY_STATE, DECAY, FactorRange, FrictionError, LAWS,
    OwnFactor, RequiredTextures,
};

use crate::{
    array::Array1,
    declared::{self, Given},
    fault::{model_error, refused},
    own_factor::Function,
    own_friction::{Harmonic, Periodic},
    raised::Raised,
};

/// Friction between two surfaces.
#[pyclass(frozen, module = "striae._striae")]
pub struct Friction(pub friction::Friction);

/// Angle of slip, components of friction, angle of friction and dissipation along a slip surface.
type Samples<'py> = [Array1<'py, f64>; 5];

#[pymethods]
impl Friction {
    /// A declared law of values by their names; `class` is what faults call it.
    #[staticmethod]
    fn declared(class: &str, law: &str, values: Vec<(String, Given)>) -> PyResult<Self> {
        declared::made(LAWS, law, class, &values).map(Self)
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

    /// The law with a factor that functions state for many points at once. With it the law must
    /// pass the battery of friction laws.
    #[allow(clippy::too_many_arguments)]
    fn with_factor(
        &self,
        name: String,
        factors: Py<PyAny>,
        states: Py<PyAny>,
        initial: Vec<f64>,
        range: [f64; 6],
        textures: &str,
    ) -> PyResult<Self> {
        let [pressure, slip_rate, slip, position, time, elapsed] = range;
        let raised = Raised::default();
        let law = Function {
            name: name.clone(),
            factors,
            states,
            initial,
            range: FactorRange {
                pressure,
                slip_rate,
                slip,
                position,
                time,
                elapsed,
            },
            textures: match textures {
                "both" => RequiredTextures::Both,
                "one" => RequiredTextures::One,
                _ => RequiredTextures::Any,
            },
            raised: raised.clone(),
        };
        let factor = OwnFactor::new(law);
        let judged = factor.and_then(|factor| {
            let made = self.0.clone().with_factor(factor)?;
            let violations = friction::battery(&made);
            Ok((made, violations))
        });
        if let Some(error) = raised.take() {
            return Err(error);
        }
        let (made, violations) = judged.map_err(|error| refused(&name, error))?;
        if violations.is_empty() {
            return Ok(Self(made));
        }
        let told = violations.iter().map(|one| (name.clone(), one.to_string()));
        Err(model_error(told.collect()))
    }

    /// The law with a declared dependence, by the key that it has in decks.
    fn with_dependence(
        &self,
        key: &str,
        form: &str,
        values: Vec<(String, Given)>,
    ) -> PyResult<Self> {
        let law = self.0.clone();
        Ok(Self(match key {
            "by_pressure" => law.with_pressure(declared::made(BY_PRESSURE, form, form, &values)?),
            "by_slip_rate" => law.with_rate(declared::made(BY_RATE, form, form, &values)?),
            "by_accumulated_slip" => law.with_slip(declared::made(BY_SLIP, form, form, &values)?),
            "by_state" => law.with_state(declared::made(BY_STATE, form, form, &values)?),
            _ => law.with_rate(declared::made(&[&DECAY], form, form, &values)?),
        }))
    }

    /// The name of the law and the values it was made of; nothing for one of one's own.
    fn statement(&self) -> Option<(&'static str, Vec<(&'static str, Given)>)> {
        let stated = self.0.statement()?;
        Some((stated.law, declared::given(&stated.values)))
    }

    /// The radius `varpi` of the slip surface, in steady slip, at pressures, slip rates and accumulated slips, all
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

    /// `true` if both surfaces must carry a texture.
    #[getter]
    fn of_two_textures(&self) -> bool {
        self.0.required_textures() == RequiredTextures::Both
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
