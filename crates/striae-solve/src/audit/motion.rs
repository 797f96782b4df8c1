//! Bodies that jump.
//!
//! If friction or an edge cannot hold a body any more, rows of contact may have a solution far from
//! where it was. Without inertia the middle of a body moves with its loads, or against them as far
//! as something that is prescribed drives it, or strain that is released. It jumps where it moves
//! further than all that is prescribed and than half a facet, the loads lose work by that, and
//! contact, which has none, pays for it: the energy of contact falls by half of that work or more.

use striae_mesh::Vec3;

use super::Jump;
use crate::{assembly::StepContext, state::State};
use striae_model::Procedure;

/// Way over the facet size, and part of the work of the loads that contact pays, from which on a
/// motion is a jump.
const LEAST: f64 = 0.5;

/// Ratio of the motion to the longest prescribed one from which on a body jumps: released strain
/// may add to the drive.
const FURTHER: f64 = 1.5;

/// The body that jumps furthest in an increment, if one does; collective.
pub fn jump(context: &StepContext, before: &State, after: &State) -> Option<Jump> {
    let problem = context.problem;
    let paid = before.energies.contact - after.energies.contact;
    if problem.model.steps[context.index].procedure != Procedure::QuasiStatic || paid <= 0.0 {
        return None;
    }
    let bodies = problem.model.bodies.len();
    let (ways, loads) = (
        means(context, before, after),
        loads(context, [before, after]),
    );
    let driven = driven(context, before, after);
    let jumps = (0..bodies).filter_map(|body| {
        let way = ways[body].norm();
        let work = -ways[body].dot(&loads[body]);
        let is_one = way > FURTHER * driven
            && way > LEAST * facet_size(context, body)?
            && paid > LEAST * work;
        (is_one && work > 0.0).then_some(Jump { body, way, driven })
    });
    jumps.max_by(|a, b| a.way.total_cmp(&b.way))
}

/// Mean way of every body; collective.
fn means(context: &StepContext, before: &State, after: &State) -> Vec<Vec3> {
    let problem = context.problem;
    let sums = (0..problem.model.bodies.len()).map(|body| {
        let nodes = problem
            .nodes_of(body)
            .filter(|node| problem.share.owns(*node));
        nodes
            .map(|node| after.positions[node] - before.positions[node])
            .sum()
    });
    let mut sums: Vec<Vec3> = sums.collect();
    problem.share.sum_vectors(&mut sums);
    let counts = (0..sums.len()).map(|body| {
        let nodes = problem
            .nodes_of(body)
            .filter(|node| problem.share.owns(*node));
        problem.share.sum(nodes.count() as f64)
    });
    let counts: Vec<f64> = counts.collect();
    sums.iter()
        .zip(counts)
        .map(|(sum, count)| sum / count.max(1.0))
        .collect()
}

/// Mean loads on every body in an increment; collective.
fn loads(context: &StepContext, ends: [&State; 2]) -> Vec<Vec3> {
    let problem = context.problem;
    let sums = (0..problem.model.bodies.len()).map(|body| {
        let nodes = problem
            .nodes_of(body)
            .filter(|node| problem.share.owns(*node));
        let of_node = |node| {
            ends.map(|state| state.forces.applied[node])
                .iter()
                .sum::<Vec3>()
        };
        nodes.map(of_node).sum::<Vec3>() * 0.5
    });
    let mut sums: Vec<Vec3> = sums.collect();
    problem.share.sum_vectors(&mut sums);
    sums
}

/// The longest way that is prescribed, of nodes or of rigid bodies; collective.
fn driven(context: &StepContext, before: &State, after: &State) -> f64 {
    let problem = context.problem;
    let nodes = problem.own_nodes().map(|node| {
        let way = after.positions[node] - before.positions[node];
        context.prescribed_part(node, &way).norm()
    });
    let rigid = after
        .rigid
        .iter()
        .zip(&before.rigid)
        .zip(&context.fixed_rigid);
    let rigid = rigid.map(|((after, before), fixed)| {
        let way = after.displacement - before.displacement;
        length(way, |axis| fixed[axis])
    });
    problem
        .share
        .largest(nodes.chain(rigid).fold(0.0, f64::max))
}

/// Length of the part of a way that is prescribed.
fn length(way: Vec3, fixed: impl Fn(usize) -> bool) -> f64 {
    Vec3::from_fn(|axis, _| if fixed(axis) { way[axis] } else { 0.0 }).norm()
}

/// The largest facet size of the contact surfaces of a body at rest; `None` without any.
fn facet_size(context: &StepContext, body: usize) -> Option<f64> {
    let problem = context.problem;
    let sizes = problem.pairs.iter().flat_map(|pair| {
        let sides = pair.contact.deformable_sides().iter();
        let own = sides.filter(|side| pair.bodies[**side] == Some(body));
        own.filter_map(|&side| {
            let surface = pair.contact.sides[side].surface()?;
            let place = |node: &striae_mesh::NodeId| problem.reference[problem.node(body, *node)];
            let x: Vec<Vec3> = surface.nodes().iter().map(place).collect();
            let size = |corners: &[striae_surface::node::SurfaceNode; 4]| {
                let [a, b, c, d] = corners.map(|corner| x[corner]);
                (0.5 * (c - a).cross(&(d - b)).norm()).sqrt()
            };
            surface.facets().iter().map(size).reduce(f64::max)
        })
    });
    sizes.reduce(f64::max)
}
