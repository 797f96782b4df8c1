//! Materials of the elements of a body: the body's own material, or that of a section.
//!
//! Sections are counted from 1 in their order; 0 is the body itself, outside of all sections. The
//! internal variables of the quadrature points of a body are stored in one list, by element and
//! point; the number of variables per point is that of the element's material. Directions of fibres
//! are stored there, too.

use std::ops::Range;

use striae_element::{ElementFault, Elements};
use striae_law::bulk::{LameConstants, Material};
use striae_mesh::{ElementId, Face};

use crate::model::{Body, BodySection, Formulation};

/// Sections and places of the variables of the elements of a body.
#[derive(Clone, Debug)]
pub struct Composition {
    /// Section of every element; empty where the body has none.
    sections: Vec<u32>,
    /// First variable of every element, and the number of all; empty where there are none.
    first_variables: Vec<usize>,
    materials: Materials,
    resistances: Vec<Resistance>,
}

/// Materials of all elements of a body.
#[derive(Clone, Debug)]
pub(crate) struct Materials {
    /// Sections that have elements.
    used: Vec<usize>,
    /// Shear modulus at rest of the stiffest material.
    stiffest_shear: f64,
}

impl Materials {
    /// Materials of a body.
    pub(crate) fn of(body: &Body) -> Self {
        let used = body.used_sections();
        let shear = used.iter();
        let shear = shear.map(|section| body.material_of(*section).lame_constants().shear);
        Self {
            stiffest_shear: shear.fold(0.0, f64::max),
            used,
        }
    }
}

/// Stiffness and mass of an element, which resist its motion.
#[derive(Clone, Copy, Debug)]
pub struct Resistance {
    /// Mean of the diagonal of its stiffness at rest, `(lambda + 2 G)/n sum_ga w |G_a|^2`.
    pub stiffness: f64,
    /// Its mass.
    pub mass: f64,
}

impl Composition {
    /// Composition of a body, or of the part that a rank has, with its reference elements.
    pub(crate) fn new(body: &Body, elements: &Elements, materials: Materials) -> Self {
        let sections = body.section_of_elements();
        let counts = elements.iter().enumerate().map(|(at, element)| {
            let section = sections.get(at).map_or(0, |section| *section as usize);
            body.material_of(section).variables() * element.points()
        });
        let mut first_variables = vec![0];
        let mut sum = 0;
        first_variables.extend(counts.map(|count| {
            sum += count;
            sum
        }));
        if sum == 0 {
            first_variables.clear();
        }
        let resistances = elements.iter().enumerate().map(|(at, element)| {
            let section = sections.get(at).map_or(0, |section| *section as usize);
            let constants = body.material_of(section).lame_constants();
            let modulus = constants.lambda + 2.0 * constants.shear;
            Resistance {
                stiffness: modulus * element.stiffness_per_modulus(),
                mass: body.density_of(section) * element.volume(),
            }
        });
        Self {
            resistances: resistances.collect(),
            sections,
            first_variables,
            materials,
        }
    }

    /// Resistance of every element to motion.
    pub fn resistances(&self) -> &[Resistance] {
        &self.resistances
    }

    /// Shear modulus at rest of the stiffest material of the whole body.
    pub fn stiffest_shear(&self) -> f64 {
        self.materials.stiffest_shear
    }

    /// Numbers of the sections of which the whole body has elements, see
    /// [`Body::used_sections`].
    pub fn used_sections(&self) -> &[usize] {
        &self.materials.used
    }

    /// Number of internal variables of all points together.
    pub fn variable_count(&self) -> usize {
        self.first_variables.last().copied().unwrap_or(0)
    }

    /// Section of an element, 0 where it is of the body's own material.
    pub fn section(&self, element: ElementId) -> usize {
        let section = self.sections.get(element.index());
        section.map_or(0, |section| *section as usize)
    }

    /// Places of the variables of an element among those of the body.
    pub fn variables(&self, element: ElementId) -> Range<usize> {
        match self.first_variables.get(element.index()..) {
            Some([first, end, ..]) => *first..*end,
            _ => 0..0,
        }
    }
}

impl Body {
    /// Names of what points of a body remember that is written with the results.
    pub fn remembered(&self) -> Vec<String> {
        self.remembered_in(&self.used_sections())
    }

    /// Names of the internal variables of points in some sections.
    pub(crate) fn remembered_in(&self, sections: &[usize]) -> Vec<String> {
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
    pub(crate) fn elements(&self) -> Result<Elements, ElementFault> {
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
