//! Textures of surfaces.

use numpy::PyReadonlyArray2;
use pyo3::prelude::*;
use striae::{model, surface::texture::Paint};

use crate::array::vectors;

/// Directions on a surface at rest.
#[pyclass(frozen, module = "striae._striae")]
pub struct Texture(pub Paint);

#[pymethods]
impl Texture {
    #[staticmethod]
    fn uniform(direction: [f64; 3], turn: f64) -> Self {
        Self(model::turned(model::uniform(direction), turn))
    }

    #[staticmethod]
    fn circumferential(point: [f64; 3], direction: [f64; 3], turn: f64) -> Self {
        Self(model::turned(
            model::circumferential(point, direction),
            turn,
        ))
    }

    #[staticmethod]
    fn axial(point: [f64; 3], direction: [f64; 3], turn: f64) -> Self {
        Self(model::turned(model::axial(point, direction), turn))
    }

    #[staticmethod]
    fn radial(point: [f64; 3], direction: [f64; 3], turn: f64) -> Self {
        Self(model::turned(model::radial(point, direction), turn))
    }

    #[staticmethod]
    fn painted(
        places: PyReadonlyArray2<'_, f64>,
        directions: PyReadonlyArray2<'_, f64>,
        width: Option<f64>,
    ) -> PyResult<Self> {
        let places = vectors(&places)?.into_iter().zip(vectors(&directions)?);
        Ok(Self(model::painted(places.collect(), width)))
    }

    #[staticmethod]
    fn nodal(directions: PyReadonlyArray2<'_, f64>) -> PyResult<Self> {
        Ok(Self(model::nodal(vectors(&directions)?)))
    }
}
