//! Bodies that are inside themselves, or inside others, whatever pairs there are.
//!
//! The skins of all bodies are one closed surface. Just outside a point of the skin no body is,
//! so a half-line that leaves the body there goes out of every body as often as into it,
//!
//! ```text
//! w = (ways out) - (ways in) = 0,
//! ```
//!
//! the winding number of the skin about its start (Jacobson, Kavan & Sorkine-Hornung, ACM Trans.
//! Graph. 32 (2013), DOI 10.1145/2461912.2461916). Where bodies overlap it is 1 or more. This
//! needs no distance, so that thin walls, sharp folds and neighbours that share nodes are no
//! overlaps; nor is it decided by one half-line alone, which may graze an edge: [`DIRECTIONS`]
//! have to agree. Points are the nodes and the centres of the facets, and the facets that meet
//! at a point are not counted: they are a fan around it, which no half-line from it meets again.
//!
//! The depth of a point is the distance of the nearest facet that it is behind; for its own body
//! only facets that face it count. Cost: a tree over the facets and a half-line for each point,
//! `O(n log n)` in the number of facets.

use rayon::prelude::*;
use striae_mesh::{FacetId, Vec3};
use striae_surface::{
    node::SurfaceNode,
    topology::{Surface, distinct_corners},
};

use super::{Spot, located, nearest::triangles, spots, triangle};
use crate::{
    search::{Bounds, Tree},
    segment::FACING,
};

/// The skins of bodies as one surface.
#[derive(Clone, Debug)]
pub struct Skins {
    /// Topology.
    pub surface: Surface,
    /// Body of every facet.
    pub bodies: Vec<usize>,
}

/// A point of the skin of one body that is inside a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Overlap {
    /// The point.
    pub spot: Spot,
    /// Position of the point.
    pub point: Vec3,
    /// The nearest facet that it is behind.
    pub facet: FacetId,
    /// Distance from there.
    pub depth: f64,
    /// The smaller one of the facet sizes there, of facets that face each other.
    pub size: f64,
}

impl Overlap {
    /// Depth over the local facet size.
    pub fn share(&self) -> f64 {
        self.depth / self.size
    }
}

/// Slopes against the normal of half-lines that have to agree: none along a line of a mesh.
const DIRECTIONS: [[f64; 2]; 3] = [[0.19, 0.107], [-0.083, 0.231], [0.041, -0.157]];

/// The skins with their nodes somewhere.
pub struct PlacedSkins<'a> {
    skins: &'a Skins,
    x: &'a [Vec3],
    tree: Tree,
}

impl Skins {
    /// Body of a point.
    pub fn body(&self, spot: Spot) -> usize {
        let facet = match spot {
            Spot::Node(node) => self.surface.corners(node)[0].facet,
            Spot::Centre(facet) => facet,
        };
        self.bodies[facet.index()]
    }

    /// Facets that meet at a point.
    pub fn around(&self, spot: Spot) -> Vec<FacetId> {
        match spot {
            Spot::Node(node) => {
                let corners = self.surface.corners(node).iter();
                corners.map(|corner| corner.facet).collect()
            }
            Spot::Centre(facet) => vec![facet],
        }
    }

    /// A node that is the point, or a corner of the facet whose centre it is.
    pub fn node(&self, spot: Spot) -> SurfaceNode {
        match spot {
            Spot::Node(node) => node,
            Spot::Centre(facet) => self.surface.facets()[facet.index()][0],
        }
    }
}

impl<'a> PlacedSkins<'a> {
    /// The skins with their nodes at `x`.
    pub fn new(skins: &'a Skins, x: &'a [Vec3]) -> Self {
        let facets = skins.surface.facets().iter();
        let boxes =
            facets.map(|facet| Bounds::around(distinct_corners(facet).iter().map(|&n| x[n])));
        Self {
            skins,
            x,
            tree: Tree::new(boxes.collect()),
        }
    }

    /// All points that are inside a body, as far as a point of one body inside another one is
    /// `judged`, by the point and the facet that it is behind.
    pub fn overlaps(&self, judged: impl Fn(Spot, FacetId) -> bool + Sync) -> Vec<Overlap> {
        let spots = spots(&self.skins.surface).into_par_iter().with_min_len(32);
        spots
            .filter_map(|spot| self.overlap(spot, &judged))
            .collect()
    }

    /// Depth of a point inside a body; `None` if it is outside.
    pub fn overlap(&self, spot: Spot, judged: impl Fn(Spot, FacetId) -> bool) -> Option<Overlap> {
        let around = self.skins.around(spot);
        let point = located(&self.skins.surface, spot, |node| self.x[node]);
        let normals = around.iter().flat_map(|&facet| self.at(facet, spot));
        let normals: Vec<Vec3> = normals.collect();
        let normal = normals.iter().sum::<Vec3>().try_normalize(0.0)?;
        let mut inside: Option<Vec<usize>> = None;
        for slopes in DIRECTIONS {
            let direction = tilted(&normal, slopes);
            if normals
                .iter()
                .any(|of_facet| direction.dot(of_facet) <= 0.0)
            {
                continue;
            }
            let found = self.around_start(&point, &direction, &around);
            let both = |body: &usize| inside.as_ref().is_none_or(|known| known.contains(body));
            let agreed: Vec<usize> = found.into_iter().filter(both).collect();
            if agreed.is_empty() {
                return None;
            }
            inside = Some(agreed);
        }
        let depths = inside?.into_iter();
        let depths =
            depths.filter_map(|body| self.depth((spot, &point, &normal), &around, body, &judged));
        depths.max_by(|a, b| a.share().total_cmp(&b.share()))
    }

    /// Bodies that the start of a half-line is inside of.
    fn around_start(&self, start: &Vec3, direction: &Vec3, left_out: &[FacetId]) -> Vec<usize> {
        let mut windings: Vec<(usize, i32)> = Vec::new();
        for facet in self.tree.on_ray(start, direction) {
            if left_out.contains(&FacetId(facet)) {
                continue;
            }
            let corners = &self.skins.surface.facets()[facet as usize];
            let fan = triangles(corners, |node| self.x[node]);
            let ways: i32 = fan.iter().map(|abc| way_out(abc, start, direction)).sum();
            let body = self.skins.bodies[facet as usize];
            match windings.iter_mut().find(|(known, _)| *known == body) {
                Some((_, winding)) => *winding += ways,
                None => windings.push((body, ways)),
            }
        }
        let inside = windings.into_iter().filter(|(_, winding)| *winding > 0);
        inside.map(|(body, _)| body).collect()
    }

    /// Depth of a point behind the facets of a body.
    fn depth(
        &self,
        (spot, point, normal): (Spot, &Vec3, &Vec3),
        around: &[FacetId],
        body: usize,
        judged: impl Fn(Spot, FacetId) -> bool,
    ) -> Option<Overlap> {
        let is_own = self.skins.body(spot) == body;
        let mut best: Option<(f64, FacetId)> = None;
        self.tree.visit_nearest(point, |facet| {
            let id = FacetId(facet);
            if self.skins.bodies[facet as usize] != body || around.contains(&id) {
                return f64::INFINITY;
            }
            let area = self.area(id);
            if is_own && area.dot(normal) >= 0.0 {
                return f64::INFINITY;
            }
            let nearest = self.nearest(id, point);
            let away = point - nearest;
            if away.dot(&area) > 0.0 {
                return f64::INFINITY;
            }
            let square = away.norm_squared();
            if best.is_none_or(|known| (square, id) < known) {
                best = Some((square, id));
            }
            square
        });
        let (square, facet) = best?;
        judged(spot, facet).then(|| Overlap {
            spot,
            point: *point,
            facet,
            depth: square.sqrt(),
            size: self.size(around, facet),
        })
    }

    /// The smaller one of the sizes of a facet and of those around a point that face it: the end of
    /// a sheet is finer than what is pressed at its edge. All count where none does.
    fn size(&self, around: &[FacetId], facet: FacetId) -> f64 {
        let normal = self.area(facet).normalize();
        let faces = |area: &Vec3| area.dot(&normal) <= FACING * area.norm();
        let areas: Vec<Vec3> = around.iter().map(|&facet| self.area(facet)).collect();
        let is_any = areas.iter().any(faces);
        let own = areas.iter().filter(|area| !is_any || faces(area));
        let least = own.map(Vec3::norm).fold(self.area(facet).norm(), f64::min);
        (0.5 * least).sqrt()
    }

    fn nearest(&self, facet: FacetId, x: &Vec3) -> Vec3 {
        let fan = triangles(&self.skins.surface.facets()[facet.index()], |n| self.x[n]);
        let points = fan.iter().map(|vertices| {
            let (weights, _) = triangle::nearest(vertices, x);
            (0..3).map(|k| vertices[k] * weights[k]).sum::<Vec3>()
        });
        let distance = |p: &Vec3| (p - x).norm_squared();
        let nearest = points.min_by(|p, q| distance(p).total_cmp(&distance(q)));
        nearest.expect("a facet has a triangle")
    }

    /// Twice the area vector of a facet.
    pub(super) fn area(&self, facet: FacetId) -> Vec3 {
        let fan = triangles(&self.skins.surface.facets()[facet.index()], |n| self.x[n]);
        fan.iter().map(twice_area).sum()
    }

    /// Unit normals of the triangles of a facet that meet at a point of it.
    fn at(&self, facet: FacetId, spot: Spot) -> Vec<Vec3> {
        let corners = &self.skins.surface.facets()[facet.index()];
        let fan = triangles(corners, |node| self.x[node]);
        let count = fan.len();
        let met: Vec<usize> = match spot {
            Spot::Node(node) if count > 1 => {
                let at = distinct_corners(corners).iter().position(|&n| n == node);
                at.map_or(Vec::new(), |at| vec![at, (at + count - 1) % count])
            }
            Spot::Node(_) | Spot::Centre(_) => (0..count).collect(),
        };
        let normals = met.into_iter().map(|at| twice_area(&fan[at]));
        normals.filter_map(|area| area.try_normalize(0.0)).collect()
    }
}

fn twice_area([a, b, c]: &[Vec3; 3]) -> Vec3 {
    (b - a).cross(&(c - a))
}

/// A direction with slopes against `n`.
fn tilted(n: &Vec3, [s, t]: [f64; 2]) -> Vec3 {
    let first = n.cross(&Vec3::ith(n.iamin(), 1.0)).normalize();
    (n + first * s + n.cross(&first) * t).normalize()
}

/// Passage of a half-line through a triangle: 1 out through its back, -1 in through its front, 0
/// beside it. Triangles with a common edge leave no gap between them: they have opposite signs of
/// the same volume there.
fn way_out([a, b, c]: &[Vec3; 3], start: &Vec3, direction: &Vec3) -> i32 {
    let [a, b, c] = [a - start, b - start, c - start];
    let volume = |p: &Vec3, q: &Vec3| direction.dot(&p.cross(q));
    let volumes = [volume(&b, &c), volume(&c, &a), volume(&a, &b)];
    let way = match volumes.map(|v| v > 0.0) {
        [true, true, true] => 1,
        [false, false, false] => -1,
        _ => return 0,
    };
    let [of_a, of_b, of_c] = volumes;
    let sum = of_a + of_b + of_c;
    let along = (a * of_a + b * of_b + c * of_c).dot(direction);
    if along * sum > 0.0 { way } else { 0 }
}
