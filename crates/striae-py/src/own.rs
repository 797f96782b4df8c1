//! Bulk laws that are functions of Python.
//!
//! The interpreter's lock is taken for each call and no longer. The first exception of a function
//! is kept; from then on the law has no response, so that a run ends there whatever the order of
//! its threads, and the exception is raised when it has ended.

use std::fmt;

use nalgebra::{Matrix3, SMatrix};
use numpy::{PyArray1, PyArrayMethods, PyReadonlyArrayDyn};
use pyo3::prelude::*;
use striae::law::bulk::{self, BulkLaw, LameConstants, Response, ResponseError};

use crate::{fault::model_error, material::Material, raised::Raised};

/// A function from deformation gradients to energy, stress and tangent.
struct Function {
    name: String,
    function: Py<PyAny>,
    at_rest: LameConstants,
    raised: Raised,
}

impl fmt::Debug for Function {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Python function `{}`", self.name)
    }
}

/// Return value of the function: `None` if it does not allow such a deformation.
type Answer<'py> = Option<(
    f64,
    PyReadonlyArrayDyn<'py, f64>,
    PyReadonlyArrayDyn<'py, f64>,
)>;

impl Function {
    fn called(&self, gradient: &Matrix3<f64>) -> PyResult<Option<Response>> {
        Python::attach(|py| {
            let rows = gradient.transpose().iter().copied().collect();
            let array = PyArray1::from_vec(py, rows).reshape([3, 3])?;
            let answer = self.function.call1(py, (array,))?;
            let answer: Answer<'_> = answer.bind(py).extract()?;
            Ok(answer.map(|(energy, stress, tangent)| Response {
                energy,
                first_piola: Matrix3::from_row_iterator(stress.as_array().iter().copied()),
                tangent: SMatrix::from_row_iterator(tangent.as_array().iter().copied()),
            }))
        })
    }
}

impl BulkLaw for Function {
    fn name(&self) -> &str {
        &self.name
    }

    fn response(&self, gradient: &Matrix3<f64>) -> Result<Response, ResponseError> {
        let refused = ResponseError::Refused {
            determinant: gradient.determinant(),
        };
        if self.raised.is_set() {
            return Err(refused);
        }
        match self.called(gradient) {
            Ok(answer) => answer.ok_or(refused),
            Err(error) => {
                self.raised.set(error);
                Err(refused)
            }
        }
    }

    fn lame_constants(&self) -> LameConstants {
        self.at_rest
    }
}

/// A law that a function of Python states; it returns energy, stress of shape (3, 3) and
/// tangent of 81 components, or `None`. It is judged by the battery of bulk laws.
#[pyfunction]
pub fn own_material(name: String, function: Py<PyAny>) -> PyResult<Material> {
    let raised = Raised::default();
    let unknown = LameConstants {
        lambda: 0.0,
        shear: 1.0,
    };
    let mut law = Function {
        name: name.clone(),
        function,
        at_rest: unknown,
        raised: raised.clone(),
    };
    let wrong = |text: String| model_error(vec![(name.clone(), text)]);
    let Some(rest) = law.called(&Matrix3::identity())? else {
        return Err(wrong("it fails for the undeformed state".into()));
    };
    // A_1122 and A_1212.
    let [lambda, shear] = [rest.tangent[(0, 4)], rest.tangent[(1, 1)]];
    let is_stiff = shear > 0.0 && 3.0 * lambda + 2.0 * shear > 0.0;
    if !is_stiff {
        let text = format!("its moduli at rest are lambda = {lambda} and shear = {shear}");
        return Err(wrong(text));
    }
    law.at_rest = LameConstants { lambda, shear };
    let material = bulk::Material::own(law);
    let violations = bulk::battery(&material);
    if let Some(error) = raised.take() {
        return Err(error);
    }
    if violations.is_empty() {
        return Ok(Material(material, Some(raised)));
    }
    let told = violations.iter().map(|one| (name.clone(), one.to_string()));
    Err(model_error(told.collect()))
}
