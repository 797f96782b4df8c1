//! Strain and tension that steps give to bodies.

use striae_model::{Actuation, ActuationKind};

use super::Writer;
use super::value::{list, number, text, vector};

impl<'m> Writer<'m> {
    /// An actuation of a step.
    pub(super) fn actuation(&mut self, one: &'m Actuation) -> String {
        let body = &self.model.bodies[one.body.0];
        let section = match one.section {
            None => String::new(),
            Some(0) => {
                let part = format!("body `{}`", body.name);
                self.refuse(part, "only its elements in no section are actuated");
                String::new()
            }
            Some(at) => format!(", section = {}", text(&body.sections[at - 1].set)),
        };
        let kind = match &one.kind {
            ActuationKind::Strain(strain) => {
                let components = [(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (2, 0)];
                let components = components.map(|at| number(strain[at]));
                format!("strain = {}", list(components.into_iter()))
            }
            ActuationKind::FibreStrain(strain) => {
                format!("stretch = {}, along = \"fibres\"", number(*strain))
            }
            ActuationKind::Thermal {
                expansion,
                temperature,
            } => format!(
                "thermal_expansion = {}, temperature = {}",
                number(*expansion),
                number(*temperature)
            ),
            ActuationKind::FibreTension(tension) => {
                format!("tension = {}, along = \"fibres\"", number(*tension))
            }
            ActuationKind::Tension { along, value } => {
                format!("tension = {}, along = {}", number(*value), vector(along))
            }
        };
        let (name, curve) = (text(&body.name), self.curve(&one.curve));
        format!("{{ body = {name}{section}, {kind}{curve} }}")
    }
}
