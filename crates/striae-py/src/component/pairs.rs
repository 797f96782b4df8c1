//! Surfaces of a mesh and pairs of them.

use numpy::PyReadonlyArray2;
use pyo3::prelude::*;
use striae::{
    contact::component::{Opponent, Pair, Surface},
    law::friction,
    model::RigidShape,
};

use crate::{array::corners, fault::refused, friction::Friction, rigid::Rigid, texture::Texture};

/// Facets of a mesh.
#[pyclass(frozen, module = "striae._striae")]
pub struct MeshSurface(Surface);

#[pymethods]
impl MeshSurface {
    #[new]
    fn new(
        facets: PyReadonlyArray2<'_, i64>,
        youngs_modulus: f64,
        texture: Option<PyRef<'_, Texture>>,
    ) -> PyResult<Self> {
        Ok(Self(Surface {
            facets: corners(&facets)?,
            youngs_modulus,
            texture: texture.map(|texture| texture.0.clone()),
        }))
    }
}

/// Two surfaces that may touch.
#[pyclass(frozen, module = "striae._striae")]
pub struct MeshPair(pub Pair);

#[pymethods]
impl MeshPair {
    /// Two surfaces of the mesh.
    #[staticmethod]
    fn deformable(
        name: String,
        a: &MeshSurface,
        b: &MeshSurface,
        friction: Option<PyRef<'_, Friction>>,
        search_distance: Option<f64>,
    ) -> Self {
        Self(Pair {
            name,
            a: a.0.clone(),
            b: Opponent::Deformable(b.0.clone()),
            friction: law(friction),
            search_distance,
        })
    }

    /// A surface of the mesh and a rigid one.
    #[staticmethod]
    fn rigid(
        name: String,
        a: &MeshSurface,
        b: &Rigid,
        texture: Option<PyRef<'_, Texture>>,
        friction: Option<PyRef<'_, Friction>>,
        search_distance: Option<f64>,
    ) -> PyResult<Self> {
        let texture = texture.map(|texture| texture.0.clone());
        let b = match b.0.shape() {
            RigidShape::Plane { point, normal } => Opponent::Plane {
                point: *point,
                normal: *normal,
                texture,
            },
            RigidShape::Facets { positions, facets } => Opponent::Rigid {
                points: positions.clone(),
                facets: facets.clone(),
                texture,
            },
            RigidShape::Bare => {
                return Err(refused("b", "a rigid body without a surface cannot touch"));
            }
        };
        let (a, friction) = (a.0.clone(), law(friction));
        Ok(Self(Pair {
            name,
            a,
            b,
            friction,
            search_distance,
        }))
    }
}

fn law(friction: Option<PyRef<'_, Friction>>) -> friction::Friction {
    friction.map_or_else(friction::Friction::frictionless, |law| law.0.clone())
}
