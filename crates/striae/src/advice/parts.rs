//! Parts of bodies that are of one material: a section, or what is in none.

use std::collections::BTreeSet;

use striae_law::bulk::Material;
use striae_mesh::CellKind;
use striae_model::{Body, Formulation};

/// Elements of a body that are of one material.
pub(super) struct Part<'m> {
    /// The body or section, as the subject of a sentence.
    pub(super) name: String,
    /// Their material.
    pub(super) material: &'m Material,
    /// Formulation of the elements.
    pub(super) formulation: Formulation,
    /// Mass per reference volume.
    pub(super) density: f64,
    /// Their kinds.
    pub(super) kinds: BTreeSet<CellKind>,
}

impl<'m> Part<'m> {
    /// The parts of a body that have elements.
    pub(super) fn all(body: &'m Body) -> Vec<Self> {
        let sections = body.section_of_elements();
        let blocks = body.mesh.blocks.iter();
        let kinds: Vec<CellKind> = blocks
            .flat_map(|block| std::iter::repeat_n(block.kind, block.len()))
            .collect();
        let part = |section: usize| {
            let is_in = |at: usize| sections.get(at).map_or(0, |of| *of as usize) == section;
            let own = kinds.iter().enumerate().filter(|(at, _)| is_in(*at));
            Part {
                name: match section.checked_sub(1) {
                    None => format!("body `{}`", body.name),
                    Some(at) => {
                        let set = &body.sections[at].set;
                        format!("section `{set}` of body `{}`", body.name)
                    }
                },
                material: body.material_of(section),
                formulation: body.formulation_of(section),
                density: body.density_of(section),
                kinds: own.map(|(_, kind)| *kind).collect(),
            }
        };
        body.used_sections().into_iter().map(part).collect()
    }

    /// Poisson's ratio at rest.
    pub(super) fn poissons_ratio(&self) -> f64 {
        self.material.lame_constants().poissons_ratio()
    }

    /// Young's modulus at rest.
    pub(super) fn youngs_modulus(&self) -> f64 {
        self.material.lame_constants().youngs_modulus()
    }
}

/// Smallest and largest Young's modulus of a body at rest.
pub(super) fn moduli(body: &Body) -> [f64; 2] {
    let parts = Part::all(body).into_iter();
    let moduli = parts.map(|part| part.youngs_modulus());
    moduli.fold([f64::INFINITY, 0.0], |[least, most], modulus| {
        [least.min(modulus), most.max(modulus)]
    })
}
