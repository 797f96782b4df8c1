//! Springs under construction.

use pyo3::prelude::*;
use striae::model::{self, SpringBuilder, SpringEndBuilder};

/// Springs.
#[pyclass(frozen, module = "striae._striae")]
pub struct Spring(pub SpringBuilder);

/// Name of a body and of its node set, or name of a rigid body and a point of it.
type End = (String, Option<String>, Option<[f64; 3]>);

#[pymethods]
impl Spring {
    /// To another end.
    #[staticmethod]
    fn between(name: &str, a: End, b: End) -> Self {
        Self(model::spring(name, end(a), end(b)))
    }

    /// To a point at rest.
    #[staticmethod]
    fn to_point(name: &str, a: End, point: [f64; 3]) -> Self {
        Self(model::spring_to_point(name, end(a), point))
    }

    /// Along a direction, to ground.
    #[staticmethod]
    fn along(name: &str, a: End, direction: [f64; 3]) -> Self {
        Self(model::spring_along(name, end(a), direction))
    }

    /// The springs with these numbers.
    fn with_numbers(
        &self,
        stiffness: f64,
        damping: f64,
        free_length: Option<f64>,
        preload: Option<f64>,
    ) -> Self {
        let mut spring = self.0.clone().stiffness(stiffness).damping(damping);
        if let Some(length) = free_length {
            spring = spring.free_length(length);
        }
        if let Some(tension) = preload {
            spring = spring.preload(tension);
        }
        Self(spring)
    }
}

fn end((name, nodes, point): End) -> SpringEndBuilder {
    match (nodes, point) {
        (Some(nodes), _) => model::nodes_of(name, nodes),
        (None, Some(point)) => model::point_of(name, point),
        (None, None) => model::reference_of(name),
    }
}
