//! Nodes of a side that see the other side, and their distances.

use nalgebra::Vector3;
use striae_mesh::{FacetId, Vec3};
use striae_surface::{facet::Shape, node::SurfaceNode};

use crate::{
    configuration::Configuration,
    projection::{Hit, Ray, nearest_edge, project},
    segment::{FACING, Facet, facet_normal},
    side::Side,
};

/// Visibility of the other side along the normal of a node.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Coverage {
    /// The other side within reach.
    Near(Contact),
    /// The other side, but out of reach.
    Far,
    /// Nothing.
    Missed,
}

/// The point opposite to a node.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact {
    /// Gap, positive when open.
    pub gap: f64,
    /// Place of the point.
    pub place: Place,
}

/// A place on the other side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Place {
    /// On a facet.
    Facet(Hit),
    /// On a plane.
    Plane(Vec3),
}

/// Place at which a node finds the point opposite to it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Found {
    /// Along the normal.
    Inside,
    /// At the nearest place of the edge of the surface, between these nodes, as the normal
    /// passes beside it.
    Edge([SurfaceNode; 2]),
}

/// Distance, in reaches, up to which a surface counts as seen, though out of reach.
const HORIZON: f64 = 20.0;

/// Distance, in reaches, around a node within which a rigid surface is searched.
const FOLLOW: f64 = 6.0;

impl Configuration<'_> {
    /// The point opposite to a node of a deformable side within `reach`.
    pub fn contact(&self, side: Side, node: SurfaceNode, reach: f64) -> Option<Contact> {
        let own = self.side(side);
        let (x, n) = (own.x[node], own.normals[node]);
        self.contact_of(side, x, n, reach, |facet, gap| {
            self.may_face(side, node, facet, gap)
        })
    }

    /// The point opposite to the point `x` on those facets that are admitted at the gap to them.
    pub(crate) fn contact_of(
        &self,
        side: Side,
        x: Vec3,
        n: Vec3,
        reach: f64,
        admits: impl Fn(FacetId, f64) -> bool,
    ) -> Option<Contact> {
        if let Some((point, normal)) = self.plane() {
            let gap = (x - point).dot(&normal);
            return (gap.abs() <= reach).then(|| Contact {
                gap,
                place: Place::Plane(x - normal * gap),
            });
        }
        // Rows against a rigid surface use its normals, so its normal is the direction of the gap,
        // too.
        let ray = if self.pair.is_rigid() {
            Ray::Opposite
        } else {
            Ray::Own(n)
        };
        let hit = project(self.facing(side), &x, ray, reach, admits)?;
        Some(Contact {
            gap: hit.gap,
            place: Place::Facet(hit),
        })
    }

    /// The point opposite to a node of a deformable side, clamped to the other surface.
    pub fn opposite(&self, side: Side, node: SurfaceNode) -> Option<(Contact, Found)> {
        self.opposite_on(side, node, |_| true)
    }

    /// The opposite point on some facets of the other surface, if that is not a plane.
    pub(crate) fn opposite_on(
        &self,
        side: Side,
        node: SurfaceNode,
        on: impl Fn(FacetId) -> bool,
    ) -> Option<(Contact, Found)> {
        // Frames against rigid surfaces are those of the projection, which is needed beside the
        // edge as well, but not far from it.
        let far = if self.pair.is_rigid() {
            FOLLOW
        } else {
            HORIZON
        };
        let reach = far * self.reach(side, node);
        if self.plane().is_some() {
            let contact = self.contact(side, node, f64::INFINITY);
            return contact.map(|contact| (contact, Found::Inside));
        }
        let own = self.side(side);
        let (x, n) = (&own.x[node], &own.normals[node]);
        let admits = |facet: FacetId, gap: f64| on(facet) && self.may_face(side, node, facet, gap);
        if let Some(contact) = self.contact_of(side, *x, *n, reach, admits) {
            return Some((contact, Found::Inside));
        }
        let (hit, nodes) = nearest_edge(self.facing(side), x, n, reach, admits)?;
        let contact = Contact {
            gap: hit.gap,
            place: Place::Facet(hit),
        };
        Some((contact, Found::Edge(nodes)))
    }

    /// Returns whether a node may face a facet at this gap: where surfaces consist of faces, one
    /// that looks towards it and that no body lies between; in self-contact not one of its own.
    fn may_face(&self, side: Side, node: SurfaceNode, facet: FacetId, gap: f64) -> bool {
        if !self.pair.is_by_faces() {
            return true;
        }
        let (own, other) = (self.side(side), self.facing(side));
        let around = own.surface.corners(node).iter();
        let depths = around.map(|corner| self.depth(side, corner.facet));
        let opposite = self.depth(self.pair.opposing(side), facet);
        let deepest = self.deepest([depths.fold(f64::INFINITY, f64::min), opposite]);
        if -gap > deepest || self.pair.is_rigid() {
            return -gap <= deepest;
        }
        let corners = other.corners(facet);
        let normal = facet_normal(&Facet {
            corners: other.corner_positions(facet),
            shape: Shape::of(&corners),
        });
        let faces = |normal: Vec3| normal.dot(&own.normals[node]) <= FACING;
        normal.is_some_and(faces)
            && !(self.pair.is_in_one_body() && self.is_corner(side, node, facet))
    }

    /// Returns whether the middle of the first facet may face the second one at this gap.
    pub(crate) fn facets_may_face(&self, side: Side, facets: [FacetId; 2], gap: f64) -> bool {
        let sides = [side, self.pair.opposing(side)];
        let deepest = self.deepest([0, 1].map(|at| self.depth(sides[at], facets[at])));
        let mut corners = self.side(side).corners(facets[0]).into_iter();
        -gap <= deepest
            && !(self.pair.is_in_one_body()
                && corners.any(|corner| self.is_corner(side, corner, facets[1])))
    }

    /// Returns whether a node is one node of the mesh with a corner of a facet that faces its side.
    fn is_corner(&self, side: Side, node: SurfaceNode, facet: FacetId) -> bool {
        let (own, other) = (self.side(side), self.facing(side));
        let node = own.surface.nodes()[node.index()];
        let mut corners = other.corners(facet).into_iter();
        corners.any(|corner| other.surface.nodes()[corner.index()] == node)
    }

    /// Visibility of the other side from a node of a deformable side.
    pub fn coverage(&self, side: Side, node: SurfaceNode) -> Coverage {
        let reach = self.reach(side, node);
        match self.contact(side, node, HORIZON * reach) {
            Some(contact) if contact.gap.abs() <= reach => Coverage::Near(contact),
            Some(_) => Coverage::Far,
            // An unbounded plane cannot be missed.
            None if self.plane().is_some() => Coverage::Far,
            None => Coverage::Missed,
        }
    }
}

impl Place {
    /// Weights of the corners of the facet, zero elsewhere on the surface.
    pub fn weights(
        &self,
        configuration: &Configuration,
        side: Side,
    ) -> Option<([SurfaceNode; 4], [f64; 4])> {
        match self {
            Place::Facet(hit) => {
                let corners = configuration.facing(side).corners(hit.facet);
                let shape = Shape::of(&corners);
                Some((corners, shape.weights(hit.xi, hit.eta).value))
            }
            Place::Plane(_) => None,
        }
    }

    /// The point in space.
    pub fn point(&self, configuration: &Configuration, side: Side) -> Vec3 {
        match self {
            Place::Plane(point) => *point,
            Place::Facet(_) => self.weights(configuration, side).map_or_else(
                Vector3::zeros,
                |(corners, weights)| {
                    let x = &configuration.facing(side).x;
                    (0..4).map(|c| x[corners[c]] * weights[c]).sum()
                },
            ),
        }
    }
}
