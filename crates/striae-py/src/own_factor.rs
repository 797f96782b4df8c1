//! Factors of friction that functions of Python state, for all nodes of a pair at once.
//!
//! The interpreter's lock is taken for a call and no longer, by the one thread that asks, which
//! holds no work of others. The first exception of a function is kept, and raised when the run has
//! ended; the law has no factor then.

use std::{any::Any, fmt};

use numpy::{PyArray1, PyArrayMethods, PyReadonlyArray2};
use pyo3::{prelude::*, types::PyDict};
use striae::{
    law::friction::{
        Factor, FactorBatch, FactorFailure, FactorPoints, FactorRange, Friction, RequiredTextures,
    },
    model::Model,
    nalgebra::Vector3,
};

use crate::raised::Raised;

/// Number of columns of an answer: the factor and its derivatives.
const COLUMNS: usize = 12;

/// A factor that functions state.
pub struct Function {
    /// Name of the law.
    pub name: String,
    /// From arrays by their names to factors and derivatives, of shape (n, 12).
    pub factors: Py<PyAny>,
    /// From arrays by their names to states, of shape (n, m).
    pub states: Py<PyAny>,
    /// State at the start.
    pub initial: Vec<f64>,
    /// Values up to which the law is judged.
    pub range: FactorRange,
    /// Surfaces whose textures it needs.
    pub textures: RequiredTextures,
    /// First exception of the functions.
    pub raised: Raised,
}

impl fmt::Debug for Function {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Python function `{}`", self.name)
    }
}

impl Function {
    /// Rows of numbers that a function answers for points.
    fn asked(
        &self,
        function: &Py<PyAny>,
        points: &FactorPoints,
        columns: usize,
    ) -> Result<Vec<f64>, FactorFailure> {
        let answered = Python::attach(|py| -> PyResult<Vec<f64>> {
            let given = self.arrays(py, points)?;
            let answer = function.bind(py).call((), Some(&given))?;
            let answer: PyReadonlyArray2<'_, f64> = answer.extract()?;
            Ok(answer.as_array().iter().copied().collect())
        });
        let failed = |cause: String| FactorFailure {
            law: self.name.clone(),
            cause,
        };
        match answered {
            Ok(found) if found.len() == columns * points.len() => Ok(found),
            Ok(found) => Err(failed(format!(
                "{} numbers for {} points",
                found.len(),
                points.len()
            ))),
            Err(error) => {
                let cause = error.to_string();
                self.raised.set(error);
                Err(failed(cause))
            }
        }
    }

    fn arrays<'py>(&self, py: Python<'py>, points: &FactorPoints) -> PyResult<Bound<'py, PyDict>> {
        let count = points.len();
        let scalars = |list: &[f64]| PyArray1::from_slice(py, list);
        let vectors = |list: &[Vector3<f64>]| {
            let numbers = list.iter().flat_map(|v| v.iter().copied()).collect();
            PyArray1::from_vec(py, numbers).reshape([count, 3])
        };
        // A function that has not asked for textures must not take them for zero.
        let textures = |list: &[Vector3<f64>], asked: bool| match asked {
            true => vectors(list),
            false => vectors(&vec![Vector3::repeat(f64::NAN); count]),
        };
        let asks = self.textures != RequiredTextures::Any;
        let states = scalars(&points.states).reshape([count, self.initial.len()])?;
        let given = PyDict::new(py);
        given.set_item("pressure", scalars(&points.pressure))?;
        given.set_item("slip_rate", scalars(&points.slip_rate))?;
        given.set_item("accumulated_slip", scalars(&points.accumulated_slip))?;
        given.set_item("position", vectors(&points.position)?)?;
        given.set_item("normal", vectors(&points.normal)?)?;
        given.set_item("texture", textures(&points.own, asks)?)?;
        given.set_item("opposite_texture", textures(&points.opposite, asks)?)?;
        given.set_item("state", states)?;
        given.set_item("time", points.time)?;
        given.set_item("duration", points.elapsed)?;
        Ok(given)
    }
}

impl FactorBatch for Function {
    fn name(&self) -> &str {
        &self.name
    }

    fn range(&self) -> FactorRange {
        self.range
    }

    fn required_textures(&self) -> RequiredTextures {
        self.textures
    }

    fn initial_state(&self) -> Vec<f64> {
        self.initial.clone()
    }

    fn factors(&self, points: &FactorPoints) -> Result<Vec<Factor>, FactorFailure> {
        let found = self.asked(&self.factors, points, COLUMNS)?;
        let factor = |row: &[f64]| Factor {
            value: row[0],
            by_pressure: row[1],
            by_slip_rate: row[2],
            by_surroundings: std::array::from_fn(|at| row[3 + at]),
        };
        Ok(found.chunks_exact(COLUMNS).map(factor).collect())
    }

    fn states_after(&self, points: &FactorPoints) -> Result<Vec<f64>, FactorFailure> {
        match self.initial.is_empty() {
            true => Ok(Vec::new()),
            false => self.asked(&self.states, points, self.initial.len()),
        }
    }

    fn as_any(&self) -> Option<&dyn Any> {
        Some(self)
    }
}

/// Exceptions of the functions that state factors of the frictions of a model.
pub fn raised_in(model: &Model) -> Vec<Raised> {
    let pairs = model.pairs.iter().map(|pair| &pair.friction);
    let steps = model.steps.iter().flat_map(|step| &step.frictions);
    let frictions = pairs.chain(steps.map(|(_, friction)| friction));
    frictions.filter_map(raised_by).collect()
}

fn raised_by(friction: &Friction) -> Option<Raised> {
    let law = friction.factor()?.as_any()?;
    let function: &Function = law.downcast_ref()?;
    Some(function.raised.clone())
}
