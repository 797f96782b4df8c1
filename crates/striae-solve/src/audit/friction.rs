//! Friction work at contact nodes.
//!
//! The friction traction `tau` at a kept node with the area `A` does in an increment the work
//! `A tau . du`, `du` the slip of its support. Friction takes work at every node that slips:
//! `tau . du <= 0`. The slip is the one that is seen, without what the ramp adds to the rows, by
//! which a weak node could stick while all around it slides.
//!
//! Only nodes that are pressed at both ends are checked: others may have moved before they touch. A
//! node that sticks moves by what the meshes cannot follow of each other. It counts as slipping
//! from [`LEAST_WAY`] of the facet size on; then the forces that friction needs to be wrong for are
//! no round-off.

use striae_contact::side::Side;
use striae_mesh::{NodeId, Vec3};
use striae_surface::node::SurfaceNode;

use crate::{
    interference::{Positions, configuration},
    problem::Problem,
    state::State,
};

/// Way over the facet size from which on a node slips.
const LEAST_WAY: f64 = 0.05;
/// Work that a node gains over all that friction takes or gives at the nodes of its side from which
/// on it is one that gains.
pub const LEAST_SHARE: f64 = 0.01;

/// A node that friction pushes along its slip.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gain {
    /// The pair.
    pub pair: usize,
    /// Body of the node.
    pub body: usize,
    /// The node, of the mesh of its body.
    pub node: NodeId,
    /// Work that it gains in the increment.
    pub work: f64,
    /// Ratio of this work to the sum of its magnitudes at all nodes of the side.
    pub share: f64,
}

/// The node of a pair that gains most, if one does.
pub(super) fn gain(problem: &Problem, pair: usize, states: [&State; 2]) -> Option<Gain> {
    if states[1].pairs[pair].facets.iter().all(Vec::is_empty) {
        return None;
    }
    let sides = problem.pairs[pair].contact.deformable_sides().iter();
    let found = sides.filter_map(|&side| on_side(problem, (pair, side), states));
    let worst = found.max_by(|a, b| a.share.total_cmp(&b.share))?;
    (worst.share > LEAST_SHARE).then_some(worst)
}

fn on_side(problem: &Problem, (pair, side): (usize, Side), states: [&State; 2]) -> Option<Gain> {
    let [before, after] = states;
    let at = configuration(problem, pair, Positions::from(after));
    let areas = problem.pairs[pair].areas(side, &after.pairs[pair]);
    let results = [before, after].map(|state| &state.pairs[pair].nodes[side]);
    let kept = &after.pairs[pair].kept[side];
    let nodes = results[1].iter().zip(areas).enumerate();
    let (mut all, mut worst) = (0.0, None::<(f64, SurfaceNode)>);
    for (node, (result, area)) in nodes {
        // A way before surfaces touch is none of friction.
        if !kept[node] || result.tau == Vec3::zeros() || results[0][node].pressure <= 0.0 {
            continue;
        }
        let node = SurfaceNode::new(node);
        let work = area * result.tau.dot(&result.slip);
        all += work.abs();
        let slips = result.slip.norm() > LEAST_WAY * at.side(side).sizes[node];
        if slips && worst.is_none_or(|(most, _)| work > most) {
            worst = Some((work, node));
        }
    }
    let (work, node) = worst.filter(|(work, _)| *work > 0.0)?;
    let (body, node) = problem.named_node(problem.surface_node(pair, side, node)?);
    Some(Gain {
        pair,
        body,
        node,
        work,
        share: work / all,
    })
}
