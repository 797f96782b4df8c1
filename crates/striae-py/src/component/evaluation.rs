//! Evaluations of contact as arrays.

use std::sync::Arc;

use numpy::PyArray1;
use pyo3::{prelude::*, types::PyDict};
use striae::contact::{component, side::Side};

use crate::{
    array::{Array1, Array2, rows},
    side::OfSide,
};

/// Contact at given positions and tractions.
#[pyclass(frozen, module = "striae._striae")]
pub struct Evaluation(pub Arc<component::Evaluated>);

#[pymethods]
impl Evaluation {
    fn residual<'py>(&self, py: Python<'py>) -> Array1<'py, f64> {
        PyArray1::from_slice(py, &self.0.residual)
    }

    /// Rows, columns and values of the tangent.
    #[allow(clippy::type_complexity)]
    fn tangent<'py>(
        &self,
        py: Python<'py>,
    ) -> (Array1<'py, i64>, Array1<'py, i64>, Array1<'py, f64>) {
        let numbers = |list: &[usize]| {
            let numbers = list.iter().map(|number| *number as i64);
            PyArray1::from_vec(py, numbers.collect())
        };
        (
            numbers(&self.0.rows),
            numbers(&self.0.columns),
            PyArray1::from_slice(py, &self.0.values),
        )
    }

    fn norm(&self) -> f64 {
        self.0.norm
    }

    fn number(&self) -> usize {
        self.0.number
    }

    /// Contact forces on all nodes.
    fn forces<'py>(&self, py: Python<'py>) -> PyResult<Array2<'py, f64>> {
        let nodes = 0..self.0.positions().len();
        rows(py, nodes.map(|node| self.0.force(node).into()))
    }

    /// Force on a side of a pair, and its moment about the origin.
    fn resultant<'py>(&self, py: Python<'py>, pair: usize, b: bool) -> [Array1<'py, f64>; 2] {
        let found = self.0.resultant(pair, side(b));
        found.map(|vector| PyArray1::from_slice(py, vector.as_slice()))
    }

    fn dissipated(&self, pair: usize) -> f64 {
        self.0.dissipated(pair)
    }

    /// Nodes of a side of a pair and what is known there; nothing of a rigid one.
    fn side<'py>(&self, py: Python<'py>, pair: usize, b: bool) -> PyResult<Bound<'py, PyDict>> {
        let nodes = self.0.contact().nodes(pair, side(b));
        if nodes.is_empty() {
            return Ok(PyDict::new(py));
        }
        let of_side = OfSide {
            nodes: &nodes,
            facets: self.0.contact().surface(pair, side(b)),
            positions: self.0.positions(),
            known: self.0.nodes(pair, side(b)),
        };
        of_side.arrays(py)
    }
}

fn side(b: bool) -> Side {
    if b { Side::B } else { Side::A }
}
