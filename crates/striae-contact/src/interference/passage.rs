//! Points that pass through moving facets.
//!
//! A point that goes through a facet from its front is followed from there on, in steps
//! of a quarter of a facet of relative motion: how deep it is behind the nearest facet
//! while it is behind one. If it ends in front again, and has come out the way it went
//! in, the passage is one of the straight lines only; if it comes out on the other side,
//! it has gone through the body. Facets that share a node are no two sides: what goes in at one and
//! out at the other has gone around an edge.

use striae_mesh::{FacetId, Vec3};
use striae_surface::{
    node::SurfaceNode,
    topology::{Surface, distinct_corners},
};

use super::{
    Spot, located,
    nearest::{Nearest, Placed, Standing, triangles},
    of_side_itself,
    triangle::{Way, passages},
};
use crate::{
    configuration::Snapshot,
    search::{Bounds, Tree},
};

/// A side between two configurations.
pub(super) struct Moving<'a> {
    at: [&'a Snapshot<'a>; 2],
    /// The side or, where it is known, the skin that it is part of.
    skin: [Skin<'a>; 2],
    tree: Tree,
    thickness: f64,
}

/// A surface in one configuration.
#[derive(Clone, Copy)]
struct Skin<'a> {
    surface: &'a Surface,
    x: &'a [Vec3],
    sizes: &'a [f64],
}

impl<'a> Skin<'a> {
    fn of(side: &'a Snapshot<'a>) -> Self {
        let whole = side.enclosed.as_ref();
        let own = Self {
            surface: side.surface,
            x: &side.x,
            sizes: &side.sizes,
        };
        whole.map_or(own, |whole| Self {
            surface: &whole.enclosure.surface,
            x: &whole.x,
            sizes: &whole.sizes,
        })
    }

    fn corners(&self, facet: u32) -> &'a [SurfaceNode; 4] {
        &self.surface.facets()[facet as usize]
    }
}

/// A passage through a facet.
struct Passage {
    time: f64,
    way: Way,
    facet: u32,
    normal: Vec3,
}

/// Result of the path of a point through a surface.
pub(super) enum Through {
    /// Into the surface, and how deep.
    Surface(Nearest),
    /// Into the surface and out on the other side; where that is nearest at the end.
    Body(Nearest),
}

/// Cosine between the normals where a point goes in and out that makes it a way through.
pub(super) const OPPOSITE: f64 = -0.2;
/// Steps over a facet of relative motion, and most of them.
const STEPS: f64 = 4.0;
const MOST_STEPS: f64 = 64.0;

impl<'a> Moving<'a> {
    pub(super) fn new(at: [&'a Snapshot<'a>; 2], thickness: f64) -> Self {
        let skin = at.map(Skin::of);
        Self {
            tree: swept_tree(&skin),
            at,
            skin,
            thickness,
        }
    }

    /// Returns whether any parts of the sides, or of the bodies behind their facets, can meet.
    pub(super) fn may_meet(&self, other: &Self) -> bool {
        let boxes = (self.tree.bounds(), other.tree.bounds());
        let (Some(own), Some(others)) = boxes else {
            return false;
        };
        own.inflated(self.thickness)
            .meets(&others.inflated(other.thickness))
    }

    /// Positions of a point at both ends.
    pub(super) fn path(&self, spot: Spot) -> [Vec3; 2] {
        let place = |at: &Snapshot| located(at.surface, spot, |node| at.x[node]);
        self.at.map(place)
    }

    /// Passage of a point through the surface; `before` is its place inside at the start.
    pub(super) fn passed_by(
        &self,
        path: &[Vec3; 2],
        before: impl FnOnce() -> Option<Nearest>,
    ) -> Option<Through> {
        let bounds = Bounds::around(*path);
        let near = self
            .tree
            .meeting(&bounds.inflated(1e-9 * (path[1] - path[0]).norm()));
        let first = *near.first()?;
        let through = self.passages(path, &near);
        let inward = through.iter().find(|passage| passage.way == Way::In);
        let inward = inward.map(|passage| (passage.time, passage.normal, passage.facet));
        let before = before().map(|known| (0.0, known.normal, self.of_skin(known.facet)));
        let (since, normal, entry) = before.or(inward)?;
        let normal = normal.normalize();
        let out = through
            .iter()
            .filter(|p| p.way == Way::Out && p.time >= since);
        let ways: Vec<(f64, u32)> = out
            .map(|p| (p.normal.normalize().dot(&normal), p.facet))
            .collect();
        let end = self.placed(1.0).nearest(&path[1])?;
        let corners = |facet: u32| self.skin[0].surface.facets()[facet as usize];
        let meet = |exit: u32| share_a_node(self.skin[0].surface, [corners(entry), corners(exit)]);
        if ways
            .iter()
            .any(|&(cosine, exit)| cosine < OPPOSITE && !meet(exit))
        {
            return self.of_side(end).map(Through::Body);
        }
        if end.standing == Standing::Front && ways.iter().any(|(cosine, _)| *cosine > 0.0) {
            return None;
        }
        let deepest = self.deepest(path, since, self.steps(path, first))?;
        self.of_side(deepest).map(Through::Surface)
    }

    /// The facet of the skin that one of the side is.
    fn of_skin(&self, facet: FacetId) -> u32 {
        let enclosed = self.at[0].enclosed.as_ref();
        let of_skin = enclosed.and_then(|enclosed| {
            let mut facets = enclosed.enclosure.facets.iter();
            facets.position(|of_side| *of_side == Some(facet))
        });
        of_skin.map_or(facet.0, |at| at as u32)
    }

    /// A point of the skin as one of the side; `None` if it belongs to another part.
    fn of_side(&self, nearest: Nearest) -> Option<Nearest> {
        match &self.at[1].enclosed {
            Some(enclosed) => of_side_itself(enclosed.enclosure, nearest),
            None => Some(nearest),
        }
    }

    fn passages(&self, path: &[Vec3; 2], near: &[u32]) -> Vec<Passage> {
        let mut all = Vec::new();
        for &facet in near {
            let corners = self.skin[0].corners(facet);
            let [start, end] = self.skin.map(|at| triangles(corners, |node| at.x[node]));
            for (first, last) in start.into_iter().zip(end) {
                for (time, way) in passages(path, &[first, last]) {
                    let [a, b, c] = [0, 1, 2].map(|k: usize| first[k].lerp(&last[k], time));
                    let normal = (b - a).cross(&(c - a));
                    all.push(Passage {
                        time,
                        way,
                        facet,
                        normal,
                    });
                }
            }
        }
        all.sort_by(|a, b| a.time.total_cmp(&b.time));
        all
    }

    fn placed(&self, time: f64) -> Placed<'_, impl Fn(SurfaceNode) -> Vec3> {
        let at = self.skin;
        Placed {
            surface: at[0].surface,
            tree: &self.tree,
            x: move |node| at[0].x[node].lerp(&at[1].x[node], time),
        }
    }

    /// Steps that follow a point over the facets near it.
    fn steps(&self, path: &[Vec3; 2], facet: u32) -> usize {
        let [start, end] = self.skin;
        let node = start.corners(facet)[0];
        let motion = (path[1] - path[0] - (end.x[node] - start.x[node])).norm();
        (STEPS * motion / end.sizes[node])
            .ceil()
            .clamp(1.0, MOST_STEPS) as usize
    }

    /// Deepest position of the point behind the surface after the time `since`.
    fn deepest(&self, path: &[Vec3; 2], since: f64, steps: usize) -> Option<Nearest> {
        let mut deepest: Option<Nearest> = None;
        for step in 1..=steps {
            let time = since + (1.0 - since) * step as f64 / steps as f64;
            let nearest = self.placed(time).nearest(&path[0].lerp(&path[1], time))?;
            let is_deeper = |known: &Nearest| nearest.distance > known.distance;
            if nearest.standing == Standing::Behind && deepest.as_ref().is_none_or(is_deeper) {
                deepest = Some(nearest);
            }
        }
        deepest
    }
}

/// Returns whether two facets, by their corners, have a node in common.
pub(super) fn share_a_node(surface: &Surface, facets: [[SurfaceNode; 4]; 2]) -> bool {
    let [first, second] = facets.map(|corners| corners.map(|node| surface.nodes()[node.index()]));
    first.iter().any(|node| second.contains(node))
}

/// The box around a facet on its way.
fn swept_box(at: &[Skin; 2], facet: &[SurfaceNode; 4]) -> Bounds {
    let corners = distinct_corners(facet).iter();
    Bounds::around(corners.flat_map(|&node| at.map(|skin| skin.x[node])))
}

/// A tree over the swept boxes of the facets.
fn swept_tree(at: &[Skin; 2]) -> Tree {
    let facets = at[0].surface.facets().iter();
    Tree::new(facets.map(|facet| swept_box(at, facet)).collect())
}
