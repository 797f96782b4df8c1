//! Points of skins that go through a body between two configurations.
//!
//! Sheets that are thinner than a facet have crossed something long before any of their points is
//! deep inside it. Points are the nodes of the skins and the centres of their facets. Points and
//! facets move in straight lines at a common pace, under which a body that turns by less than half
//! a turn passes through nothing. A point has gone through a body if it comes out of its skin
//! where the normal points against the one where it went in, by a facet that has no node in common
//! with the one there: around an edge is not through. Bars that cross between their points,
//! edge through edge, are not seen.

use std::{collections::BTreeMap, sync::OnceLock};

use rayon::prelude::*;
use striae_mesh::{FacetId, Vec3};
use striae_surface::{node::SurfaceNode, topology::distinct_corners};

use super::{
    Spot, located,
    nearest::triangles,
    overlap::{PlacedSkins, Skins},
    passage::{OPPOSITE, share_a_node},
    spots,
    triangle::{Way, passages},
};
use crate::search::{Bounds, Tree};

/// A point that has gone through a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    /// The point.
    pub spot: Spot,
    /// Facet by which it came out.
    pub facet: FacetId,
}

/// The skins of bodies between two configurations.
pub struct MovingSkins<'a> {
    skins: &'a Skins,
    x: [&'a [Vec3]; 2],
    tree: Tree,
    start: OnceLock<PlacedSkins<'a>>,
}

/// A passage of a point through a facet.
struct Passage {
    time: f64,
    way: Way,
    facet: FacetId,
    normal: Vec3,
}

impl<'a> MovingSkins<'a> {
    /// The skins with their nodes at `x[0]`, then at `x[1]`.
    pub fn new(skins: &'a Skins, x: [&'a [Vec3]; 2]) -> Self {
        let facets = skins.surface.facets().iter();
        let boxes = facets.map(|facet| {
            let nodes = distinct_corners(facet).iter();
            Bounds::around(nodes.flat_map(|&node| x.map(|at| at[node])))
        });
        Self {
            skins,
            x,
            tree: Tree::new(boxes.collect()),
            start: OnceLock::new(),
        }
    }

    /// The points that have gone through a body and are `judged` there, by the point and the facet
    /// it came out of; each at the first one.
    pub fn crossings(&self, judged: impl Fn(Spot, FacetId) -> bool + Sync) -> Vec<Crossing> {
        let spots = spots(&self.skins.surface).into_par_iter().with_min_len(32);
        spots
            .filter_map(|spot| self.crossing(spot, &judged))
            .collect()
    }

    fn crossing(&self, spot: Spot, judged: impl Fn(Spot, FacetId) -> bool) -> Option<Crossing> {
        let mut entries: BTreeMap<usize, (Vec3, FacetId)> = BTreeMap::new();
        for passage in self.passages(spot) {
            let body = self.skins.bodies[passage.facet.index()];
            if passage.way == Way::In {
                entries.insert(body, (passage.normal, passage.facet));
                continue;
            }
            let entry = entries.remove(&body);
            let Some((normal, facet)) = entry.or_else(|| self.entered_before(spot, body)) else {
                continue;
            };
            let surface = &self.skins.surface;
            let facets = [facet, passage.facet].map(|facet| surface.facets()[facet.index()]);
            let is_opposite = normal.dot(&passage.normal) < OPPOSITE;
            if is_opposite && !share_a_node(surface, facets) && judged(spot, passage.facet) {
                return Some(Crossing {
                    spot,
                    facet: passage.facet,
                });
            }
        }
        None
    }

    /// Normal and facet where a point that is inside a body at the start is nearest to its skin.
    fn entered_before(&self, spot: Spot, body: usize) -> Option<(Vec3, FacetId)> {
        let start = self
            .start
            .get_or_init(|| PlacedSkins::new(self.skins, self.x[0]));
        let of_body = |_: Spot, facet: FacetId| self.skins.bodies[facet.index()] == body;
        let found = start.overlap(spot, of_body)?;
        let normal = start.area(found.facet).try_normalize(0.0)?;
        Some((normal, found.facet))
    }

    /// Returns whether a point never comes nearer to the first corner of a facet than others are,
    /// as most do not where everything moves far together.
    fn stays_away(&self, path: &[Vec3; 2], corners: &[SurfaceNode; 4]) -> bool {
        let apart = [0, 1].map(|end| path[end] - self.x[end][corners[0]]);
        let mut widest: f64 = 0.0;
        for x in self.x {
            let squares = corners.map(|node| (x[node] - x[corners[0]]).norm_squared());
            widest = squares.into_iter().fold(widest, f64::max);
        }
        let motion = apart[1] - apart[0];
        let nearest = (-apart[0].dot(&motion) / motion.norm_squared()).clamp(0.0, 1.0);
        // Without relative motion it is the start.
        let nearest = if nearest.is_nan() { 0.0 } else { nearest };
        (apart[0] + motion * nearest).norm_squared() > widest
    }

    /// Passages of a point through facets that do not meet there, in the order of time.
    fn passages(&self, spot: Spot) -> Vec<Passage> {
        let surface = &self.skins.surface;
        let around = self.skins.around(spot);
        let path = self.x.map(|x| located(surface, spot, |node| x[node]));
        let bounds = Bounds::around(path).inflated(1e-9 * (path[1] - path[0]).norm());
        let mut all = Vec::new();
        for facet in self.tree.meeting(&bounds) {
            let facet = FacetId(facet);
            if around.contains(&facet) {
                continue;
            }
            let corners = &surface.facets()[facet.index()];
            if self.stays_away(&path, corners) {
                continue;
            }
            let [start, end] = self.x.map(|x| triangles(corners, |node| x[node]));
            for (first, last) in start.into_iter().zip(end) {
                for (time, way) in passages(&path, &[first, last]) {
                    let [a, b, c] = [0, 1, 2].map(|k: usize| first[k].lerp(&last[k], time));
                    let normal = (b - a).cross(&(c - a)).try_normalize(0.0);
                    all.extend(normal.map(|normal| Passage {
                        time,
                        way,
                        facet,
                        normal,
                    }));
                }
            }
        }
        all.sort_by(|a, b| a.time.total_cmp(&b.time));
        all
    }
}
