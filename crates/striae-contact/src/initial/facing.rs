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
//! as the far half of a closed surface looks away from everything.
//!
//! Surfaces that look away may still be turned to each other by a motion. They are back to back
//! where a whole facet looks away and lies over the other side, not beside its edge as one half of
//! a hinge does.

use striae_mesh::Vec3;
use striae_surface::{node::SurfaceNode, topology::distinct_corners};

use crate::{
    configuration::Configuration,
    interference::{Standing, nearest_of},
    segment::FACING,
    side::Side,
};

/// Cosine between the normals of points above which they look away from each other.
const AWAY: f64 = 0.2;

/// A node and the nearest point of the other side.
#[derive(Clone, Copy, Debug)]
pub struct Seen {
    /// Side of the node.
    pub side: Side,
    /// The node.
    pub node: SurfaceNode,
    /// Cosine of the angle between the normals there.
    pub cosine: f64,
    distance: f64,
    standing: Standing,
    /// Local facet size.
    size: f64,
}

impl Seen {
    /// Returns whether it is within a facet size of the other side.
    pub fn touches(&self) -> bool {
        self.distance <= self.size
    }

    fn faces(&self) -> bool {
        self.cosine < FACING
    }
}

/// The nearest node of sides that look away from each other; `None` where some nodes face each
/// other.
pub fn turned(configuration: &Configuration) -> Option<Seen> {
    turned_of(&seen(configuration))
}

fn turned_of(seen: &[Seen]) -> Option<Seen> {
    let near = near(seen);
    let faces = near.clone().any(Seen::faces);
    let away = near.filter(|seen| seen.cosine > AWAY);
    if faces { None } else { nearest(away) }
}

/// The nearest node of a facet that looks away, of sides that look away from each other, and lies
/// over the other side.
pub fn back_to_back(configuration: &Configuration) -> Option<Seen> {
    let seen = seen(configuration);
    turned_of(&seen)?;
    let of = |side: Side| {
        let own = configuration.sides[side].as_ref()?;
        let mut away = vec![None; own.x.len()];
        for seen in seen.iter().filter(|seen| seen.side == side) {
            let is_over = seen.standing != Standing::Beside;
            away[seen.node.index()] = Some(seen).filter(|seen| is_over && seen.cosine > AWAY);
        }
        let facets = own.surface.facets().iter();
        let facets: Vec<Seen> = facets
            .filter_map(|facet| {
                let corners = distinct_corners(facet).iter();
                let corners: Option<Vec<&Seen>> = corners.map(|node| away[node.index()]).collect();
                nearest(corners?.into_iter())
            })
            .collect();
        nearest(facets.iter())
    };
    let sides: Vec<Seen> = Side::BOTH.into_iter().filter_map(of).collect();
    nearest(sides.iter())
}

/// A node of sides that overlap where neither faces the other.
pub fn askew(configuration: &Configuration) -> Option<Seen> {
    let seen = seen(configuration);
    let behind = seen.iter().filter(|seen| seen.standing == Standing::Behind);
    let crossing = near(&seen).chain(behind);
    let faces = crossing.clone().any(Seen::faces);
    if faces { None } else { nearest(crossing) }
}

/// Nodes within a facet size of the smallest distance.
fn near(seen: &[Seen]) -> impl Iterator<Item = &Seen> + Clone {
    let least = seen.iter().map(|seen| seen.distance);
    let least = least.fold(f64::INFINITY, f64::min);
    seen.iter()
        .filter(move |seen| seen.distance <= least + seen.size)
}

fn nearest<'a>(seen: impl Iterator<Item = &'a Seen>) -> Option<Seen> {
    seen.min_by(|a, b| a.distance.total_cmp(&b.distance))
        .copied()
}

/// Nodes of both sides.
fn seen(configuration: &Configuration) -> Vec<Seen> {
    if configuration.pair.is_in_one_body() {
        return Vec::new();
    }
    let sides = configuration.sides.each_ref();
    let sides = Side::BOTH.into_iter().filter(|&side| sides[side].is_some());
    sides
        .flat_map(|side| of_side(configuration, side))
        .collect()
}

fn of_side(configuration: &Configuration, side: Side) -> Vec<Seen> {
    let own = configuration.side(side);
    let nodes = own.x.iter().zip(&own.normals).zip(&own.sizes).enumerate();
    let seen = nodes.filter_map(|(node, ((x, normal), size))| {
        let (distance, other, standing): (f64, Vec3, Standing) = match configuration.plane() {
            Some((point, n)) => {
                let height = (x - point).dot(&n);
                let standing = match height < 0.0 {
                    true => Standing::Behind,
                    false => Standing::Front,
                };
                (height.abs(), n, standing)
            }
            None => {
                let nearest = nearest_of(configuration.side(side.opposite()), x)?;
                (nearest.distance, nearest.normal, nearest.standing)
            }
        };
        Some(Seen {
            side,
            node: SurfaceNode::new(node),
            distance,
            cosine: normal.dot(&other),
            standing,
            size: *size,
        })
    });
    seen.collect()
}
