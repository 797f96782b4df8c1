//! Rigid bodies under construction.

use numpy::PyReadonlyArray2;
use pyo3::{exceptions::PyValueError, prelude::*};
use striae::{
    mesh::{NodeId, Vec3},
    model::{self, RigidBuilder, RigidInertia},
};

use crate::{
    array::{corners, vectors},
    fault::refused,
};

/// A rigid body.
#[pyclass(frozen, module = "striae._striae")]
pub struct Rigid(pub RigidBuilder);

#[pymethods]
impl Rigid {
    #[staticmethod]
    fn plane(name: &str, point: [f64; 3], normal: [f64; 3]) -> Self {
        Self(model::plane(name, point, normal))
    }

    #[staticmethod]
    fn surface(
        name: &str,
        points: PyReadonlyArray2<'_, f64>,
        facets: PyReadonlyArray2<'_, i64>,
        density: Option<f64>,
    ) -> PyResult<Self> {
        let (points, facets) = (vectors(&points)?, corners(&facets)?);
        within(name, &points, &facets)?;
        let Some(density) = density else {
            return Ok(Self(model::rigid_surface(name, points, facets)));
        };
        let solid = model::rigid_solid(name, points, facets, density);
        let refused = |error| refused(format!("rigid body `{name}`"), error);
        Ok(Self(solid.map_err(refused)?))
    }

    #[staticmethod]
    fn tied(name: &str, sets: Vec<(String, String)>) -> PyResult<Self> {
        let mut sets = sets.into_iter();
        let Some((body, nodes)) = sets.next() else {
            return Err(PyValueError::new_err("at least one node set is needed"));
        };
        let tied = model::tied(name, body, nodes);
        let all = sets.fold(tied, |rigid, (body, nodes)| rigid.and_tied(body, nodes));
        Ok(Self(all))
    }

    fn with_reference(&self, point: [f64; 3]) -> Self {
        Self(self.0.clone().reference(point))
    }

    fn with_inertia(&self, mass: f64, centre: [f64; 3], moments: [f64; 3]) -> Self {
        let inertia = RigidInertia::aligned(mass, centre.into(), moments);
        Self(self.0.clone().inertia(inertia))
    }
}

fn within(name: &str, points: &[Vec3], facets: &[[NodeId; 4]]) -> PyResult<()> {
    let count = points.len();
    match facets.iter().flatten().find(|node| node.index() >= count) {
        Some(node) => {
            let text = format!("a facet refers to {node}, but there are {count} points");
            Err(refused(format!("rigid body `{name}`"), text))
        }
        None => Ok(()),
    }
}
