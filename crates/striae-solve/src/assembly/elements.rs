//! Elements in the system: responses on all threads, while those before are added in
//! the order of the mesh, so that sums do not depend on the number of threads.

use rayon::prelude::*;
use std::ops::Range;
use striae_linalg::OutsidePattern;
use striae_mesh::{ElementId, NodeId};

use super::{Fault, System, Trial, ties::Slot};
use crate::{
    element::{ElementError, ElementFault, ElementResponse},
    outcome::CutBack,
    problem::Problem,
};

/// Elements whose responses are kept at a time: few enough for the cache.
const CHUNK: usize = 128;

/// Sums over all elements.
#[derive(Default)]
struct Sums {
    energy: f64,
    square_of_forces: f64,
}

impl System<'_> {
    /// Internal forces and stiffness; returns the stored energy.
    pub(super) fn elements(&mut self, trial: &Trial) -> Result<f64, Fault> {
        let problem = self.context.problem;
        let mut sums = Sums::default();
        for (body, elements) in problem.elements.iter().enumerate() {
            let count = elements.len();
            let chunk = |start: usize| start.min(count)..(start + CHUNK).min(count);
            let buffer = || vec![ElementResponse::default(); CHUNK.min(count)];
            let (mut ready, mut next) = (buffer(), buffer());
            let mut results = respond(problem, body, trial, chunk(0), &mut ready);
            for start in (0..count).step_by(CHUNK) {
                let (added, following) = rayon::join(
                    || self.add_elements(body, start, &mut ready, &results, &mut sums),
                    || respond(problem, body, trial, chunk(start + CHUNK), &mut next),
                );
                added?;
                results = following;
                std::mem::swap(&mut ready, &mut next);
            }
        }
        self.force_scale = sums.square_of_forces.sqrt();
        Ok(sums.energy)
    }

    /// Adds the elements of a body from `start` on.
    fn add_elements(
        &mut self,
        body: usize,
        start: usize,
        responses: &mut [ElementResponse],
        results: &[Result<(), ElementError>],
        sums: &mut Sums,
    ) -> Result<(), Fault> {
        let problem = self.context.problem;
        let model = &problem.model.bodies[body];
        for ((at, response), result) in (start..).zip(responses).zip(results) {
            result.map_err(|error| {
                Fault::CutBack(CutBack::InvertedElement {
                    body: model.name.clone(),
                    element: ElementFault {
                        element: ElementId::new(at),
                        error,
                    },
                })
            })?;
            sums.energy += response.energy;
            let nodes = model.mesh.elements[at].map(|n: NodeId| problem.node(body, n));
            let mass = (model.density > 0.0).then(|| problem.mass(body, at));
            self.weigh(&nodes, mass.as_ref(), response);
            sums.square_of_forces += response.force.iter().map(|f| f * f).sum::<f64>();
            self.add_response(&nodes, response)
                .map_err(|_| Fault::Pattern(vec![self.clique(&nodes)]))?;
        }
        Ok(())
    }

    /// Adds force and stiffness of an element, leaving out prescribed rows.
    fn add_response(
        &mut self,
        nodes: &[usize; 8],
        response: &ElementResponse,
    ) -> Result<(), OutsidePattern> {
        let (force, stiffness) = (&response.force, &response.stiffness);
        if nodes.iter().any(|&node| self.tie(node).is_some()) {
            let unknowns: [usize; 24] =
                std::array::from_fn(|at| self.layout.position(nodes[at / 3]) + at % 3);
            return self.add_dense(nodes, &unknowns, force, &stiffness.by_rows());
        }
        for (&node, force) in nodes.iter().zip(force.chunks_exact(3)) {
            let first = self.layout.position(node);
            let residual = &mut self.residual[first..first + 3];
            residual
                .iter_mut()
                .zip(force)
                .for_each(|(sum, f)| *sum += f);
        }
        let fixed = nodes.map(|node| &self.context.fixed[3 * node..3 * node + 3]);
        let members = nodes.map(|node| self.layout.supervariable(node));
        self.matrix.add_blocks(&members, |a, b| {
            let mut block = stiffness.between(a, b);
            for (row, is_fixed) in block.iter_mut().zip(fixed[a]) {
                if *is_fixed {
                    *row = [0.0; 3];
                }
            }
            block
        })
    }

    /// Adds a square block of position unknowns, leaving out prescribed rows.
    pub(super) fn add_dense(
        &mut self,
        nodes: &[usize],
        unknowns: &[usize],
        force: &[f64],
        tangent: &[f64],
    ) -> Result<(), OutsidePattern> {
        for (unknown, force) in unknowns.iter().zip(force) {
            self.residual[*unknown] += force;
        }
        let is_fixed = |node: &usize| self.context.fixed[3 * node..3 * node + 3].contains(&true);
        let is_plain = |node: &usize| self.tie(*node).is_none() && !is_fixed(node);
        if nodes.iter().all(is_plain) {
            return self.matrix.add(unknowns, unknowns, tangent);
        }
        let slots = unknowns.iter().enumerate().map(|(at, &unknown)| Slot {
            unknown,
            position: Some((nodes[at / 3], at % 3)),
            against: None,
        });
        let slots: Vec<Slot> = slots.collect();
        self.add_rows(&slots, &slots, tangent)
    }
}

/// Responses of some elements of a body, written over older ones.
fn respond(
    problem: &Problem,
    body: usize,
    trial: &Trial,
    range: Range<usize>,
    responses: &mut [ElementResponse],
) -> Vec<Result<(), ElementError>> {
    let model = &problem.model.bodies[body];
    let count = range.len();
    responses[..count]
        .par_iter_mut()
        .zip(range)
        .with_min_len(8)
        .map(|(response, at)| {
            let corners = &model.mesh.elements[at];
            let x = corners.map(|n| trial.positions[problem.node(body, n)]);
            problem.elements[body][at].respond(&x, &model.material, response)
        })
        .collect()
}
