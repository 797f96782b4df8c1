//! The edge or node between facets that a point faces where none of them is opposite to it.
//!
//! Below a valley the normals of the facets leave a wedge: a point there is beyond the edges of
//! all of them. The same holds above a ridge. Such a point faces the bottom of the valley. With
//! the unit normals `m_1`, `m_2` of the two facets, their edge from `y_0` along `d` and
//! `D = d . (m_1 x m_2)`
//!
//! ```text
//! x = y_0 + t d + a m_1 + b m_2,   0 <= t <= 1,   a b > 0
//! t = (x - y_0) . (m_1 x m_2)/D,   a = (x - y_0) . (m_2 x d)/D,   b = (x - y_0) . (d x m_1)/D
//! |g| = |a m_1 + b m_2|,           n = -(a m_1 + b m_2)/g
//! ```
//!
//! and `g < 0` inside, where `a < 0`. Towards either facet, `b = 0` or `a = 0`, place, normal and
//! gap go over into those along its normal, whether facets are plane or not. If they are plane,
//! this is the nearest point of the edge. Beyond its ends the point faces their node `y_0`,
//! `x = y_0 - g n`, within the cone of all normals around the node:
//!
//! ```text
//! g (x - y_0) . (m_i x m_(i+1)) > 0   for all facets in turn
//! ```
//!
//! Rims of the surface have one facet only and are not faced.

use striae_mesh::{FacetId, Vec3};
use striae_surface::{
    facet::{Shape, facet_normal},
    node::SurfaceNode,
    topology::distinct_corners,
};

use crate::{
    configuration::Snapshot,
    opposing::Opposing,
    projection::{FACING, Hit},
    search::Bounds,
};

/// Sine of the angle between two facets up to which there is no wedge.
const STRAIGHT: f64 = 1e-7;

/// An edge or node that a point faces.
pub struct Crease {
    /// The point, on one of the facets, and the gap.
    pub hit: Hit,
    /// Normal `n` of the point that faces it.
    pub normal: Vec3,
    /// What it is.
    pub kind: Kind,
}

/// What lies between facets.
pub enum Kind {
    /// An edge.
    Edge(Edge),
    /// A node.
    Node,
}

/// An edge between two facets.
pub struct Edge {
    /// Its ends.
    nodes: [SurfaceNode; 2],
    /// The facets.
    pub facets: [FacetId; 2],
    /// Shares `a/g` and `b/g` of their normals in `-n`.
    pub shares: [f64; 2],
    /// `dt/dx`.
    by_x: Vec3,
    /// `dg/dr` of [`Opposing`].
    gap_by_r: Vec3,
}

/// The nearest edge or node between facets that a point faces within `reach`; the facets
/// face the unit normal `faced`.
pub fn crease(target: &Snapshot, x: &Vec3, faced: &Vec3, reach: f64) -> Option<Crease> {
    let mut best: Option<Crease> = None;
    let mut take = |found: Option<Crease>| {
        let known = best.as_ref().map_or(reach, |best| best.hit.gap.abs());
        if let Some(found) = found
            && found.hit.gap.abs() < known
        {
            best = Some(found);
        }
    };
    for item in target.tree.meeting(&Bounds::around([*x]).inflated(reach)) {
        let facet = FacetId(item);
        let corners = target.corners(facet);
        let ring = distinct_corners(&corners);
        for (at, &start) in ring.iter().enumerate() {
            let end = ring[(at + 1) % ring.len()];
            // Either facet has the edge, and all have the node; one of them lists it.
            if start < end {
                take(on_edge(target, x, faced, [start, end], facet));
            }
            if target.surface.corners(start)[0].facet == facet {
                take(at_node(target, x, faced, start));
            }
        }
    }
    best
}

/// Unit normal of a facet that faces a unit normal.
fn normal_against(target: &Snapshot, facet: FacetId, faced: &Vec3) -> Option<Vec3> {
    let normal = facet_normal(&target.corner_positions(facet));
    (normal.dot(faced) <= -FACING).then_some(normal)
}

/// The place on an edge of a facet, in its sense of rotation.
fn on_edge(
    target: &Snapshot,
    x: &Vec3,
    faced: &Vec3,
    nodes: [SurfaceNode; 2],
    facet: FacetId,
) -> Option<Crease> {
    let [start, end] = nodes.map(|node| target.x[node]);
    let (d, y) = (end - start, x - start);
    let m_1 = normal_against(target, facet, faced)?;
    let inward = m_1.cross(&d);
    if inward.dot(&y) >= 0.0 {
        return None;
    }
    let mut beside = target.surface.corners(nodes[1]).iter();
    let other = beside.find(|corner| corner.next == nodes[0])?.facet;
    let m_2 = normal_against(target, other, faced)?;
    let across = m_1.cross(&m_2);
    let volume = d.dot(&across);
    if m_2.cross(&d).dot(&y) <= 0.0 || volume.abs() < STRAIGHT * d.norm() {
        return None;
    }
    let by_x = across / volume;
    let t = by_x.dot(&y);
    if !(0.0..=1.0).contains(&t) {
        return None;
    }
    let rows = [m_2.cross(&d) / volume, -inward / volume];
    let [a, b] = rows.map(|row| row.dot(&y));
    let v = m_1 * a + m_2 * b;
    let gap = v.norm().copysign(volume);
    let normal = -v / gap;
    let facets = [facet, other];
    let nearer = facets[usize::from(b.abs() > a.abs())];
    let edge = Edge {
        nodes,
        facets,
        shares: [a / gap, b / gap],
        by_x,
        gap_by_r: rows[0] * normal.dot(&m_1) + rows[1] * normal.dot(&m_2),
    };
    Some(Crease {
        hit: hit(target, nearer, nodes, t, gap),
        normal,
        kind: Kind::Edge(edge),
    })
}

/// A node within whose cone of normals a point is.
fn at_node(target: &Snapshot, x: &Vec3, faced: &Vec3, node: SurfaceNode) -> Option<Crease> {
    if target.surface.is_on_boundary(node) {
        return None;
    }
    let y = x - target.x[node];
    let gap = y.norm().copysign(y.dot(&target.normals[node]));
    let corners = target.surface.corners(node);
    for corner in corners {
        let after = corners.iter().find(|c| c.next == corner.previous)?;
        let m = normal_against(target, corner.facet, faced)?;
        let after = normal_against(target, after.facet, faced)?;
        if gap * y.dot(&m.cross(&after)) <= 0.0 {
            return None;
        }
    }
    Some(Crease {
        hit: hit(target, corners[0].facet, [node; 2], 0.0, gap),
        normal: -y / gap,
        kind: Kind::Node,
    })
}

/// A place between two corners of a facet.
fn hit(target: &Snapshot, facet: FacetId, nodes: [SurfaceNode; 2], share: f64, gap: f64) -> Hit {
    let corners = target.corners(facet);
    let at = |node: SurfaceNode| {
        Shape::of(&corners).corner(corners.iter().position(|corner| *corner == node))
    };
    let [start, end] = nodes.map(at);
    let [xi, eta] = [0, 1].map(|k| start[k] + (end[k] - start[k]) * share);
    Hit {
        facet,
        xi,
        eta,
        gap,
    }
}

impl Crease {
    /// The place among the corners of the facet of the hit, with its derivatives by
    ///
    /// ```text
    /// r = sum N_J dx_J - dx - g dn,   dn = -(a dm_1 + b dm_2)/g
    /// ```
    ///
    /// and at a node without `dn`. As `a` and `b` are held in this `dn`, `n` keeps no unit length:
    /// `dg` has `g n . dn` besides.
    pub fn opposing(&self, corners: &[SurfaceNode; 4]) -> Opposing {
        let shape = Shape::of(corners);
        let weights = shape.weights(self.hit.xi, self.hit.eta).value;
        let gap = self.hit.gap;
        match &self.kind {
            Kind::Node => Opposing {
                gap,
                weights,
                weights_by_r: [Vec3::zeros(); 4],
                gap_by_r: self.normal,
                gap_by_n: Vec3::zeros(),
            },
            Kind::Edge(edge) => {
                let mut weights_by_r = [Vec3::zeros(); 4];
                for (node, sign) in edge.nodes.iter().zip([1.0, -1.0]) {
                    let at = corners.iter().position(|corner| corner == node);
                    weights_by_r[at.expect("an edge belongs to its facets")] = edge.by_x * sign;
                }
                Opposing {
                    gap,
                    weights,
                    weights_by_r,
                    gap_by_r: edge.gap_by_r,
                    gap_by_n: (self.normal - edge.gap_by_r) * gap,
                }
            }
        }
    }
}
