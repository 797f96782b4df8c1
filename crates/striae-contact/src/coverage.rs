//! Which nodes of a side see the other side, and at what distance.

use nalgebra::Vector3;
use striae_mesh::Vec3;
use striae_surface::node::SurfaceNode;

use crate::{
    configuration::Configuration,
    projection::{Hit, Ray, nearest_edge, project},
    side::Side,
};

/// What a node sees along its normal.
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
    /// Where the point is.
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

/// Where a node finds the point opposite to it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Found {
    /// Along the normal.
    Inside,
    /// At the nearest place of the edge of the surface, between these nodes, as the normal
    /// passes beside it.
    Edge([SurfaceNode; 2]),
}

/// How many reaches away a surface counts as seen, though out of reach.
const HORIZON: f64 = 20.0;

/// How many reaches around a node a rigid surface is looked for.
const FOLLOW: f64 = 6.0;

impl Configuration<'_> {
    /// The point opposite to a node of a deformable side within `reach`.
    pub fn contact(&self, side: Side, node: SurfaceNode, reach: f64) -> Option<Contact> {
        let own = self.side(side);
        self.contact_at(side, own.x[node], own.normals[node], reach)
    }

    /// The point opposite to the point `x` with the normal `n` of a deformable side.
    pub fn contact_at(&self, side: Side, x: Vec3, n: Vec3, reach: f64) -> Option<Contact> {
        if let Some((point, normal)) = self.plane() {
            let gap = (x - point).dot(&normal);
            return (gap.abs() <= reach).then(|| Contact {
                gap,
                place: Place::Plane(x - normal * gap),
            });
        }
        let ray = if self.pair.is_rigid() {
            Ray::Opposite
        } else {
            Ray::Own(n)
        };
        let hit = project(self.side(side.opposite()), &x, ray, reach)?;
        Some(Contact {
            gap: hit.gap,
            place: Place::Facet(hit),
        })
    }

    /// The point opposite to a node of a deformable side, clamped to the other surface.
    pub fn opposite(&self, side: Side, node: SurfaceNode) -> Option<(Contact, Found)> {
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
        if let Some(contact) = self.contact(side, node, reach) {
            return Some((contact, Found::Inside));
        }
        let own = self.side(side);
        let (x, n) = (&own.x[node], &own.normals[node]);
        let (hit, nodes) = nearest_edge(self.side(side.opposite()), x, n, reach)?;
        let contact = Contact {
            gap: hit.gap,
            place: Place::Facet(hit),
        };
        Some((contact, Found::Edge(nodes)))
    }

    /// What a node of a deformable side sees.
    pub fn coverage(&self, side: Side, node: SurfaceNode) -> Coverage {
        let reach = self.reach(side, node);
        match self.contact(side, node, HORIZON * reach) {
            Some(contact) if contact.gap.abs() <= reach => Coverage::Near(contact),
            Some(_) => Coverage::Far,
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
                let corners = configuration.side(side.opposite()).corners(hit.facet);
                let shape = striae_surface::facet::Shape::of(&corners);
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
                    let x = &configuration.side(side.opposite()).x;
                    (0..4).map(|c| x[corners[c]] * weights[c]).sum()
                },
            ),
        }
    }
}
