//! Contact of everything under construction.

use pyo3::prelude::*;
use striae::model::{self, ClosedGaps, Initial};

use crate::{friction::Friction, texture::Texture};

/// Contact of every surface with every surface.
#[pyclass(frozen, module = "striae._striae")]
pub struct Everything(pub model::Everything);

#[pymethods]
impl Everything {
    #[new]
    fn new(friction: Option<PyRef<'_, Friction>>) -> Self {
        let everything = model::everything();
        Self(match friction {
            Some(friction) => everything.friction(friction.0.clone()),
            None => everything,
        })
    }

    fn between(&self, a: &str, b: &str, friction: PyRef<'_, Friction>) -> Self {
        Self(self.0.clone().between(a, b, friction.0.clone()))
    }

    fn excluding(&self, a: &str, b: Option<&str>) -> Self {
        let everything = self.0.clone();
        Self(match b {
            Some(b) => everything.exclude_between(a, b),
            None => everything.exclude(a),
        })
    }

    fn textured(&self, surface: &str, texture: PyRef<'_, Texture>) -> Self {
        Self(self.0.clone().textured(surface, texture.0.clone()))
    }

    fn divided(&self, feature_angle: f64) -> Self {
        Self(self.0.clone().feature_angle(feature_angle))
    }

    fn searching(&self, distance: f64) -> Self {
        Self(self.0.clone().search_distance(distance))
    }

    fn stabilised(&self) -> Self {
        Self(self.0.clone().stabilised())
    }

    fn resolved(&self) -> Self {
        Self(self.0.clone().initial(Initial::Resolve))
    }

    /// Gaps closed up to a given one, or a share of the local facet size.
    fn closed(&self, gap: Option<f64>) -> Self {
        let gaps = gap.map_or_else(ClosedGaps::default, ClosedGaps::UpTo);
        Self(self.0.clone().initial(Initial::Close(gaps)))
    }
}
