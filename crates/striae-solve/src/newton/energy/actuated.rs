//! Work of actuation, by the rates of the stored energy at both ends of an increment.

use rayon::prelude::*;
use striae_mesh::{ElementId, Vec3};

use super::{Ends, mean};
use crate::problem::Problem;
use striae_model::actuation::{Actuations, SectionActuation};

/// The bodies at one end of an increment.
struct End<'a> {
    problem: &'a Problem,
    positions: &'a [Vec3],
    histories: &'a [Vec<f64>],
    actuations: &'a Actuations,
}

impl Ends<'_> {
    /// Work of actuation in the increment; collective.
    pub(super) fn actuated(&self) -> f64 {
        let [from, to] = [&self.state.actuations, &self.imposed.actuations];
        if from == to {
            return 0.0;
        }
        let (problem, change) = (self.context.problem, to.minus(from));
        let start = End {
            problem,
            positions: &self.state.positions,
            histories: &self.state.histories,
            actuations: from,
        };
        let end = End {
            problem,
            positions: &self.trial.positions,
            histories: &self.assembled.bodies.histories,
            actuations: to,
        };
        let [start, end] = [start, end].map(|end| end.work(&change));
        problem.share.sum(mean(self.averaged_weight(), start, end))
    }
}

impl End<'_> {
    /// Rate of the stored energy by a change of actuation, times that change.
    fn work(&self, change: &Actuations) -> f64 {
        let bodies = 0..self.problem.elements.len();
        let of_body = |body: usize| -> f64 {
            let elements: Vec<_> = self.problem.elements[body].iter().enumerate().collect();
            let works: Vec<f64> = (elements.par_iter().with_min_len(8))
                .map(|(at, element)| {
                    let id = ElementId::new(*at);
                    self.of_element(body, id, element, change)
                })
                .collect();
            works.iter().sum()
        };
        bodies.map(of_body).sum()
    }

    /// Work of an element; both ends of an increment can be evaluated.
    fn of_element(
        &self,
        body: usize,
        id: ElementId,
        element: &striae_element::Element,
        change: &Actuations,
    ) -> f64 {
        let composition = &self.problem.compositions[body];
        let section = composition.section(id);
        let Some(change) = change.of(body, section) else {
            return 0.0;
        };
        let material = self.problem.material(body, id);
        let variables = &self.histories[body][composition.variables(id)];
        let corners = self.problem.model.bodies[body].mesh.corners(id);
        let nodes = self.problem.nodes(body, corners).into_iter();
        let x: Vec<Vec3> = nodes.map(|node| self.positions[node]).collect();
        let actuation = self.actuations.of(body, section);
        let driven = SectionActuation::drive(actuation, material, variables);
        let change = change.of_element(material, variables);
        element.work(&x, driven, variables, &change).unwrap_or(0.0)
    }
}
