//! Materials of the elements of a body: the body's own material, or that of a section.
//!
//! Sections are counted from 1 in their order; 0 is the body itself, outside of all sections. The
//! internal variables of the quadrature points of a body are stored in one list, by element and
//! point; the number of variables per point is that of the element's material. Directions of fibres
//! are stored there, too.

use std::ops::Range;

use striae_element::Elements;

use striae_mesh::ElementId;

use striae_model::Body;

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
pub struct Materials {
    /// Sections that have elements.
    used: Vec<usize>,
    /// Shear modulus at rest of the stiffest material.
    stiffest_shear: f64,
}

impl Materials {
    /// Materials of a body.
    pub fn of(body: &Body) -> Self {
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
    pub fn new(body: &Body, elements: &Elements, materials: Materials) -> Self {
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
