//! Contact pairs under construction.

use pyo3::prelude::*;
use striae::model::{self, ClosedGaps, Enforcement, Initial, PairBuilder, SideBuilder};

use crate::{friction::Friction, step::Along, texture::Texture};

/// Names of a body and its facet set, or of a rigid body alone.
type Surface = (String, Option<String>);

/// A contact pair.
#[pyclass(frozen, module = "striae._striae")]
pub struct Pair(pub PairBuilder);

#[pymethods]
impl Pair {
    #[new]
    fn new(
        name: &str,
        sides: (Surface, Option<Surface>),
        textures: (Option<PyRef<'_, Texture>>, Option<PyRef<'_, Texture>>),
        friction: Option<PyRef<'_, Friction>>,
    ) -> Self {
        let side = |(owner, facets): Surface| match facets {
            Some(facets) => model::surface(owner, facets),
            None => model::rigid(owner),
        };
        let (a, b) = (side(sides.0), sides.1.map_or_else(model::itself, side));
        let pair = model::pair(name, textured(a, textures.0), textured(b, textures.1));
        Self(match friction {
            Some(friction) => pair.friction(friction.0.clone()),
            None => pair,
        })
    }

    fn collocated(&self) -> Self {
        Self(self.0.clone().enforcement(Enforcement::Collocated))
    }

    fn searching(&self, distance: f64) -> Self {
        Self(self.0.clone().search_distance(distance))
    }

    fn divided(&self, feature_angle: f64) -> Self {
        Self(self.0.clone().feature_angle(feature_angle))
    }

    fn stabilised(&self) -> Self {
        Self(self.0.clone().stabilised())
    }

    fn interfering(&self, value: f64, along: Along) -> PyResult<Self> {
        Ok(Self(self.0.clone().interference(value, along.curve()?)))
    }

    fn wearing(&self, a: f64, b: f64) -> Self {
        Self(self.0.clone().wear(a, b))
    }

    fn wearing_across(&self, ratio: f64) -> Self {
        Self(self.0.clone().wear_across(ratio))
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

fn textured(side: SideBuilder, texture: Option<PyRef<'_, Texture>>) -> SideBuilder {
    match texture {
        Some(texture) => side.textured(texture.0.clone()),
        None => side,
    }
}
