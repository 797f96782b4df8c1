//! Sections of bodies: elements of other materials.

use super::{cards::Cards, formulation::formulation, list, materials::Materials, sets};
use crate::{fault::FaultKind, faults::FaultList, raw};
use striae_mesh::Mesh;
use striae_model::{BodySection, FaultKind as ModelFault, Formulation};

/// Parts that the sections of a body refer to.
pub(super) struct Sections<'a> {
    pub(super) materials: &'a Materials,
    /// Formulation requested for the whole body, by the deck or the elements of its mesh file.
    pub(super) stated: Option<Formulation>,
    pub(super) mesh: &'a Mesh,
    pub(super) body: &'a str,
    /// Materials stated by the mesh file, if the deck requests them.
    pub(super) cards: Option<Cards>,
}

impl Sections<'_> {
    /// The sections that are sound; notes elements that have no material.
    pub(super) fn lowered(&self, raw: &raw::Body, faults: &mut FaultList<'_>) -> Vec<BodySection> {
        let all = list(&raw.sections);
        let sound = all.iter();
        let sound = sound.filter_map(|section| self.section(&section.value, faults));
        let mut sound: Vec<BodySection> = sound.collect();
        let are_sound = sound.len() == all.len();
        let Some(of_file) = self.of_file(raw, faults) else {
            return sound;
        };
        sound.extend(of_file);
        if raw.material.is_none() && are_sound {
            let count = self.mesh.element_count();
            if let Some(kind) = ModelFault::no_material(self.body, count, &sound) {
                let span = raw.name.as_ref().map_or(0..0, |name| name.span.clone());
                faults.push(&span, kind);
            }
        }
        sound
    }

    /// The sections that the mesh file states; `None` after a fault.
    fn of_file(&self, raw: &raw::Body, faults: &mut FaultList<'_>) -> Option<Vec<BodySection>> {
        let Some(cards) = &self.cards else {
            return Some(Vec::new());
        };
        let found = cards.sections(self.mesh, self.stated);
        let fault = |cause: String| {
            let span = raw.mesh.as_ref().map_or(0..0, |mesh| mesh.span.clone());
            let body = self.body.to_owned();
            faults.push(&span, FaultKind::FileMaterials { body, cause });
        };
        found.map_err(fault).ok()
    }

    fn section(&self, raw: &raw::BodySection, faults: &mut FaultList<'_>) -> Option<BodySection> {
        let found = raw.material.as_ref();
        let found = found.map(|name| self.materials.find(name, faults));
        let set = raw.elements.as_ref()?;
        let elements = sets::members("element", &self.mesh.element_sets, self.body, set, faults)?;
        let (material, density) = found?;
        let material = material?;
        let suited = Formulation::suited_to(&material);
        let stated = formulation(&raw.formulation).or(self.stated);
        Some(BodySection {
            set: set.value.0.clone(),
            elements,
            formulation: stated.unwrap_or(suited),
            material,
            density: density.unwrap_or(0.0),
        })
    }
}
