//! Gaps and overlaps of nodes, by the faces of their bodies.
//!
//! A node sees the nearest facet that one of the faces of its body there is opposed to. Where a
//! block stands on another one and both end at the same edge, the nodes there lie as near to the
//! flank of the other block, or nearer, but no face of theirs is opposed to that. On an edge, where
//! a surface has a node for each face, only that of a face that is opposed has the gap. Facets of
//! the side alone decide what is beyond its edge: with the other faces of its skin, a point beyond
//! it is in front of one or the other.

use std::collections::HashMap;

use striae_mesh::{NodeId, Vec3};
use striae_surface::node::SurfaceNode;

use super::on_plane;
use crate::{
    configuration::Snapshot,
    interference::{Nearest, Spot, Stage, Standing, nearest_facing, normal_at},
    segment::FACING,
    side::Side,
};

/// Distance from a surface that is round-off, over the size of facets.
const ROUND_OFF: f64 = 1e-9;

/// Faces of the bodies of a pair at its nodes.
#[derive(Debug)]
pub struct Faces<'a> {
    stage: &'a Stage<'a>,
    /// Unit normals of the facets of the skin at a node, by side and surface node.
    normals: [Vec<Vec<Vec3>>; 2],
}

impl<'a> Faces<'a> {
    /// Faces in a configuration.
    pub fn new(stage: &'a Stage<'a>) -> Self {
        let sides = stage.configuration.sides.each_ref();
        let normals = sides.map(|side| side.as_ref().map_or_else(Vec::new, normals));
        Self { stage, normals }
    }

    /// Gap of a node and the point of the other side that it would have to go to, if it faces
    /// that or is inside.
    pub fn signed_gap(&self, side: Side, node: SurfaceNode) -> Option<(f64, Vec3)> {
        if self.stage.configuration.pair.is_in_one_body() {
            return None;
        }
        let nearest = self.nearest(side, node)?;
        let own = self.stage.configuration.side(side);
        let gap = match nearest.standing {
            Standing::Front => {
                let faces = own.normals[node].dot(&nearest.normal) < FACING;
                faces.then_some(nearest.distance)
            }
            Standing::Behind => self.is_within(side, &nearest).then_some(-nearest.distance),
            Standing::Beside => None,
        };
        gap.map(|gap| (gap, nearest.point))
    }

    /// Overlap of a node; zero where there is none.
    fn overlap(&self, side: Side, node: SurfaceNode) -> f64 {
        let own = self.stage.configuration.side(side);
        let Some(nearest) = self.nearest(side, node) else {
            return 0.0;
        };
        let is_near = nearest.distance < own.sizes[node];
        match nearest.standing {
            Standing::Behind if self.is_within(side, &nearest) => nearest.distance,
            Standing::Beside if is_near => {
                let depth = (nearest.point - own.x[node]).dot(&nearest.normal);
                depth.max(0.0)
            }
            _ => 0.0,
        }
    }

    /// The nearest facet of the other side that a face of the node is opposed to; `None` where that
    /// is of another part of its skin, or only faces of other nodes on the same edge are.
    fn nearest(&self, side: Side, node: SurfaceNode) -> Option<Nearest> {
        let configuration = self.stage.configuration;
        let own = configuration.side(side);
        let point = own.x[node];
        if let Some(plane) = configuration.plane() {
            return Some(on_plane(&point, &plane));
        }
        let other = configuration.side(side.opposite());
        let normals = &self.normals[side][node.index()];
        let round_off = ROUND_OFF * own.sizes[node];
        let nearest = nearest_facing(other, &point, (normals, round_off))?;
        let opposed = normal_at(other, Spot::Centre(nearest.facet));
        let mut of_own = own.surface.corners(node).iter();
        let faces = of_own.any(|corner| {
            let normal = normal_at(own, Spot::Centre(corner.facet));
            normal.dot(&opposed) < FACING
        });
        faces.then_some(nearest)
    }

    /// Returns whether what is behind a point of the other side is inside its body.
    fn is_within(&self, side: Side, nearest: &Nearest) -> bool {
        if self.stage.configuration.plane().is_some() {
            return true;
        }
        nearest.distance < self.stage.thickness.0[side.opposite()][nearest.facet.index()]
    }
}

/// Initial overlap of every node of every side with facets, zero where there is none.
/// Beyond the edge of the other side it is that with the plane of the nearest facet, for
/// the width of a facet, so that interpolated overlaps are right up to the edge.
pub fn overlaps(stage: &Stage) -> [Vec<f64>; 2] {
    let faces = Faces::new(stage);
    Side::BOTH.map(|side| {
        let count = match &stage.configuration.sides[side] {
            Some(snapshot) if !stage.configuration.pair.is_in_one_body() => snapshot.x.len(),
            _ => 0,
        };
        let nodes = SurfaceNode::all(count);
        nodes.map(|node| faces.overlap(side, node)).collect()
    })
}

/// Unit normals of the facets of the skin, or of the side where it has none, at the nodes.
fn normals(snapshot: &Snapshot) -> Vec<Vec<Vec3>> {
    let mut at: HashMap<NodeId, Vec<Vec3>> = HashMap::new();
    let (surface, x) = match &snapshot.enclosed {
        None => (snapshot.surface, &snapshot.x),
        Some(enclosed) => (&enclosed.enclosure.surface, &enclosed.x),
    };
    for corners in surface.facets() {
        let [a, b, c, d] = corners.map(|node| x[node]);
        let normal = (c - a).cross(&(d - b)).normalize();
        for corner in corners {
            let of_node = at.entry(surface.nodes()[corner.index()]).or_default();
            of_node.push(normal);
        }
    }
    let nodes = snapshot.surface.nodes().iter();
    nodes.map(|node| at[node].clone()).collect()
}
