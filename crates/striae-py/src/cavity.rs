//! Cavities under construction.

use pyo3::prelude::*;
use striae::model::{self, CavityBuilder};

/// A cavity.
#[pyclass(frozen, module = "striae._striae")]
pub struct Cavity(pub CavityBuilder);

#[pymethods]
impl Cavity {
    #[new]
    fn new(name: &str, first: (String, String), others: Vec<(String, String)>) -> Self {
        let cavity = model::cavity(name, first.0, first.1);
        let others = others.into_iter();
        Self(others.fold(cavity, |cavity, (body, facets)| cavity.and(body, facets)))
    }
}
