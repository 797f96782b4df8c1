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
//!
//! Surfaces that look away may still be turned to each other by a motion. They are back to back
//! where a whole facet looks away and lies over the other side, not beside its edge as one half of
//! a hinge does.

use striae_contact::{
    initial::Fit,
    interference::{Stage, Standing, nearest_of},
    side::Side,
};
use striae_mesh::{NodeId, Vec3};
use striae_surface::{node::SurfaceNode, topology::distinct_corners};

use super::{Reference, may_meet, surface_node};
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
    /// Cosine of the angle between the normals there.
    pub cosine: f64,
}

/// The nearest node of a pair whose sides look away from each other; `None` where some nodes
/// face each other.
pub fn turned(model: &Model, pair: PairId) -> Option<Turned> {
    found(model, pair, |_, seen| {
        let near = near(seen);
        let faces = near.clone().any(Seen::faces);
        let away = near.filter(|seen| seen.cosine > AWAY);
        if faces { None } else { nearest(away) }
    })
}

/// A node of a pair whose sides look away from each other and cannot touch: they are back to back
/// and touch now, or no motion can bring them together.
pub fn back_to_back(model: &Model, pair: PairId, fit: &Fit) -> Option<Turned> {
    turned(model, pair)?;
    found(model, pair, |stage, seen| {
        let of = |side: Side| {
            let own = stage.configuration.sides[side].as_ref()?;
            let mut away = vec![None; own.x.len()];
            for seen in seen.iter().filter(|seen| seen.side == side) {
                let is_over = seen.standing != Standing::Beside;
                away[seen.node] = Some(seen).filter(|seen| is_over && seen.cosine > AWAY);
            }
            let facets = own.surface.facets().iter();
            nearest(facets.filter_map(|facet| {
                let corners = distinct_corners(facet).iter();
                let corners: Option<Vec<&Seen>> = corners.map(|node| away[node.index()]).collect();
                nearest(corners?.into_iter())
            }))
        };
        let away = nearest(Side::BOTH.into_iter().filter_map(of))?;
        let touches = away.distance <= away.size;
        (touches || !may_meet(model, pair, fit)).then_some(away)
    })
}

/// A node of a pair whose sides overlap where neither faces the other.
pub fn askew(model: &Model, pair: PairId) -> Option<Turned> {
    found(model, pair, |_, seen| {
        let behind = seen.iter().filter(|seen| seen.standing == Standing::Behind);
        let crossing = near(seen).chain(behind);
        let faces = crossing.clone().any(Seen::faces);
        if faces { None } else { nearest(crossing) }
    })
}

/// A node that is found among those of both sides.
fn found(
    model: &Model,
    pair: PairId,
    find: impl for<'a> FnOnce(&Stage, &'a [Seen]) -> Option<&'a Seen>,
) -> Option<Turned> {
    if model.pairs[pair.0].feature_angle.is_some() {
        return None;
    }
    let reference = Reference::new(model, pair)?;
    let (found, at) = reference.at(model, |stage| {
        let sides = stage.configuration.sides.each_ref();
        let seen: Vec<Seen> = Side::BOTH
            .into_iter()
            .filter(|&side| sides[side].is_some())
            .flat_map(|side| of_side(stage, side))
            .collect();
        let found = *find(stage, &seen)?;
        Some((found, stage.configuration.side(found.side).x[found.node]))
    })?;
    let node = surface_node(model, pair, found.side, SurfaceNode::new(found.node))?;
    Some(Turned {
        side: found.side,
        node,
        at,
        cosine: found.cosine,
    })
}

/// Nodes within a facet size of the smallest distance.
fn near(seen: &[Seen]) -> impl Iterator<Item = &Seen> + Clone {
    let least = seen.iter().map(|seen| seen.distance);
    let least = least.fold(f64::INFINITY, f64::min);
    seen.iter()
        .filter(move |seen| seen.distance <= least + seen.size)
}

fn nearest<'a>(seen: impl Iterator<Item = &'a Seen>) -> Option<&'a Seen> {
    seen.min_by(|a, b| a.distance.total_cmp(&b.distance))
}

/// A node and the nearest point of the other side.
#[derive(Clone, Copy)]
struct Seen {
    side: Side,
    node: usize,
    distance: f64,
    cosine: f64,
    standing: Standing,
    /// Local facet size.
    size: f64,
}

impl Seen {
    fn faces(&self) -> bool {
        self.cosine < FACING
    }
}

fn of_side(stage: &Stage, side: Side) -> Vec<Seen> {
    if stage.configuration.pair.is_in_one_body() {
        return Vec::new();
    }
    let own = stage.configuration.side(side);
    let nodes = own.x.iter().zip(&own.normals).zip(&own.sizes).enumerate();
    let seen = nodes.filter_map(|(node, ((x, normal), size))| {
        let (distance, other, standing) = match stage.configuration.plane() {
            Some((point, n)) => {
                let height = (x - point).dot(&n);
                let standing = match height < 0.0 {
                    true => Standing::Behind,
                    false => Standing::Front,
                };
                (height.abs(), n, standing)
            }
            None => {
                let nearest = nearest_of(stage.configuration.side(side.opposite()), x)?;
                (nearest.distance, nearest.normal, nearest.standing)
            }
        };
        Some(Seen {
            side,
            node,
            distance,
            cosine: normal.dot(&other),
            standing,
            size: *size,
        })
    });
    seen.collect()
}
