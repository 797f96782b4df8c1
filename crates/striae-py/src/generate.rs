//! Meshes of declared generators.

use pyo3::prelude::*;
use striae::mesh::generate::{GENERATORS, Generate};

use crate::{
    declared::{self, Given},
    mesh::{Mesh, made},
};

/// The mesh that a generator makes of values.
#[pyfunction]
pub fn generated(generator: &str, values: Vec<(String, Given)>) -> PyResult<Mesh> {
    let generator = declared::made(GENERATORS, generator, generator, &values)?;
    made(generator.mesh())
}
