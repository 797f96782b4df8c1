//! Facets that may be paired with one of the other side.
//!
//! A facet with the box `B`, reach `r` and normal `n` is paired with none of a node of the tree over
//! the other side, with the box `C`, the largest reach `R` and a box of normals `m`, where
//!
//! ```text
//! the distance of B and C is above max(r, R) + depth, or   n . m > FACING   for all m.
//! ```
//!
//! The largest reach of a whole side would not do: side faces of a thin plate have facets that are
//! much smaller than those of its upper face, so that each would be tried with all of them. Nor would
//! distances alone, as facets of one face are near each other, too.

use striae_mesh::{FacetId, Vec3};
use striae_surface::facet::Shape;

use super::{Scope, reach};
use crate::{
    configuration::{Configuration, Snapshot},
    search::Bounds,
    segment::{FACING, Facet, facet_normal},
    side::Side,
};

/// Round-off of a cosine.
const ROUND_OFF: f64 = 1e-9;

/// Facets of the side that side `a` faces.
pub(super) struct Candidates<'a> {
    configuration: &'a Configuration<'a>,
    depth: f64,
    /// Of the nodes of the tree.
    nodes: Vec<Group>,
}

/// Facets together.
#[derive(Clone, Copy, Debug)]
struct Group {
    /// Largest reach, where it counts.
    reach: f64,
    /// Box around the normals.
    normals: Bounds,
}

impl Group {
    fn join(self, other: Self) -> Self {
        Self {
            reach: self.reach.max(other.reach),
            normals: self.normals.union(&other.normals),
        }
    }
}

impl<'a> Candidates<'a> {
    /// Facets of the side that side `a` faces; of a plane none.
    pub(super) fn new(configuration: &'a Configuration<'a>, scope: Scope) -> Self {
        let nodes = match configuration.plane() {
            Some(_) => Vec::new(),
            None => {
                let tree = &configuration.facing(Side::A).tree;
                tree.joined(|facet| group(configuration, FacetId(facet)), Group::join)
            }
        };
        Self {
            configuration,
            depth: scope.depth,
            nodes,
        }
    }

    /// The configuration that they are facets of.
    pub(super) fn configuration(&self) -> &'a Configuration<'a> {
        self.configuration
    }

    /// Facets for one of side `a` with a reach, ascending.
    pub(super) fn of(&self, facet: FacetId, reach: f64) -> Vec<u32> {
        let configuration = self.configuration;
        let own = configuration.side(Side::A);
        let Some(n) = normal(own, facet) else {
            return Vec::new();
        };
        let bounds = own.bounds(facet);
        let is_near =
            |of: &Bounds, others: f64| of.meets(&bounds.inflated(reach.max(others) + self.depth));
        let tree = &configuration.facing(Side::A).tree;
        tree.found(
            |node, of| {
                let group = &self.nodes[node];
                is_near(of, group.reach) && group.normals.least_along(&n) <= FACING + ROUND_OFF
            },
            |facet, of| is_near(of, reach_of(configuration, FacetId(facet))),
        )
    }
}

/// One facet of the side that side `a` faces.
fn group(configuration: &Configuration, facet: FacetId) -> Group {
    let all = Bounds {
        low: Vec3::repeat(-1.0),
        high: Vec3::repeat(1.0),
    };
    let normal = normal(configuration.facing(Side::A), facet);
    Group {
        reach: reach_of(configuration, facet),
        normals: normal.map_or(all, |normal| Bounds::around([normal])),
    }
}

/// Reach of a facet of the side that side `a` faces; a rigid one has none.
fn reach_of(configuration: &Configuration, facet: FacetId) -> f64 {
    let [_, side] = configuration.pair.facing_sides();
    match configuration.pair.is_rigid() {
        true => 0.0,
        false => reach(
            configuration,
            side,
            &configuration.side(side).corners(facet),
        ),
    }
}

fn normal(side: &Snapshot, facet: FacetId) -> Option<Vec3> {
    facet_normal(&Facet {
        corners: side.corner_positions(facet),
        shape: Shape::of(&side.corners(facet)),
    })
}
