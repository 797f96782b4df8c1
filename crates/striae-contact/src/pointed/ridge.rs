//! Points of a rigid surface that may pierce a facet.
//!
//! These are the vertices of convex edges, and of every convex edge the middle of what passes
//! over each facet of side `a`: an edge from `A` to `B` is cut with the planes through the edges of the facet
//! along its normal `m`, so that it is over the facet for `t` in `[t_0, t_1]`,
//!
//! ```text
//! q_c . (A + t (B - A) - y_c) >= 0,   q_c = m x (y_{c+1} - y_c)
//! ```
//!
//! An edge is convex if the facets beside it fall away from each other by more than
//! [`FLAT`], or if there is one facet only. Those that do so by more than [`BENT`] are sharp.
//! Facets of a smooth surface of radius `R` fall away by their size over `R`. The angle is
//! taken across the edge: facets of a ridge may be as long as it is.

use rayon::prelude::*;
use striae_mesh::{FacetId, Vec3};
use striae_surface::{facet::facet_normal, node::SurfaceNode, topology::distinct_corners};

use crate::{
    configuration::{Configuration, Snapshot},
    pairing::farthest,
    search::Bounds,
    side::Side,
    tip::RigidPoint,
};

/// Sine of the angle by which one facet falls away from the plane of the other at a sharp edge.
const BENT: f64 = 0.25;

/// The same at an edge that is none.
const FLAT: f64 = 0.02;

/// Length of edge over a facet below which its neighbours stand for it, over the facet size.
const SHORT: f64 = 0.2;

/// Cosine of the angle between the normals from which an edge faces a facet.
const FACING: f64 = 0.2;

/// How much an edge, or the sharpest edge of a vertex, is bent.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Bend {
    /// By less than 14 degrees.
    Blunt,
    /// By more, or it bounds the surface.
    Sharp,
}

/// All points that are near side `a`, given how deep they may be beyond its reach.
pub fn candidates(configuration: &Configuration, depth: f64) -> Vec<(RigidPoint, Bend)> {
    let [a, b] = Side::BOTH.map(|side| configuration.side(side));
    let reach = farthest(configuration) + depth;
    let Some(near) = a.tree.bounds().map(|bounds| bounds.inflated(reach)) else {
        return Vec::new();
    };
    let is_near = |points: &[Vec3]| near.meets(&Bounds::around(points.iter().copied()));
    let found: Vec<Vec<(RigidPoint, Bend)>> = (0..b.x.len())
        .into_par_iter()
        .with_min_len(32)
        .map(SurfaceNode::new)
        .map(|vertex| {
            let mut points = Vec::new();
            let edges: Vec<Edge> = edges(b, vertex).collect();
            if let Some(bend) = edges.iter().map(|edge| edge.bend).max()
                && is_near(&[b.x[vertex]])
            {
                points.push((RigidPoint::vertex(vertex), bend));
            }
            // Of the two vertices of an edge one lists it.
            for edge in edges.iter().filter(|edge| edge.listed) {
                if is_near(&edge.nodes.map(|node| b.x[node])) {
                    let over = over_facets(a, b, edge, reach);
                    points.extend(over.map(|point| (point, edge.bend)));
                }
            }
            points
        })
        .collect();
    found.into_iter().flatten().collect()
}

/// The bend of the sharpest convex edge at a node, `None` where there is none.
pub(crate) fn bend_at(side: &Snapshot, node: SurfaceNode) -> Option<Bend> {
    edges(side, node).map(|edge| edge.bend).max()
}

/// A convex edge.
struct Edge {
    nodes: [SurfaceNode; 2],
    /// Mean normal of its facets.
    normal: Vec3,
    bend: Bend,
    /// Whether it belongs to the list of its first vertex.
    listed: bool,
}

/// Convex edges from a vertex.
fn edges<'a>(b: &'a Snapshot<'_>, vertex: SurfaceNode) -> impl Iterator<Item = Edge> + 'a {
    let corners = b.surface.corners(vertex).iter();
    corners.filter_map(move |corner| {
        let mut beside = b.surface.corners(corner.next).iter();
        let other = beside.find(|other| other.next == vertex);
        let one = facet_normal(&b.corner_positions(corner.facet));
        let (normal, bend) = match other {
            None => (one, Bend::Sharp),
            Some(other) => {
                let along = b.x[corner.next] - b.x[vertex];
                let away = centre(b, other.facet) - b.x[vertex];
                let across = away - along * (away.dot(&along) / along.norm_squared());
                let falls = -one.dot(&across) / across.norm();
                let normal = one + facet_normal(&b.corner_positions(other.facet));
                (normal, bend(falls)?)
            }
        };
        Some(Edge {
            nodes: [vertex, corner.next],
            normal: normal.try_normalize(1e-6)?,
            bend,
            listed: other.is_none() || vertex < corner.next,
        })
    })
}

/// Bend by the sine of the angle by which facets fall away; `None` if they do not.
fn bend(falls: f64) -> Option<Bend> {
    if falls > BENT {
        Some(Bend::Sharp)
    } else {
        (falls > FLAT).then_some(Bend::Blunt)
    }
}

fn centre(side: &Snapshot, facet: FacetId) -> Vec3 {
    let corners = side.corners(facet);
    let ring = distinct_corners(&corners);
    let sum: Vec3 = ring.iter().map(|&node| side.x[node]).sum();
    sum / ring.len() as f64
}

/// Middles of what of an edge is over each facet.
fn over_facets<'a>(
    a: &'a Snapshot,
    b: &Snapshot,
    edge: &Edge,
    reach: f64,
) -> impl Iterator<Item = RigidPoint> + 'a {
    let (ends, normal) = (edge.nodes, edge.normal);
    let x = ends.map(|node| b.x[node]);
    let met = a.tree.meeting(&Bounds::around(x).inflated(reach));
    met.into_iter().filter_map(move |item| {
        let facet = FacetId(item);
        let [from, to] = part_over(a, facet, &x, &normal)?;
        let passes = from > 0.0 || to < 1.0;
        let long = (to - from) * (x[1] - x[0]).norm() > SHORT * a.facet_size(facet);
        (passes && long).then_some(RigidPoint {
            ends,
            share: 0.5 * (from + to),
            left: 0.0,
        })
    })
}

/// `[t_0, t_1]` of an edge over a facet that it faces.
fn part_over(a: &Snapshot, facet: FacetId, x: &[Vec3; 2], normal: &Vec3) -> Option<[f64; 2]> {
    let m = facet_normal(&a.corner_positions(facet));
    if m.dot(normal) > -FACING {
        return None;
    }
    let corners = a.corners(facet);
    let ring = distinct_corners(&corners);
    let [mut from, mut to] = [0.0_f64, 1.0_f64];
    for (at, &corner) in ring.iter().enumerate() {
        let start = a.x[corner];
        let end = a.x[ring[(at + 1) % ring.len()]];
        let inward = m.cross(&(end - start));
        let [first, last] = x.map(|x| inward.dot(&(x - start)));
        match (first < 0.0, last < 0.0) {
            (true, true) => return None,
            (true, false) => from = from.max(first / (first - last)),
            (false, true) => to = to.min(first / (first - last)),
            (false, false) => {}
        }
    }
    (from < to).then_some([from, to])
}
