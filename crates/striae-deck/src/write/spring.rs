//! Springs and dashpots.

use striae_model::{SpringEnd, SpringLine, SpringRest};

use super::Writer;
use super::value::{direction, number, text, vector};

impl Writer<'_> {
    /// Springs.
    pub(super) fn spring(&mut self, at: usize) -> String {
        let spring = &self.model.springs[at];
        let a = self.spring_end(&spring.a);
        let line = match &spring.line {
            SpringLine::To(end) => format!("b = {{ {} }}", self.spring_end(end)),
            SpringLine::ToPoint(point) => format!("b = {{ fixed = {} }}", vector(point)),
            SpringLine::Along(unit) => format!("direction = {}", vector(&direction(unit))),
        };
        let rest = match spring.rest {
            SpringRest::Slack => String::new(),
            SpringRest::Length(length) => format!("free_length = {}\n", number(length)),
            SpringRest::Preload(tension) => format!("preload = {}\n", number(tension)),
        };
        let (stiffness, damping) = (number(spring.stiffness), number(spring.damping));
        format!(
            "\n[[spring]]\nname = {}\na = {{ {a} }}\n{line}\nstiffness = {stiffness}\ndamping = {damping}\n{rest}",
            text(&spring.name)
        )
    }

    fn spring_end(&mut self, end: &SpringEnd) -> String {
        match end {
            SpringEnd::Nodes { body, nodes } => {
                let set = self.meshes.nodes(*body, "", nodes);
                let body = &self.model.bodies[body.0].name;
                format!("body = {}, nodes = {}", text(body), text(&set))
            }
            SpringEnd::Rigid { rigid, point } => {
                let rigid = &self.model.rigid_surfaces[rigid.0].name;
                format!("rigid = {}, point = {}", text(rigid), vector(point))
            }
        }
    }
}
