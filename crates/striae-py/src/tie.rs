//! Ties under construction.

use pyo3::prelude::*;
use striae::model::{self, TieBuilder};

/// A tie.
#[pyclass(frozen, module = "striae._striae")]
pub struct Tie(pub TieBuilder);

#[pymethods]
impl Tie {
    #[new]
    fn new(name: &str, sides: [(String, String); 2], within: Option<f64>) -> Self {
        let [a, b] = sides.map(|(body, facets)| model::surface(body, facets));
        let tie = model::tie(name, a, b);
        Self(match within {
            Some(distance) => tie.within(distance),
            None => tie,
        })
    }
}
