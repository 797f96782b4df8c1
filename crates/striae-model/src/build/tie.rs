//! Ties.

use crate::{fault::Fault, model::Tie, path::Path};

use super::{SideBuilder, lookup::Names, pair::sides};

/// A tie; see [`tie`].
#[derive(Clone, Debug)]
pub struct TieBuilder {
    name: String,
    sides: [SideBuilder; 2],
    within: Option<f64>,
}

/// Two surfaces of bodies that are glued from the start; their meshes need not match.
pub fn tie(name: impl Into<String>, a: SideBuilder, b: SideBuilder) -> TieBuilder {
    TieBuilder {
        name: name.into(),
        sides: [a, b],
        within: None,
    }
}

impl TieBuilder {
    /// Ties facets up to this distance and leaves others free; else up to a tenth of their size.
    pub fn within(mut self, distance: f64) -> Self {
        self.within = Some(distance);
        self
    }

    pub(super) fn name(&self) -> &str {
        &self.name
    }

    /// The tie.
    pub(super) fn resolved(
        &self,
        index: usize,
        names: &Names<'_>,
        faults: &mut Vec<Fault>,
    ) -> Option<Tie> {
        let [a, b] = sides(&self.sides, &Path::part("ties", index), names, faults)?;
        Some(Tie {
            name: self.name.clone(),
            a,
            b,
            within: self.within,
            moved: 0.0,
        })
    }
}
