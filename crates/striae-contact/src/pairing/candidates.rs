//! Facets that may be paired with one of the other side.
//!
//! A point of a segment lies on both facets at places whose difference is a gap along the normal
//! of the pair, and somewhere the gap is within the larger reach of both and the depth of
//! overlaps. That normal lies between the normal `n` of a facet and the opposite of `m`, that of the
//! other one. As facets face each other, with `n . m <= FACING`, each of its components is at most
//!
//! ```text
//! N_i = max(|n_i|, |m_i|)/c,    c^2 = (1 - FACING)/2.
//! ```
//!
//! So a facet with the box `B` and the reach `r` is paired with none of a node of the tree over the
//! other side, with the box `C`, the largest reach `R` and normals in a box of their own, where
//!
//! ```text
//! B and C are farther apart than (max(r, R) + depth) min(N_i, 1) along an axis i, or
//! n . m > FACING for all m.
//! ```
//!
//! The largest reach of a whole side, in all directions, would not do: side faces of a thin plate
//! have facets that are much smaller, or much more slender, than those of its upper face, and each
//! would be tried with all of them.

use striae_mesh::{FacetId, Vec3};
use striae_surface::facet::Shape;

use super::{Scope, reach};
use crate::{
    configuration::{BEYOND, Configuration, Snapshot},
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
    /// Of each alone.
    facets: Vec<Group>,
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
        let (facets, nodes) = match configuration.plane() {
            Some(_) => (Vec::new(), Vec::new()),
            None => {
                let facing = configuration.facing(Side::A);
                let all = (0..facing.surface.facets().len()).map(FacetId::new);
                let facets: Vec<_> = all.map(|facet| group(configuration, facet)).collect();
                let nodes = facing
                    .tree()
                    .joined(|facet| facets[facet as usize], Group::join);
                (facets, nodes)
            }
        };
        Self {
            configuration,
            depth: scope.depth,
            facets,
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
        let [p, q, r, s] = own.corner_positions(facet);
        let area = 0.5 * (r - p).cross(&(s - q)).norm();
        let beyond = BEYOND * area.sqrt();
        let shortest = (0.5 * (1.0 - FACING)).sqrt();
        let may_meet = |of: &Bounds, group: &Group| {
            let distance = reach.max(group.reach) + self.depth;
            let normals = n.abs().sup(&group.normals.largest()) / shortest;
            let margins = normals.map(|largest| distance * largest.min(1.0) + beyond);
            of.meets(&bounds.inflated_along(&margins))
                && group.normals.least_along(&n) <= FACING + ROUND_OFF
        };
        let tree = configuration.facing(Side::A).tree();
        tree.found(
            |node, of| may_meet(of, &self.nodes[node]),
            |facet, of| may_meet(of, &self.facets[facet as usize]),
        )
    }
}

/// One facet of the side that side `a` faces.
fn group(configuration: &Configuration, facet: FacetId) -> Group {
    let all = Bounds {
        low: Vec3::repeat(-1.0),
        high: Vec3::repeat(1.0),
    };
    let [_, side] = configuration.pair.facing_sides();
    let facing = configuration.side(side);
    Group {
        reach: match configuration.pair.is_rigid() {
            // A rigid facet reaches no farther than the other one.
            true => 0.0,
            false => reach(configuration, side, &facing.corners(facet)),
        },
        normals: normal(facing, facet).map_or(all, |normal| Bounds::around([normal])),
    }
}

fn normal(side: &Snapshot, facet: FacetId) -> Option<Vec3> {
    facet_normal(&Facet {
        corners: side.corner_positions(facet),
        shape: Shape::of(&side.corners(facet)),
    })
}
