//! Textures of surfaces.

use pyo3::prelude::*;
use striae::{
    declared::{Statement, Value, Values, named},
    law::bulk::{DIRECTIONS, Direction},
    surface::texture::{Paint, TEXTURES},
};

use crate::declared::{self, Given};

/// Directions on a surface at rest.
#[pyclass(frozen, module = "striae._striae")]
pub struct Texture(pub Paint);

#[pymethods]
impl Texture {
    /// A declared texture of values by their names; `class` is what faults call it.
    #[staticmethod]
    fn declared(class: &str, texture: &str, values: Vec<(String, Given)>) -> PyResult<Self> {
        declared::made(TEXTURES, texture, class, &values).map(Self)
    }
}

impl Texture {
    /// The directions as those of fibres of the same name, if fibres can have them: numbers that
    /// those do not know are zero.
    pub fn fibres(&self) -> Option<Direction> {
        let Statement { law, values } = self.0.stated()?;
        let direction = named(DIRECTIONS, law)?;
        let mut known = Values::default();
        for (name, value) in values.iter() {
            match direction.parameters.iter().any(|one| one.name == name) {
                true => known = known.with(name, value.clone()),
                false if *value == Value::Number(0.0) => {}
                false => return None,
            }
        }
        direction.made(&known).ok()
    }
}
