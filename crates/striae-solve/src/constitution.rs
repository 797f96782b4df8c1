//! Materials of the elements of a problem, and internal variables of their points.

use striae_element::{Driven, Element};
use striae_law::bulk::Material;
use striae_mesh::{ElementId, Vec3};

use crate::{problem::Problem, state::State};
use striae_model::actuation::SectionActuation;

impl Problem {
    /// Material of an element of a body.
    pub fn material(&self, body: usize, element: ElementId) -> &Material {
        let section = self.compositions[body].section(element);
        self.model.bodies[body].material_of(section)
    }

    /// Variables of all points of a body that has not been deformed.
    pub fn rest(&self, body: usize) -> Vec<f64> {
        let mut variables = vec![0.0; self.compositions[body].variable_count()];
        let mesh = &self.model.bodies[body].mesh;
        for (at, element) in self.elements[body].iter().enumerate() {
            let id = ElementId::new(at);
            let material = self.material(body, id);
            let places = self.compositions[body].variables(id);
            if places.is_empty() || material.fibres().is_empty() {
                continue;
            }
            let corners = mesh.element_positions(id);
            let middle = corners.iter().sum::<Vec3>() / corners.len() as f64;
            let rest = material.rest(&middle).repeat(element.points());
            variables[places].copy_from_slice(&rest);
        }
        variables
    }

    /// Mass per reference volume of an element of a body.
    pub fn density(&self, body: usize, element: ElementId) -> f64 {
        let section = self.compositions[body].section(element);
        self.model.bodies[body].density_of(section)
    }

    /// Names of what points of a body remember that is written with the results, on whatever
    /// rank they are.
    pub fn names_remembered(&self, body: usize) -> Vec<String> {
        let sections = self.compositions[body].used_sections();
        self.model.bodies[body].remembered_in(sections)
    }

    /// Mean over each element of a body of what its points remember under a name; zero in
    /// elements whose material does not remember it.
    pub fn remembered(&self, state: &State, body: usize, name: &str) -> Vec<f64> {
        let model = &self.model.bodies[body];
        let variable = |section: usize| {
            let fields = model.material_of(section).fields();
            let found = fields.iter().find(|field| field.name == name);
            found.map(|field| field.variable)
        };
        let variables: Vec<Option<usize>> = (0..=model.sections.len()).map(variable).collect();
        let composition = &self.compositions[body];
        let elements = self.elements[body].iter().enumerate();
        let mean = |(at, element): (usize, Element)| {
            let id = ElementId::new(at);
            let own = &state.histories[body][composition.variables(id)];
            let variable = variables[composition.section(id)];
            variable.map_or(0.0, |variable| element.mean(own, variable))
        };
        elements.map(mean).collect()
    }

    /// Material of an element of a body with its actuation, and the variables of its points.
    pub fn made_of<'a>(
        &'a self,
        state: &'a State,
        body: usize,
        element: ElementId,
    ) -> (Driven<'a>, &'a [f64]) {
        let composition = &self.compositions[body];
        let variables = &state.histories[body][composition.variables(element)];
        let actuation = state.actuations.of(body, composition.section(element));
        let material = self.material(body, element);
        (
            SectionActuation::drive(actuation, material, variables),
            variables,
        )
    }
}
