//! Sections of a body: materials, formulations and densities of its elements.
//!
//! Sections are counted from 1 in their order; 0 is the body itself, outside of all sections.

use striae_element::{ElementFault, Elements};
use striae_law::bulk::{LameConstants, Material};
use striae_mesh::{ElementId, Face};

use crate::model::{Body, BodySection, Formulation};

impl Body {
    /// Names of what points of a body remember that is written with the results.
    pub fn remembered(&self) -> Vec<String> {
        self.remembered_in(&self.used_sections())
    }

    /// Names of the internal variables of points in some sections.
    pub fn remembered_in(&self, sections: &[usize]) -> Vec<String> {
        let mut names = Vec::new();
        for &section in sections {
            for field in self.material_of(section).fields() {
                if !names.contains(&field.name) {
                    names.push(field.name);
                }
            }
        }
        names
    }

    /// Section of every element; empty where the body has none.
    pub fn section_of_elements(&self) -> Vec<u32> {
        if self.sections.is_empty() {
            return Vec::new();
        }
        let mut sections = vec![0; self.mesh.element_count()];
        for (number, section) in (1..).zip(&self.sections) {
            for element in &section.elements {
                sections[element.index()] = number;
            }
        }
        sections
    }

    /// The reference elements, each of its section's formulation.
    pub fn elements(&self) -> Result<Elements, ElementFault> {
        let sections = self.section_of_elements();
        let section = |element: usize| sections.get(element).map_or(0, |at| *at as usize);
        let formulation = |element: ElementId| self.formulation_of(section(element.index()));
        Elements::of_sections(&self.mesh, formulation)
    }

    /// Material of a section, counted from 1; 0 is the body's own.
    pub fn material_of(&self, section: usize) -> &Material {
        self.part(section).map_or(&self.material, |of| &of.material)
    }

    /// Formulation of a section, counted from 1; 0 is the body's own.
    pub fn formulation_of(&self, section: usize) -> Formulation {
        self.part(section)
            .map_or(self.formulation, |of| of.formulation)
    }

    /// Density of a section, counted from 1; 0 is the body's own.
    pub fn density_of(&self, section: usize) -> f64 {
        self.part(section).map_or(self.density, |of| of.density)
    }

    /// Numbers of the sections that have elements, the body's own material being 0.
    pub fn used_sections(&self) -> Vec<usize> {
        let own = self.section_of_elements();
        let uses_own = own.is_empty() || own.contains(&0);
        let first = usize::from(!uses_own);
        (first..=self.sections.len()).collect()
    }

    /// Young's modulus at rest behind faces; where they differ in it, that of the mean
    /// compliance, `sum A / sum A/E`.
    pub fn modulus_at(&self, faces: &[Face]) -> f64 {
        let sections = self.section_of_elements();
        let (mut areas, mut compliances) = (0.0, 0.0);
        let mut range = [f64::INFINITY, 0.0_f64];
        for face in faces {
            let section = sections.get(face.element.index());
            let material = self.material_of(section.map_or(0, |at| *at as usize));
            let LameConstants { lambda, shear } = material.lame_constants();
            let modulus = shear * (3.0 * lambda + 2.0 * shear) / (lambda + shear);
            let area = self.mesh.area_vector(*face).norm();
            range = [range[0].min(modulus), range[1].max(modulus)];
            areas += area;
            compliances += area / modulus;
        }
        if range[0] == range[1] {
            range[0]
        } else {
            areas / compliances
        }
    }

    /// Returns whether it has mass.
    pub fn has_mass(&self) -> bool {
        let used = self.used_sections();
        used.iter().any(|section| self.density_of(*section) > 0.0)
    }

    fn part(&self, section: usize) -> Option<&BodySection> {
        let index = section.checked_sub(1)?;
        self.sections.get(index)
    }
}
