//! Elements in the system: responses on all threads, while those before are added in
//! the order of the mesh, so that sums do not depend on the number of threads.

use rayon::prelude::*;
use std::ops::Range;
use striae_contact::segment::Derivatives;
use striae_element::{ElementBlock, ElementError, ElementFault, ElementResponse, Stiffness};
use striae_law::bulk::Past;
use striae_mesh::{ElementId, MAX_CORNERS, NodeId, Vec3};
use striae_sparse::OutsidePattern;

use super::{Fault, System, Trial, ties::Slot};
use crate::{outcome::CutBack, problem::Problem, state::State};

/// Elements whose responses are kept at a time: few enough for the cache.
const CHUNK: usize = 128;

/// Sums over all elements.
#[derive(Default)]
struct Sums {
    of_bodies: OfBodies,
    square_of_forces: f64,
}

/// What bodies store, lose and come to.
#[derive(Clone, Debug, Default)]
pub struct OfBodies {
    /// Stored energy.
    pub strain: f64,
    /// Energy that has been dissipated since the last converged state.
    pub dissipated: f64,
    /// What their quadrature points have come to, as in [`State::histories`].
    pub histories: Vec<Vec<f64>>,
}

impl System<'_> {
    /// Internal forces and stiffness.
    pub(super) fn elements(
        &mut self,
        trial: &Trial,
        state: &State,
        elapsed: f64,
    ) -> Result<OfBodies, Fault> {
        let problem = self.context.problem;
        let mut sums = Sums::default();
        for (body, elements) in problem.elements.iter().enumerate() {
            let variables = state.histories[body].as_slice();
            let room = Vec::with_capacity(variables.len());
            sums.of_bodies.histories.push(room);
            for (first, block) in elements.blocks() {
                let place = Place {
                    body,
                    first,
                    block,
                    variables,
                    elapsed,
                };
                self.block(&place, trial, &mut sums)?;
            }
        }
        self.force_scale = sums.square_of_forces.sqrt();
        Ok(sums.of_bodies)
    }

    /// The elements of a block.
    fn block(&mut self, place: &Place, trial: &Trial, sums: &mut Sums) -> Result<(), Fault> {
        let problem = self.context.problem;
        let count = place.block.count();
        let material = &problem.model.bodies[place.body].material;
        let empty = ElementResponse::zero(place.block, material);
        let chunk = |start: usize| start.min(count)..(start + CHUNK).min(count);
        let buffer = || vec![empty.clone(); CHUNK.min(count)];
        let (mut ready, mut next) = (buffer(), buffer());
        let mut results = respond(problem, place, trial, chunk(0), &mut ready);
        for start in (0..count).step_by(CHUNK) {
            let (added, following) = rayon::join(
                || self.add_elements(place, start, &mut ready, &results, sums),
                || respond(problem, place, trial, chunk(start + CHUNK), &mut next),
            );
            added?;
            results = following;
            std::mem::swap(&mut ready, &mut next);
        }
        Ok(())
    }

    /// Adds the elements of a block from `start` on.
    fn add_elements(
        &mut self,
        place: &Place,
        start: usize,
        responses: &mut [ElementResponse],
        results: &[Result<(), ElementError>],
        sums: &mut Sums,
    ) -> Result<(), Fault> {
        let problem = self.context.problem;
        let model = &problem.model.bodies[place.body];
        for ((at, response), result) in (start..).zip(responses).zip(results) {
            let element = ElementId::new(place.first + at);
            result.map_err(|error| {
                Fault::CutBack(CutBack::InvertedElement {
                    body: model.name.clone(),
                    element: ElementFault { element, error },
                })
            })?;
            sums.of_bodies.strain += response.energy;
            sums.of_bodies.dissipated += response.dissipated;
            sums.of_bodies.histories[place.body].extend_from_slice(&response.variables);
            let corners = model.mesh.corners(element);
            let mut nodes = [0; MAX_CORNERS];
            let nodes = globals(problem, place.body, corners, &mut nodes);
            let density = problem.density(place.body, element);
            let mass = (density > 0.0).then(|| problem.mass(place.body, element));
            self.weigh(nodes, mass.as_ref(), response);
            let forces = response.force.as_flattened().iter();
            sums.square_of_forces += forces.map(|f| f * f).sum::<f64>();
            self.add_response(nodes, response)
                .map_err(|_| Fault::Pattern(vec![self.clique(nodes)]))?;
        }
        Ok(())
    }

    /// Adds force and stiffness of an element, leaving out prescribed rows.
    fn add_response(
        &mut self,
        nodes: &[usize],
        response: &ElementResponse,
    ) -> Result<(), OutsidePattern> {
        if self.derivatives == Derivatives::None {
            self.add_force(nodes, response);
            return Ok(());
        }
        let stiffness = &response.stiffness;
        let tied = nodes.iter().any(|&node| self.tie(node).is_some());
        match (tied, nodes.len()) {
            (false, 4) => self.add_stiffness::<4>(nodes, stiffness),
            (false, 5) => self.add_stiffness::<5>(nodes, stiffness),
            (false, 6) => self.add_stiffness::<6>(nodes, stiffness),
            (false, 8) => self.add_stiffness::<8>(nodes, stiffness),
            (false, 10) => self.add_stiffness::<10>(nodes, stiffness),
            _ => {
                let (unknowns, tangent) = (self.unknowns(nodes), stiffness.by_rows());
                let force = response.force.as_flattened();
                return self.add_dense(nodes, &unknowns, force, &tangent);
            }
        }?;
        self.add_force(nodes, response);
        Ok(())
    }

    /// Adds the force of an element.
    fn add_force(&mut self, nodes: &[usize], response: &ElementResponse) {
        for (&node, force) in nodes.iter().zip(&response.force) {
            let first = self.layout.position(node);
            let residual = self.residual[first..first + 3].iter_mut();
            residual.zip(force).for_each(|(sum, f)| *sum += f);
        }
    }

    /// Adds the stiffness of an element with `N` corners, none of them tied.
    fn add_stiffness<const N: usize>(
        &mut self,
        nodes: &[usize],
        stiffness: &Stiffness,
    ) -> Result<(), OutsidePattern> {
        let fixed: [_; N] = std::array::from_fn(|a| {
            let first = 3 * nodes[a];
            &self.context.fixed[first..first + 3]
        });
        let members: [_; N] = std::array::from_fn(|a| self.layout.supervariable(nodes[a]));
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

    /// The position unknowns of nodes.
    pub(super) fn unknowns(&self, nodes: &[usize]) -> Vec<usize> {
        let first = nodes.iter().map(|&node| self.layout.position(node));
        first.flat_map(|first| first..first + 3).collect()
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
        if self.derivatives == Derivatives::None {
            return Ok(());
        }
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

/// A block of elements and where it belongs.
struct Place<'a> {
    body: usize,
    /// First element in the mesh.
    first: usize,
    block: &'a dyn ElementBlock,
    /// Variables of the body at the last converged state.
    variables: &'a [f64],
    /// Time since then.
    elapsed: f64,
}

/// Responses of some elements of a block, written over older ones.
fn respond(
    problem: &Problem,
    place: &Place,
    trial: &Trial,
    range: Range<usize>,
    responses: &mut [ElementResponse],
) -> Vec<Result<(), ElementError>> {
    let &Place {
        body,
        first,
        block,
        variables,
        elapsed,
    } = place;
    let model = &problem.model.bodies[body];
    let composition = &problem.compositions[body];
    responses[..range.len()]
        .par_iter_mut()
        .zip(range)
        .with_min_len(8)
        .map(|(response, at)| {
            let element = ElementId::new(first + at);
            let material = problem.material(body, element);
            let variables = &variables[composition.variables(element)];
            let past = Past { variables, elapsed };
            let corners = model.mesh.corners(element);
            let mut x = [Vec3::zeros(); MAX_CORNERS];
            for (x, node) in x.iter_mut().zip(corners) {
                *x = trial.positions[problem.node(body, *node)];
            }
            response.make_room(block, material);
            block.respond(at, &x[..corners.len()], material, past, response)
        })
        .collect()
}

/// Global numbers of corners, in the room given.
fn globals<'a>(
    problem: &Problem,
    body: usize,
    corners: &[NodeId],
    room: &'a mut [usize; MAX_CORNERS],
) -> &'a [usize] {
    for (node, corner) in room.iter_mut().zip(corners) {
        *node = problem.node(body, *corner);
    }
    &room[..corners.len()]
}
