//! All materials of a deck.

use super::material;
use crate::{faults::FaultList, names::Names, raw, read::At, value::Text};
use striae_law::bulk::Material;

/// All materials of the deck.
pub(super) struct Materials {
    names: Names,
    materials: Vec<Option<Material>>,
    densities: Vec<Option<f64>>,
}

impl Materials {
    pub(super) fn new(raw: &[At<raw::Material>], faults: &mut FaultList<'_>) -> Self {
        let names = Names::new(
            "material",
            raw.iter().map(|material| material.value.name.as_ref()),
            faults,
        );
        let materials = raw
            .iter()
            .map(|raw| material::material(&raw.value, &raw.span, faults))
            .collect();
        let density = |material: &At<raw::Material>| {
            let density = material.value.density.as_ref();
            density.map(|density| density.value.0)
        };
        Self {
            names,
            materials,
            densities: raw.iter().map(density).collect(),
        }
    }

    /// The material of that name, if it is sound, and its density, if it has one.
    pub(super) fn find(
        &self,
        name: &At<Text>,
        faults: &mut FaultList<'_>,
    ) -> (Option<Material>, Option<f64>) {
        match self.names.find(name, faults) {
            Some(at) => (self.materials[at].clone(), self.densities[at]),
            None => (None, None),
        }
    }
}
