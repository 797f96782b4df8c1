//! States of contact, which can be stored.

use pyo3::{prelude::*, types::PyBytes};
use striae::contact::component;

use crate::{
    array::{Array2, rows},
    fault::refused,
};

/// First bytes of a stored state, which change with its form.
const FORM: &[u8] = b"striae contact 2\n";

/// A state.
#[pyclass(frozen, module = "striae._striae")]
pub struct State(pub component::State);

#[pymethods]
impl State {
    /// Positions of all nodes.
    fn positions<'py>(&self, py: Python<'py>) -> PyResult<Array2<'py, f64>> {
        rows(py, self.0.positions().iter().map(|x| (*x).into()))
    }

    /// Work that friction has dissipated, by pair.
    fn dissipated(&self) -> Vec<f64> {
        self.0.pairs().iter().map(|pair| pair.dissipated).collect()
    }

    fn stored<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        let bytes = postcard::to_extend(&self.0, FORM.to_vec());
        let bytes = bytes.map_err(|error| refused("state", error))?;
        Ok(PyBytes::new(py, &bytes))
    }

    #[staticmethod]
    fn restored(bytes: &[u8]) -> PyResult<Self> {
        let own = bytes.strip_prefix(FORM);
        let own = own.ok_or_else(|| refused("state", "it is one of another version, or none"))?;
        let state = postcard::from_bytes(own).map(Self);
        state.map_err(|error| refused("state", format!("it is damaged: {error}")))
    }
}
