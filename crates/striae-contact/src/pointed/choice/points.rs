//! Which points of rigid surfaces are pointed.
//!
//! A point pierces if it lies deeper than [`PIERCED`] in a facet that
//!
//! - stands back from it by more than [`SHARP`] in the mean, where the point is of a sharp edge, or
//! - is open in the mean and without pressure, so that nothing else feels the point.
//!
//! A facet on a smooth rigid surface of radius `R` stands back by `h^2/(12 R)`: for `R > 4 h`,
//! it closes before the point is inside by `PIERCED`.
//!
//! Where the field presses, a point that is not sharp, or that the facet does not stand back
//! from by as much, is left to the mean down to [`DEEP`] of the smallest facet size around.
//! From there on its row keeps it at the depth [`LEFT`], if the facet stands back by more than
//! half of `SHARP`. Were it pushed out, the force would start with a jump: the facet on a round
//! body stands back mostly by its tilt, and what lies lightly on it would hop off.
//!
//! One facet gets one new point at a time, the deepest, and points keep a distance of
//! [`APART`](super::APART) of the facet size from each other: more than the facets can follow
//! would leave the pressures undetermined. For the same reason they keep it from pointed nodes.
//! A node next to a vertex that pierces its facet is inside the rigid surface, too; with
//! rows for both, a large pressure of one would stand against tension of the other. Nor does
//! distance alone help where two nodes of an edge are pointed and a point is on that edge: three
//! rows would determine two positions. What pointed nodes hold by a share `sum N_J` of more than
//! `HELD` is left alone down to [`DEEP`], too, and kept at [`LEFT`] from there on.
//!
//! A point leaves when its facet has closed in the mean and the field presses there, so that
//! its load has somewhere to go.

use rayon::prelude::*;
use striae_mesh::{FacetId, Vec3};
use striae_surface::{facet::Shape, node::SurfaceNode};

use super::{CLOSING, PIERCED, SHARP, are_apart, is_pressed};
use crate::{
    configuration::Configuration,
    pairing::{Scope, paired_facets},
    pointed::ridge::{Bend, candidates},
    projection::Hit,
    segment::SegmentDerivatives,
    selection::{Selection, compliances},
    side::Side,
    spot::{Spot, faced},
    tip::{RigidPoint, RigidPoints, Tip},
    unknowns::NodeResult,
};

/// Depth from which a rigid point under pressure is felt, over the smallest facet size around.
pub const DEEP: f64 = 0.08;

/// Depth that is left to it then.
pub const LEFT: f64 = 0.07;

/// Share of pointed nodes in a place on a facet from which they hold it: what is left of the
/// facet would move by four times as much as the place.
const HELD: f64 = 0.75;

/// A rigid point in a facet.
struct Inside {
    point: RigidPoint,
    bend: Bend,
    hit: Hit,
    /// Mean of the sizes at the corners.
    size: f64,
    /// The least of them.
    least: f64,
}

impl Inside {
    /// Depth that its row would leave to it, given the mean gap of the facet and the share by
    /// which pointed nodes hold the place; `None` where others feel it.
    fn left(&self, mean: Option<f64>, is_pressed: bool, held: f64) -> Option<f64> {
        let is_deep = self.hit.gap < -DEEP * self.least;
        let kept = Some(LEFT * self.least);
        if held > HELD {
            return kept.filter(|_| is_deep);
        }
        let Some(mean) = mean else {
            return Some(0.0);
        };
        let stands_back = (mean - self.hit.gap) / self.size;
        let is_sharp = self.bend == Bend::Sharp && stands_back > SHARP;
        if is_sharp || !is_pressed && mean > 0.0 {
            return Some(0.0);
        }
        kept.filter(|_| is_deep && stands_back > 0.5 * SHARP)
    }
}

/// Points of a rigid side that pierce a facet, the deepest of every facet.
pub(super) fn pierced(
    configuration: &Configuration,
    selection: &Selection,
    carried: &[Vec<[f64; 3]>; 2],
    least: Bend,
) -> Vec<(SurfaceNode, RigidPoint)> {
    if selection.points.is_empty() {
        return Vec::new();
    }
    let mut deep: Vec<Inside> = candidates(configuration, selection.depth)
        .into_par_iter()
        .with_min_len(16)
        .filter(|(_, bend)| *bend >= least)
        .filter_map(|(point, bend)| in_facet(configuration, point, bend, selection.depth))
        .filter(|inside| inside.hit.gap < -PIERCED * inside.size)
        .collect();
    if deep.is_empty() {
        return Vec::new();
    }
    let means = facet_gaps(configuration, selection.scope());
    deep.retain_mut(|inside| {
        let facet = inside.hit.facet;
        let is_pressed = is_pressed(configuration, carried, facet);
        let held = held(configuration, selection, &inside.hit);
        let left = inside.left(means[facet.index()], is_pressed, held);
        inside.point = inside.point.leaving(left.unwrap_or_default());
        left.is_some()
    });
    let share = |inside: &Inside| inside.hit.gap / inside.size;
    deep.sort_by(|a, b| share(a).total_cmp(&share(b)));
    let mut taken = felt(configuration, selection);
    let mut lodged = selection.points.clone();
    let mut facets: Vec<FacetId> = Vec::new();
    let mut points = Vec::new();
    for inside in &deep {
        let x = inside.point.position(configuration);
        if facets.contains(&inside.hit.facet) || !are_apart(&taken, &x, inside.size) {
            continue;
        }
        let Some(node) = lodging(configuration, &lodged, &inside.hit) else {
            continue;
        };
        lodged[node] = Some(inside.point);
        taken.push(x);
        facets.push(inside.hit.facet);
        points.push((node, inside.point));
    }
    points
}

/// Where rigid points and nodes of side `a` are that are pointed already.
fn felt(configuration: &Configuration, selection: &Selection) -> Vec<Vec3> {
    let own = configuration.side(Side::A);
    let points = selection.points.iter().flatten();
    let points = points.map(|point| point.position(configuration));
    let nodes =
        (0..own.x.len()).filter(|&node| selection.is_pointed(Side::A, SurfaceNode::new(node)));
    points.chain(nodes.map(|node| own.x[node])).collect()
}

/// Share of pointed nodes in a place on a facet.
fn held(configuration: &Configuration, selection: &Selection, hit: &Hit) -> f64 {
    let corners = configuration.side(Side::A).corners(hit.facet);
    let weights = Shape::of(&corners).weights(hit.xi, hit.eta).value;
    let pointed = corners.iter().zip(weights);
    let pointed = pointed.filter(|(corner, _)| selection.is_pointed(Side::A, **corner));
    pointed.map(|(_, weight)| weight).sum()
}

/// The facet that a rigid point is in or faces.
fn in_facet(
    configuration: &Configuration,
    point: RigidPoint,
    bend: Bend,
    depth: f64,
) -> Option<Inside> {
    let tip = Tip::Rigid(point);
    let hit = faced(configuration, tip, tip.reach(configuration) + depth)?;
    let own = configuration.side(Side::A);
    let sizes = own.corners(hit.facet).map(|node| own.sizes[node]);
    Some(Inside {
        point,
        bend,
        hit,
        size: 0.25 * sizes.iter().sum::<f64>(),
        least: sizes.into_iter().fold(f64::INFINITY, f64::min),
    })
}

/// The corner of the facet that is nearest to a point and lodges none yet.
fn lodging(configuration: &Configuration, lodged: &RigidPoints, hit: &Hit) -> Option<SurfaceNode> {
    let corners = configuration.side(Side::A).corners(hit.facet);
    let weights = Shape::of(&corners).weights(hit.xi, hit.eta).value;
    let free = (0..4).filter(|&at| lodged[corners[at]].is_none());
    let nearest = free.max_by(|&a, &b| weights[a].total_cmp(&weights[b]));
    nearest.map(|at| corners[at])
}

/// A rigid point that stays, with the node that it lodged with and the one that it will.
pub struct Stay {
    /// Node before.
    pub from: SurfaceNode,
    /// Node from now on: a corner of the facet that the point is in.
    pub to: SurfaceNode,
    /// The point.
    pub point: RigidPoint,
}

/// Rigid points of a converged configuration that are pointed in the next increment too.
pub fn staying(
    configuration: &Configuration,
    points: &RigidPoints,
    nodes: &[Vec<NodeResult>; 2],
    carried: &[Vec<[f64; 3]>; 2],
) -> Vec<Stay> {
    if points.iter().all(Option::is_none) {
        return Vec::new();
    }
    let compliances = compliances(configuration);
    let scope = Scope {
        compliances: &compliances,
        depth: 0.0,
    };
    let gaps = facet_gaps(configuration, scope);
    let pressure = |node: SurfaceNode| nodes[1][node].pressure;
    let numbered = points.iter().enumerate();
    let mut pressed: Vec<(SurfaceNode, RigidPoint, Hit)> = numbered
        .filter_map(|(node, point)| {
            let hit = Spot::new(configuration, Tip::Rigid((*point)?))?.hit?;
            Some((SurfaceNode::new(node), (*point)?, hit))
        })
        .filter(|(node, ..)| pressure(*node) > 0.0)
        .collect();
    // What several carry that leave at once is more than others can take in an increment.
    let closed = pressed.iter().filter(|(node, point, hit)| {
        let is_closed = |gap| gap <= CLOSING * configuration.size(Side::B, *node);
        point.left == 0.0
            && gaps[hit.facet.index()].is_some_and(is_closed)
            && is_pressed(configuration, carried, hit.facet)
    });
    let leaving = closed.map(|(node, ..)| *node);
    let leaving = leaving.min_by(|&a, &b| pressure(a).total_cmp(&pressure(b)));
    pressed.retain(|(node, ..)| Some(*node) != leaving);
    let mut lodged: RigidPoints = vec![None; points.len()];
    let is_at = |hit: &Hit, node: SurfaceNode| {
        configuration
            .side(Side::A)
            .corners(hit.facet)
            .contains(&node)
    };
    let (at_home, away): (Vec<_>, Vec<_>) = pressed
        .into_iter()
        .partition(|(node, _, hit)| is_at(hit, *node));
    let mut stays = Vec::new();
    for (from, point, hit) in at_home.into_iter().chain(away) {
        let to = if is_at(&hit, from) {
            Some(from)
        } else {
            lodging(configuration, &lodged, &hit)
        };
        if let Some(to) = to {
            lodged[to] = Some(point);
            stays.push(Stay { from, to, point });
        }
    }
    stays
}

/// Mean gap over the segments of every facet of side `a`.
fn facet_gaps(configuration: &Configuration, scope: Scope) -> Vec<Option<f64>> {
    let mut sums = vec![[0.0; 2]; configuration.side(Side::A).surface.facets().len()];
    for paired in paired_facets(configuration, scope, &|_| SegmentDerivatives::None, |_| {
        true
    }) {
        if let Some(facet) = paired.facets[0] {
            let [gap, area] = &mut sums[facet.index()];
            *gap += paired.mean_gap(configuration) * paired.segment.area;
            *area += paired.segment.area;
        }
    }
    let mean = |[gap, area]: [f64; 2]| (area > 0.0).then(|| gap / area);
    sums.into_iter().map(mean).collect()
}
