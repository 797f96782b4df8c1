//! Cavities.

use crate::{fault::Fault, model::Cavity, path::Path};

use super::lookup::Names;

/// A cavity; see [`cavity`].
#[derive(Clone, Debug)]
pub struct CavityBuilder {
    name: String,
    parts: Vec<(String, String)>,
}

/// A cavity inside the faces of a facet set of a body, which look into it. The pressure in it is
/// that of the surroundings until a step [fills](crate::StepBuilder::fill) it.
pub fn cavity(
    name: impl Into<String>,
    body: impl Into<String>,
    facets: impl Into<String>,
) -> CavityBuilder {
    CavityBuilder {
        name: name.into(),
        parts: vec![(body.into(), facets.into())],
    }
}

impl CavityBuilder {
    /// Adds another facet set to its surface.
    pub fn and(mut self, body: impl Into<String>, facets: impl Into<String>) -> Self {
        self.parts.push((body.into(), facets.into()));
        self
    }

    pub(super) fn name(&self) -> &str {
        &self.name
    }

    pub(super) fn resolved(
        &self,
        index: usize,
        names: &Names<'_>,
        faults: &mut Vec<Fault>,
    ) -> Option<Cavity> {
        let path = |part| Path::part("cavities", index).field("parts").index(part);
        let parts = self.parts.iter().enumerate();
        let parts: Vec<_> = parts
            .filter_map(|(part, (body, set))| names.faces(body, set, &path(part), faults))
            .collect();
        (parts.len() == self.parts.len()).then(|| Cavity {
            name: self.name.clone(),
            parts,
        })
    }
}
