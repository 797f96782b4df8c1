//! Which nodes, and which points of rigid surfaces, are pointed.
//!
//! A node pierces if it is open, lies deeper than [`PIERCED`] of the smaller facet size, and
//! its own facets are open in the mean and stand back from it by more than [`SHARP`] of
//! their size: the mean gap minus its own. Facets tilted by the angle `t` stand back by
//! `h tan(t)/3`. A node of a smooth surface of radius `R` with a mean gap of zero is inside
//! by `h^2/(6 R)`, too, which is left to the mean: up to .07 of a facet at the shoulders of
//! coarse tyres. What is not sharp closes in the mean before it is inside by `SHARP`. Inside
//! a rigid surface of facets, which may have slopes within a facet, it is enough that the
//! facets are open by more than [`CLOSING`] in the mean and without pressure. A node stays
//! pointed while it is pressed and the mean gap is larger than [`CLOSING`].
//!
//! Where a converged state has no pressure in the pair, a node of a sharp edge that is deeper
//! than [`FIRST`] pierces, too: an edge between facets that are tilted by a few degrees stands
//! back by less than `SHARP`, and would pass into the other body unfelt. It stays pointed while
//! the field carries nothing. Nodes of smooth surfaces pierce from [`PIERCED`] on, if both bodies
//! are deformable and nothing else has been found; against rigid surfaces they have rows of
//! their own, which close at about that depth.
//!
//! A node between two deformable bodies that follows others without pressure, deeper than the
//! same limits and with its facets in the mean, is *unfelt*: the field takes it up, see
//! [`crate::roles`].
//!
//! Points of rigid surfaces are chosen in [`points`].

use rayon::prelude::*;
use striae_mesh::{FacetId, Vec3};
use striae_surface::node::SurfaceNode;

pub mod points;

use super::{Bend, ridge::bend_at};
use crate::{
    configuration::Configuration,
    pair::Enforcement,
    pairing::{Scope, paired_facets},
    segment::SegmentDerivatives,
    selection::{Kept, Selection, compliances},
    side::Side,
    spot::faced,
    tip::{RigidPoint, Tip},
    unknowns::NodeResult,
};

/// Whether the rows of a configuration are met.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Progress {
    /// Iterations go on: rows may be about to close.
    Iterating,
    /// The rows are met: what they do not feel now they will not feel.
    Converged,
}

/// Depth from which a node counts as pierced, over the smaller facet size.
pub const PIERCED: f64 = 0.02;

/// The same where nothing of the pair presses.
pub const FIRST: f64 = 0.005;

/// Mean gap of its own facets beyond its own from which it is sharp, over their size.
pub const SHARP: f64 = 0.1;

/// Mean gap of its own facets down to which a node stays pointed, over their size.
pub const CLOSING: f64 = 0.02;

/// Least distance of rigid points from each other and from pointed nodes, over the facet size.
pub const APART: f64 = 0.4;

/// Area over the square of its size from which a node can be in with its facets.
pub const COVERED: f64 = 0.1;

/// Pressure that is none, over the modulus.
const NO_PRESSURE: f64 = 1e-10;

/// Nodes, as side and number.
type Places = Vec<(Side, SurfaceNode)>;

/// What pierces the other side without being pointed yet.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Pierced {
    /// Nodes, as side and number.
    pub nodes: Vec<(Side, SurfaceNode)>,
    /// Nodes that the field is to have unknowns at, as side and number: their facets are in
    /// the other side in the mean, and no kept node feels it.
    pub unfelt: Vec<(Side, SurfaceNode)>,
    /// Points of a rigid side with the nodes that they lodge with.
    pub points: Vec<(SurfaceNode, RigidPoint)>,
}

impl Pierced {
    /// Whether there is nothing.
    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty() && self.unfelt.is_empty() && self.points.is_empty()
    }
}

/// What pierces the other side; `carried` is the field at the nodes, and points of a rigid
/// side count from the bend `least` of their edges on.
pub fn pierced(
    configuration: &Configuration,
    selection: &Selection,
    carried: &[Vec<[f64; 3]>; 2],
    least: Bend,
    progress: Progress,
) -> Pierced {
    if configuration.pair.enforcement != Enforcement::Weighted {
        return Pierced::default();
    }
    let points = points::pierced(configuration, selection, carried, least);
    let [mut nodes, unfelt] = sharp_and_unfelt(configuration, selection, carried, progress);
    let felt: Vec<Vec3> = (selection.points.iter().flatten())
        .chain(points.iter().map(|(_, point)| point))
        .map(|point| point.position(configuration))
        .collect();
    nodes.retain(|&(side, node)| {
        let own = configuration.side(side);
        let node = node.index();
        are_apart(&felt, &own.x[node], own.sizes[node])
    });
    Pierced {
        nodes,
        unfelt,
        points,
    }
}

/// Whether tips keep their distance from a place on facets of some size.
fn are_apart(tips: &[Vec3], x: &Vec3, size: f64) -> bool {
    tips.iter().all(|tip| (tip - x).norm() > APART * size)
}

/// Nodes without pressure that are inside the other side: those that pierce it, and those
/// that are in with their facets.
fn sharp_and_unfelt(
    configuration: &Configuration,
    selection: &Selection,
    carried: &[Vec<[f64; 3]>; 2],
    progress: Progress,
) -> [Places; 2] {
    let unfelt = progress == Progress::Converged && !presses(configuration, carried);
    let depth = if unfelt { FIRST } else { PIERCED };
    let deep = deep_nodes(configuration, selection, carried, depth);
    if deep.is_empty() {
        return [Places::new(), Places::new()];
    }
    let means = mean_gaps(configuration, selection.scope());
    // There is room for points of a rigid side of facets only.
    let on_facets = !selection.points.is_empty();
    let is_sharp = |&(side, node, gap): &(Side, SurfaceNode, f64)| {
        let size = configuration.side(side).sizes[node];
        means[side][node].is_none_or(|mean| {
            let edge = || bend_at(configuration.side(side), node) == Some(Bend::Sharp);
            let sharp = unfelt && edge() || mean > 0.0 && mean - gap > SHARP * size;
            let open = on_facets && mean > CLOSING * size;
            sharp || open && !is_pressed_around(configuration, carried, node)
        })
    };
    let (mut sharp, smooth): (Vec<_>, Vec<_>) = deep.into_iter().partition(is_sharp);
    let (required, single): (Vec<_>, Vec<_>) = smooth.into_iter().partition(|&(side, node, _)| {
        let is_in = means[side][node].is_some_and(|mean| mean < 0.0);
        is_in && progress == Progress::Converged && follows(configuration, selection, side, node)
    });
    // The field feels nothing at all of two bodies that touch within a facet of both.
    if unfelt && !configuration.pair.is_rigid() && sharp.is_empty() && required.is_empty() {
        sharp = apart(configuration, selection, single);
    }
    [sharp, required].map(|nodes| {
        let places = nodes.into_iter().map(|(side, node, _)| (side, node));
        places.collect()
    })
}

/// Those of some smooth nodes that are deeper than [`PIERCED`] and keep apart from each other and
/// from what is pointed, whatever their sides: rows of two nodes that face each other are
/// nearly the same. Nodes of finer facets go first, then deeper ones.
fn apart(
    configuration: &Configuration,
    selection: &Selection,
    mut nodes: Vec<(Side, SurfaceNode, f64)>,
) -> Vec<(Side, SurfaceNode, f64)> {
    let place = |side: Side, node: SurfaceNode| configuration.side(side).x[node];
    let size = |side: Side, node: SurfaceNode| configuration.side(side).sizes[node];
    nodes.retain(|&(side, node, _)| inside(configuration, side, node, PIERCED).is_some());
    nodes.sort_by(|one, other| {
        let [a, b] = [one, other].map(|&(side, node, _)| size(side, node));
        a.total_cmp(&b).then(one.2.total_cmp(&other.2))
    });
    let pointed = &selection.kept()[selection.pointed_places()];
    let mut tips: Vec<Vec3> = pointed.iter().map(|k| place(k.side, k.node)).collect();
    nodes.retain(|&(side, node, _)| {
        let x = place(side, node);
        let is_apart = are_apart(&tips, &x, size(side, node));
        tips.extend(is_apart.then_some(x));
        is_apart
    });
    nodes
}

/// Whether a node between two deformable bodies follows others and has enough weight for an
/// unknown of its own.
fn follows(
    configuration: &Configuration,
    selection: &Selection,
    side: Side,
    node: SurfaceNode,
) -> bool {
    let size = configuration.side(side).sizes[node];
    let weight = |at: usize| selection.basis.node_weights[side][at];
    !configuration.pair.is_rigid()
        && !selection.is_kept(side, node)
        && selection.carries(side, node)
        && weight(node.index()) > COVERED * size * size
}

/// Nodes without pressure that are not pointed and lie deeper inside the other side than
/// `depth` of the facet size, with their gaps.
fn deep_nodes(
    configuration: &Configuration,
    selection: &Selection,
    carried: &[Vec<[f64; 3]>; 2],
    depth: f64,
) -> Vec<(Side, SurfaceNode, f64)> {
    let mut deep = Vec::new();
    for &side in configuration.pair.deformable_sides() {
        let nothing = NO_PRESSURE * configuration.pair.sides[side].stiffness;
        let own_gap = |node: SurfaceNode| {
            let is_free = !selection.is_pointed(side, node) && carried[side][node][0] <= nothing;
            let gap = is_free
                .then(|| inside(configuration, side, node, depth))
                .flatten();
            gap.map(|gap| (side, node, gap))
        };
        let found: Vec<(Side, SurfaceNode, f64)> = (0..selection.nodes(side))
            .into_par_iter()
            .with_min_len(16)
            .map(SurfaceNode::new)
            .filter_map(own_gap)
            .collect();
        deep.extend(found);
    }
    deep
}

/// Whether anything of a pair presses.
fn presses(configuration: &Configuration, carried: &[Vec<[f64; 3]>; 2]) -> bool {
    let nothing = nothing(configuration);
    let mut tractions = carried.iter().flatten();
    tractions.any(|[pressure, ..]| *pressure > nothing)
}

/// Pressure that is none on either side.
fn nothing(configuration: &Configuration) -> f64 {
    let pair = configuration.pair;
    let stiffness = |&side: &Side| pair.sides[side].stiffness;
    let softer = pair.deformable_sides().iter().map(stiffness);
    NO_PRESSURE * softer.fold(f64::INFINITY, f64::min)
}

/// Whether the field presses on a facet around a node of side `a`.
fn is_pressed_around(
    configuration: &Configuration,
    carried: &[Vec<[f64; 3]>; 2],
    node: SurfaceNode,
) -> bool {
    let own = configuration.side(Side::A);
    let mut around = own.surface.corners(node).iter();
    around.any(|corner| is_pressed(configuration, carried, corner.facet))
}

/// Whether the field presses on a facet of side `a`.
fn is_pressed(configuration: &Configuration, carried: &[Vec<[f64; 3]>; 2], facet: FacetId) -> bool {
    let nothing = NO_PRESSURE * configuration.pair.sides[Side::A].stiffness;
    let corners = configuration.side(Side::A).corners(facet).into_iter();
    let mut pressures = corners.map(|node| carried[0][node][0]);
    pressures.any(|pressure| pressure > nothing)
}

/// Gap of a node that lies deeper inside the other side than `depth` of the smaller facet size.
fn inside(configuration: &Configuration, side: Side, node: SurfaceNode, depth: f64) -> Option<f64> {
    let OwnGap { gap, sizes } = own_gap(configuration, side, node)?;
    (gap < -depth * sizes[0].min(sizes[1])).then_some(gap)
}

/// Gap at a node.
pub(crate) struct OwnGap {
    /// The gap, along the normal of what the node faces.
    pub gap: f64,
    /// Facet sizes at the node and opposite to it; the same against a rigid side.
    pub sizes: [f64; 2],
}

/// Gap at a node; `None` beside the other side or far away from it.
pub(crate) fn own_gap(
    configuration: &Configuration,
    side: Side,
    node: SurfaceNode,
) -> Option<OwnGap> {
    let own = configuration.side(side);
    let size = own.sizes[node];
    if let Some((point, normal)) = configuration.plane() {
        let gap = (own.x[node] - point).dot(&normal);
        let faces = own.normals[node].dot(&normal) < 0.0;
        let near = -gap < configuration.reach(side, node);
        let sizes = [size; 2];
        return (faces && near).then_some(OwnGap { gap, sizes });
    }
    let tip = Tip::Node {
        side,
        node,
        home: None,
    };
    let hit = faced(configuration, tip, tip.reach(configuration))?;
    let target = configuration.side(side.opposite());
    let other = if configuration.pair.is_rigid() {
        size
    } else {
        let corners = target.corners(hit.facet);
        let sizes = corners.map(|corner| target.sizes[corner]);
        sizes.into_iter().fold(f64::INFINITY, f64::min)
    };
    Some(OwnGap {
        gap: hit.gap,
        sizes: [size, other],
    })
}

/// Pointed nodes of a converged configuration that are so in the next increment too.
pub fn staying(
    configuration: &Configuration,
    pointed: &Kept,
    nodes: &[Vec<NodeResult>; 2],
) -> Kept {
    let mut staying = pointed.clone();
    if !pointed.iter().flatten().any(|pointed| *pointed) {
        return staying;
    }
    let compliances = compliances(configuration);
    let scope = Scope {
        compliances: &compliances,
        depth: 0.0,
    };
    let gaps = mean_gaps(configuration, scope);
    let nothing = nothing(configuration);
    let sides = nodes.iter().zip(pointed);
    let mut kept = sides.flat_map(|(nodes, pointed)| nodes.iter().zip(pointed));
    let unfelt = kept.all(|(node, pointed)| *pointed || node.pressure <= nothing);
    for &side in configuration.pair.deformable_sides() {
        let own = configuration.side(side);
        for (node, stays) in staying[side].iter_mut().enumerate() {
            let alone = || {
                !configuration.pair.is_rigid()
                    || bend_at(own, SurfaceNode::new(node)) == Some(Bend::Sharp)
            };
            let open = |gap| gap > CLOSING * own.sizes[node];
            *stays &= nodes[side][node].pressure > 0.0
                && (gaps[side][node].is_none_or(open) || unfelt && alone());
        }
    }
    staying
}

/// `integral N_I g / integral N_I` at all nodes with facets near the other side.
fn mean_gaps(configuration: &Configuration, scope: Scope) -> [Vec<Option<f64>>; 2] {
    let mut sums = Side::BOTH.map(|side| {
        let count = configuration.sides[side].as_ref().map_or(0, |s| s.x.len());
        vec![[0.0; 2]; count]
    });
    for paired in paired_facets(configuration, scope, &|_| SegmentDerivatives::None, |_| {
        true
    }) {
        let origin = paired.origin(configuration);
        for corner in 0..8 {
            if let Some((side, node)) = paired.node(configuration, corner) {
                let sum = paired.difference(corner, &paired.x, &origin);
                let [gap, area] = &mut sums[side][node];
                *gap += paired.segment.normal.dot(&sum);
                *area += paired.area_of(corner);
            }
        }
    }
    sums.map(|side| {
        let mean = |[gap, area]: [f64; 2]| (area > 0.0).then(|| gap / area);
        side.into_iter().map(mean).collect()
    })
}
