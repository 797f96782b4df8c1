//! Lifted rows: mean gaps that are kept open where their nodes would lie too deep.
//!
//! A weighted row holds the mean gap over the facets around its node. Where these are tilted
//! by the angle `t` against the other side, at edges and corners above all, the node itself
//! is inside by `h tan(t)/3` while that mean is zero. The row of a kept node that a converged
//! increment leaves deeper than [`DEEP`] of the facet size `h` is *lifted* by a length `L_k`:
//! with the pressure `p_k` it states
//!
//! ```text
//! g_k - L_k >= 0,   p_k >= 0,   p_k (g_k - L_k) = 0
//! ```
//!
//! `L_k` is frozen like the roles, so row and force stay adjoint. It follows the depth `d_k`
//! of the node down to [`LEFT`],
//!
//! ```text
//! L_k <- max(0, L_k + 2/3 (d_k - .07 h))
//! ```
//!
//! as the mean gap over two facets that meet at an edge is 2/3 of the gap there, if the gap at
//! their far ends stays. Lifts go on so at the start of every increment and fade as facets lie
//! down. A row that is open has its mean gap as the first `L_k`.
//!
//! `h` is the larger facet size of the two sides, which is how finely a mean gap sees.

use rayon::prelude::*;
use striae_surface::node::SurfaceNode;

use crate::{
    configuration::Configuration,
    pair::Enforcement,
    pointed::choice::{OwnGap, own_gap},
    selection::{Lifts, Selection},
    side::Side,
    unknowns::{NodeResult, Status},
};

/// Depth over the facet size from which the row of a node is lifted.
pub const DEEP: f64 = 0.08;

/// Depth over the facet size down to which it is.
pub const LEFT: f64 = 0.07;

/// Mean gap over that at the edge where two tilted facets meet.
const MEAN: f64 = 2.0 / 3.0;

/// What holds the nodes that a converged configuration leaves too deep.
#[derive(Clone, Debug, PartialEq)]
pub struct Remedy {
    /// Lifts of the rows of kept nodes.
    pub lifts: Lifts,
    /// Nodes that follow others and are to be kept first, with their sides.
    pub required: Vec<(Side, SurfaceNode)>,
}

/// What holds the nodes that a converged configuration leaves too deep; `None` if there is
/// no such node.
pub fn remedy(
    configuration: &Configuration,
    selection: &Selection,
    nodes: &[Vec<NodeResult>; 2],
) -> Option<Remedy> {
    // Overlaps of meshes that are being pressed out are meant.
    if configuration.pair.enforcement != Enforcement::Weighted || selection.has_offsets() {
        return None;
    }
    let mut remedy = Remedy {
        lifts: Side::BOTH.map(|side| {
            let nodes = SurfaceNode::all(selection.nodes(side));
            nodes.map(|node| selection.lift(side, node)).collect()
        }),
        required: Vec::new(),
    };
    let mut is_deep = false;
    for &side in configuration.pair.deformable_sides() {
        let in_field = |node: SurfaceNode| selection.carries(side, node);
        for Depth { node, depth, size } in depths(configuration, side, in_field) {
            if selection.is_pointed(side, node) || depth <= DEEP * size {
                continue;
            }
            is_deep = true;
            if !selection.is_kept(side, node) {
                remedy.required.push((side, node));
                continue;
            }
            let result = &nodes[side][node];
            let mean = match result.status {
                Status::Open => result.gap.max(0.0),
                Status::Stick | Status::Slip => 0.0,
            };
            remedy.lifts[side][node] += mean + MEAN * (depth - LEFT * size);
        }
    }
    is_deep.then_some(remedy)
}

/// Lifts of the increment that starts from a configuration.
pub fn following(configuration: &Configuration, before: &Lifts) -> Lifts {
    let mut lifts = before.each_ref().map(|side| vec![0.0; side.len()]);
    for &side in configuration.pair.deformable_sides() {
        let before = |node: SurfaceNode| before[side].get(node.index()).copied().unwrap_or(0.0);
        for Depth { node, depth, size } in depths(configuration, side, |node| before(node) > 0.0) {
            let lift = before(node) + MEAN * (depth - LEFT * size);
            lifts[side][node] = lift.max(0.0);
        }
    }
    lifts
}

/// Where a node is.
struct Depth {
    node: SurfaceNode,
    /// Depth in the other side, negative outside.
    depth: f64,
    /// The larger facet size of the two sides.
    size: f64,
}

/// Depths of the nodes of a side that are wanted and see the other side.
fn depths(
    configuration: &Configuration,
    side: Side,
    is_wanted: impl Fn(SurfaceNode) -> bool + Sync,
) -> Vec<Depth> {
    let depth = |node: SurfaceNode| {
        let OwnGap { gap, sizes } = own_gap(configuration, side, node)?;
        Some(Depth {
            node,
            depth: -gap,
            size: sizes[0].max(sizes[1]),
        })
    };
    let nodes = (0..configuration.side(side).x.len()).into_par_iter();
    let nodes = nodes.with_min_len(16).map(SurfaceNode::new);
    let wanted = nodes.filter(|&node| is_wanted(node));
    wanted.filter_map(depth).collect()
}
