//! Elements in the system, batch by batch: responses of one on all threads, while those of
//! the one before are added by the owners of the rows, in the order of the mesh, so that sums
//! do not depend on the number of threads. A batch with tied nodes, or such that are prescribed
//! in axes of their own, is added by one thread.

use rayon::prelude::*;
use std::{ops::Range, sync::Arc};
use striae_contact::segment::Derivatives;
use striae_element::{ElementBlock, ElementError, ElementFault, ElementResponse, Stiffness};
use striae_law::bulk::Past;
use striae_mesh::{ElementId, MAX_CORNERS, NodeId, Vec3};
use striae_sparse::{CliquePlaces, Member, MemberRows, Supervariable};

use super::{
    ElementPlaces, Imposed, StepContext, System, Trial,
    inertia::{Inertia, Share},
    scatter::{Part, Slot},
};
use crate::{outcome::CutBack, problem::Problem, state::State};
use striae_model::{
    actuation::{Actuations, SectionActuation},
    node::GlobalNode,
};

/// Sums of the contributions of elements at a supervariable.
#[derive(Clone, Copy, Default)]
struct AtNode {
    residual: Vec3,
    internal: Vec3,
    weight: Vec3,
    inertia: Vec3,
    /// `true` if the rows of the matrix are still those of another state.
    is_stale: bool,
}

/// Sums over all elements.
#[derive(Default)]
struct Sums {
    of_bodies: OfBodies,
    square_of_forces: f64,
}

/// Energies, losses and internal variables of the bodies.
#[derive(Clone, Debug, Default)]
pub struct OfBodies {
    /// Stored energy.
    pub strain: f64,
    /// Energy that has been dissipated since the last converged state.
    pub dissipated: f64,
    /// New internal variables of their quadrature points, as in [`State::histories`].
    pub histories: Vec<Vec<f64>>,
}

impl System<'_> {
    /// Internal forces and stiffness, replacing the previous ones.
    pub(super) fn elements(
        &mut self,
        places: &ElementPlaces,
        trial: &Trial,
        state: &State,
        imposed: &Imposed,
    ) -> Result<OfBodies, CutBack> {
        let problem = self.context.problem;
        let mut sums = Sums::default();
        let nothing = AtNode {
            is_stale: self.derivatives == Derivatives::First,
            ..AtNode::default()
        };
        let mut at_nodes = vec![nothing; self.matrix.structure().supervariables()];
        for (body, elements) in problem.elements.iter().enumerate() {
            let variables = state.histories[body].as_slice();
            let room = Vec::with_capacity(variables.len());
            sums.of_bodies.histories.push(room);
            for (number, (first, block)) in elements.blocks().enumerate() {
                let place = Place {
                    body,
                    first,
                    block,
                    places: places.of_block(body, number),
                    variables,
                    elapsed: imposed.flowing(),
                    actuations: &imposed.actuations,
                };
                self.block(&place, trial, &mut at_nodes, &mut sums)?;
            }
        }
        self.clear_stale(&mut at_nodes);
        self.take_from_nodes(&at_nodes);
        self.square_of_forces = sums.square_of_forces;
        Ok(sums.of_bodies)
    }

    /// The elements of a block.
    fn block(
        &mut self,
        place: &Place,
        trial: &Trial,
        at_nodes: &mut [AtNode],
        sums: &mut Sums,
    ) -> Result<(), CutBack> {
        let (context, inertia) = (self.context, Arc::clone(&self.inertia));
        let material = &context.problem.model.bodies[place.body].material;
        let empty = Share::new(ElementResponse::zero(place.block, material));
        let batches: Vec<Range<usize>> = place.places.batches().collect();
        let largest = batches.first().map_or(0, Range::len);
        let buffer = || vec![empty.clone(); largest];
        let (mut ready, mut next) = (buffer(), buffer());
        let batch = |at: usize| batches.get(at).cloned().unwrap_or(0..0);
        let respond = |at: usize, shares: &mut [Share]| {
            shares_of(context, &inertia, place, trial, batch(at), shares)
        };
        let mut results = respond(0, &mut ready);
        for at in 0..batches.len() {
            let (added, following) = rayon::join(
                || self.add_elements(place, at, &ready, &results, at_nodes, sums),
                || respond(at + 1, &mut next),
            );
            added?;
            results = following;
            std::mem::swap(&mut ready, &mut next);
        }
        Ok(())
    }

    /// Adds a batch of the elements of a block.
    fn add_elements(
        &mut self,
        place: &Place,
        batch: usize,
        shares: &[Share],
        results: &[Result<(), ElementError>],
        at_nodes: &mut [AtNode],
        sums: &mut Sums,
    ) -> Result<(), CutBack> {
        let problem = self.context.problem;
        let places = place.places;
        let range = places.batches().nth(batch).unwrap_or(0..0);
        for ((at, share), result) in range.clone().zip(shares).zip(results) {
            result.map_err(|error| CutBack::InvertedElement {
                body: problem.model.bodies[place.body].name.clone(),
                element: ElementFault {
                    element: problem
                        .share
                        .whole_element(place.body, ElementId::new(place.first + at)),
                    error,
                },
            })?;
            let response = &share.response;
            sums.of_bodies.strain += response.energy;
            sums.of_bodies.dissipated += response.dissipated;
            sums.of_bodies.histories[place.body].extend_from_slice(&response.variables);
            sums.square_of_forces += share.square_of_forces;
        }
        if range.clone().all(|at| self.is_plain_element(place, at)) {
            let (first, fixed, acts) = (range.start, &self.context.fixed, self.inertia.acts());
            let derivatives = self.derivatives;
            let add = |member: Member, mut rows: MemberRows, at_node: &mut AtNode| {
                let share = &shares[member.clique - first];
                at_node.add(share, member.slot, acts);
                if derivatives == Derivatives::First {
                    // Cleared only now, they are in the cache when they are added to.
                    if std::mem::take(&mut at_node.is_stale) {
                        rows.clear();
                    }
                    let node = member.supervariable.0;
                    add_rows(rows, share, member.slot, &fixed[3 * node..3 * node + 3]);
                }
            };
            self.matrix.add_batch(places, batch, at_nodes, add);
            return Ok(());
        }
        self.clear_stale(at_nodes);
        for (at, share) in range.zip(shares) {
            self.add_element(place, at, share, at_nodes)?;
        }
        Ok(())
    }

    /// Returns whether an element of a block has a place and no tied or turned nodes.
    fn is_plain_element(&self, place: &Place, at: usize) -> bool {
        let problem = self.context.problem;
        let element = ElementId::new(place.first + at);
        let corners = problem.model.bodies[place.body].mesh.corners(element);
        let is_bound = |node: &NodeId| self.is_bound(problem.node(place.body, *node));
        let any = !self.ties.is_empty()
            || problem.ties.joins(place.body)
            || !self.context.turned.is_empty();
        place.places.has_place(at) && !(any && corners.iter().any(is_bound))
    }

    /// Adds an element, which may have tied or turned nodes.
    fn add_element(
        &mut self,
        place: &Place,
        at: usize,
        share: &Share,
        at_nodes: &mut [AtNode],
    ) -> Result<(), CutBack> {
        let problem = self.context.problem;
        let element = ElementId::new(place.first + at);
        let corners = problem.model.bodies[place.body].mesh.corners(element);
        let mut nodes = [GlobalNode(0); MAX_CORNERS];
        let nodes = globals(problem, place.body, corners, &mut nodes);
        for (slot, &node) in nodes.iter().enumerate() {
            at_nodes[node].add(share, slot, self.inertia.acts());
        }
        if self.derivatives == Derivatives::None {
            return Ok(());
        }
        if !self.is_plain_element(place, at) {
            let (unknowns, tangent) = (self.unknowns(nodes), share.response.stiffness.by_rows());
            self.add_square(nodes, &unknowns, &tangent);
            return Ok(());
        }
        for (slot, &node) in nodes.iter().enumerate() {
            let rows = self.matrix.rows_of_member(place.places, (at, slot));
            add_rows(rows, share, slot, &self.context.fixed[node.components()]);
        }
        Ok(())
    }

    /// Clears the rows of the matrix that are still those of another state.
    fn clear_stale(&mut self, at_nodes: &mut [AtNode]) {
        let rows = at_nodes.iter_mut().enumerate();
        let stale = rows.filter_map(|(at, sums)| {
            std::mem::take(&mut sums.is_stale).then_some(Supervariable(at))
        });
        self.matrix.clear_rows(stale);
    }

    fn take_from_nodes(&mut self, at_nodes: &[AtNode]) {
        for node in self.context.problem.global_nodes() {
            let (first, sums) = (self.layout.position(node), &at_nodes[node]);
            self.residual[first..first + 3].copy_from_slice(sums.residual.as_slice());
            self.forces.internal[node] = sums.internal;
            self.forces.applied[node] = sums.weight;
            self.forces.inertia[node] = sums.inertia;
        }
    }

    /// The position unknowns of nodes.
    pub(super) fn unknowns(&self, nodes: &[GlobalNode]) -> Vec<usize> {
        let first = nodes.iter().map(|&node| self.layout.position(node));
        first.flat_map(|first| first..first + 3).collect()
    }

    /// Adds a square block of position unknowns, leaving out prescribed rows.
    pub(super) fn add_dense(
        &mut self,
        nodes: &[GlobalNode],
        unknowns: &[usize],
        force: &[f64],
        tangent: &[f64],
    ) {
        for (unknown, force) in unknowns.iter().zip(force) {
            self.residual[*unknown] += force;
        }
        self.add_square(nodes, unknowns, tangent);
    }

    /// Adds a tangent without a force.
    fn add_square(&mut self, nodes: &[GlobalNode], unknowns: &[usize], tangent: &[f64]) {
        let is_fixed = |node: &GlobalNode| self.context.fixed[node.components()].contains(&true);
        let is_plain = |node: &GlobalNode| !self.is_bound(*node) && !is_fixed(node);
        if self.derivatives == Derivatives::None {
            return;
        }
        if nodes.iter().all(is_plain) {
            let added = self.matrix.add(unknowns, unknowns, tangent);
            return added.expect("elements are in the pattern of the bodies");
        }
        let slots = unknowns.iter().enumerate().map(|(at, &unknown)| Slot {
            unknown,
            position: Some((nodes[at / 3], at % 3)),
            against: None,
        });
        let slots: Vec<Slot> = slots.collect();
        self.add_rows(Part::Bodies, &slots, &slots, tangent);
    }
}

/// A block of elements and where it belongs.
struct Place<'a> {
    body: usize,
    /// First element in the mesh.
    first: usize,
    block: &'a dyn ElementBlock,
    places: &'a CliquePlaces,
    /// Variables of the body at the last converged state.
    variables: &'a [f64],
    /// Time since then.
    elapsed: f64,
    actuations: &'a Actuations,
}

/// Contributions of some elements of a block, which overwrite older ones.
fn shares_of(
    context: &StepContext,
    inertia: &Inertia,
    place: &Place,
    trial: &Trial,
    range: Range<usize>,
    shares: &mut [Share],
) -> Vec<Result<(), ElementError>> {
    let &Place { body, block, .. } = place;
    let problem = context.problem;
    let model = &problem.model.bodies[body];
    let composition = &problem.compositions[body];
    shares[..range.len()]
        .par_iter_mut()
        .zip(range)
        .with_min_len(8)
        .map(|(share, at)| {
            let element = ElementId::new(place.first + at);
            let material = problem.material(body, element);
            let past = Past {
                variables: &place.variables[composition.variables(element)],
                elapsed: place.elapsed,
            };
            let mut nodes = [GlobalNode(0); MAX_CORNERS];
            let nodes = globals(problem, body, model.mesh.corners(element), &mut nodes);
            let mut x = [Vec3::zeros(); MAX_CORNERS];
            for (x, node) in x.iter_mut().zip(nodes) {
                *x = trial.positions[*node];
            }
            let response = &mut share.response;
            response.make_room(block, material);
            let actuation = place.actuations.of(body, composition.section(element));
            let driven = SectionActuation::drive(actuation, material, past.variables);
            block.respond(at, &x[..nodes.len()], &driven, past, response)?;
            let mass = problem.masses[body].of_element(element);
            inertia.weigh(nodes, mass, context, share);
            Ok(())
        })
        .collect()
}

impl AtNode {
    /// Adds what an element adds at a corner; weight and inertia if they act.
    fn add(&mut self, share: &Share, corner: usize, acts: bool) {
        self.residual += Vec3::from(share.response.force[corner]);
        self.internal += share.internal[corner];
        if acts {
            self.weight += share.weight[corner];
            self.inertia += share.inertia[corner];
        }
    }
}

/// Adds the stiffness of an element to the rows of a corner, but for those that are fixed.
fn add_rows(rows: MemberRows, share: &Share, corner: usize, fixed: &[bool]) {
    let stiffness = &share.response.stiffness;
    match share.response.force.len() {
        4 => add_rows_of::<4>(rows, stiffness, corner, fixed),
        5 => add_rows_of::<5>(rows, stiffness, corner, fixed),
        6 => add_rows_of::<6>(rows, stiffness, corner, fixed),
        8 => add_rows_of::<8>(rows, stiffness, corner, fixed),
        corners => {
            assert_eq!(corners, MAX_CORNERS, "elements have so many corners");
            add_rows_of::<MAX_CORNERS>(rows, stiffness, corner, fixed);
        }
    }
}

fn add_rows_of<const N: usize>(
    mut rows: MemberRows,
    stiffness: &Stiffness,
    corner: usize,
    fixed: &[bool],
) {
    let derivatives = stiffness.rows::<N>(corner);
    for (row, blocks) in derivatives.iter().enumerate() {
        if !fixed[row] {
            rows.add(row, blocks);
        }
    }
}

/// Global numbers of corners, in the room given.
fn globals<'a>(
    problem: &Problem,
    body: usize,
    corners: &[NodeId],
    room: &'a mut [GlobalNode; MAX_CORNERS],
) -> &'a [GlobalNode] {
    for (node, corner) in room.iter_mut().zip(corners) {
        *node = problem.node(body, *corner);
    }
    &room[..corners.len()]
}
