//! Surfaces that look away from each other, judged where they are nearest.
//!
//! Nodes within a facet size of the smallest distance are compared with the nearest point of
//! the other side:
//!
//! ```text
//! n . n_other < -.2   the node faces the other side
//! n . n_other >  .2   it looks away
//! ```
//!
//! A side turned inside out has nodes of the second kind only. Farther nodes do not count,
//! as the far half of a closed surface looks away from everything. Sides that consist of faces are
//! not judged: each node looks for what faces it, and some faces of a skin always look away.

use striae_contact::{
    interference::{Stage, nearest_of},
    side::Side,
};
use striae_mesh::{NodeId, Vec3};
use striae_surface::node::SurfaceNode;

use super::{Reference, surface_node};
use crate::model::{Model, PairId};

/// Cosine between the normals of points that face each other, and of points that do not.
const FACING: f64 = -0.2;
const AWAY: f64 = 0.2;

/// A node that looks away from the other side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Turned {
    /// Side of the node.
    pub side: Side,
    /// Node of the mesh.
    pub node: NodeId,
    /// Position of the node.
    pub at: Vec3,
}

/// The nearest node of a pair whose sides look away from each other; `None` where some nodes
/// face each other.
pub fn turned(model: &Model, pair: PairId) -> Option<Turned> {
    if model.pairs[pair.0].feature_angle.is_some() {
        return None;
    }
    let reference = Reference::new(model, pair)?;
    let (side, node, at) = reference.at(model, |stage| {
        let seen: Vec<Seen> = Side::BOTH
            .into_iter()
            .filter(|&side| stage.configuration.sides[side].is_some())
            .flat_map(|side| of_side(stage, side))
            .collect();
        let least = seen.iter().map(|seen| seen.distance);
        let least = least.fold(f64::INFINITY, f64::min);
        let near = || {
            seen.iter()
                .filter(|seen| seen.distance <= least + seen.size)
        };
        if near().any(|seen| seen.cosine < FACING) {
            return None;
        }
        let away = near().filter(|seen| seen.cosine > AWAY);
        let first = away.min_by(|a, b| a.distance.total_cmp(&b.distance))?;
        let x = stage.configuration.side(first.side).x[first.node];
        Some((first.side, first.node, x))
    })?;
    let node = surface_node(model, pair, side, SurfaceNode::new(node))?;
    Some(Turned { side, node, at })
}

/// A node and the nearest point of the other side.
struct Seen {
    side: Side,
    node: usize,
    distance: f64,
    cosine: f64,
    /// Local facet size.
    size: f64,
}

fn of_side(stage: &Stage, side: Side) -> Vec<Seen> {
    if stage.configuration.pair.is_in_one_body() {
        return Vec::new();
    }
    let own = stage.configuration.side(side);
    let nodes = own.x.iter().zip(&own.normals).zip(&own.sizes).enumerate();
    let seen = nodes.filter_map(|(node, ((x, normal), size))| {
        let (distance, other) = match stage.configuration.plane() {
            Some((point, n)) => ((x - point).dot(&n).abs(), n),
            None => {
                let nearest = nearest_of(stage.configuration.side(side.opposite()), x)?;
                (nearest.distance, nearest.normal)
            }
        };
        Some(Seen {
            side,
            node,
            distance,
            cosine: normal.dot(&other),
            size: *size,
        })
    });
    seen.collect()
}
