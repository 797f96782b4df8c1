//! Textures of surfaces.

use numpy::PyReadonlyArray2;
use pyo3::prelude::*;
use striae::{
    law::bulk::{Direction, LinesAbout},
    model,
    surface::texture::{Axis, Lines, Paint},
};

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

impl Texture {
    /// The directions as those of fibres, if fibres can have them.
    pub fn fibres(&self) -> Option<Direction> {
        let Paint::Field(field) = &self.0 else {
            return None;
        };
        let turn = field.turn;
        let about = |axis: &Axis, lines| Direction::About {
            point: axis.point,
            axis: axis.direction,
            lines,
        };
        Some(match &field.lines {
            Lines::Circumferential(axis) => about(axis, LinesAbout::Circumferential { turn }),
            Lines::Axial(axis) => about(axis, LinesAbout::Axial { turn }),
            Lines::Uniform(_) | Lines::Radial(_) if turn != 0.0 => return None,
            Lines::Uniform(direction) => Direction::Uniform(*direction),
            Lines::Radial(axis) => about(axis, LinesAbout::Radial),
        })
    }
}
