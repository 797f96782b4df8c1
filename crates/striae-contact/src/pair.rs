//! A contact pair: what does not change during a run.

use serde::Serialize;
use striae_mesh::{FacetId, Vec3};
use striae_surface::{
    node::SurfaceNode,
    texture::{Field, Texture},
    topology::{Surface, distinct_corners},
};

use crate::{side::Side, unknown::Numbering, unknowns::NodeResult};

/// Pressure over the softer modulus below which pressures are not told from zero: without it
/// contact that just closes or has just opened would never be found.
const SMALLEST_PRESSURE: f64 = 1e-4;

/// Two surfaces that may touch. Side 0 (`a`) is deformable.
#[derive(Clone, Debug)]
pub struct ContactPair {
    /// Name for reports.
    pub name: String,
    /// The two sides.
    pub sides: [PairedSurface; 2],
    /// Enforcement of contact.
    pub enforcement: Enforcement,
    /// Distance within which contact is searched; `None`: half the local facet size.
    pub search_distance: Option<f64>,
    /// Surfaces consist of faces, each with nodes of its own on the edges between them, so a node
    /// looks only at facets that face its own.
    pub has_faces: bool,
    /// Both sides are faces of one body, which may lie between them.
    pub one_body: bool,
    /// Coefficients of wear of the sides over their hardness: depth per pressure and slip.
    pub wear: [f64; 2],
    /// Coefficient of wear across the texture over that along it.
    pub wear_across: f64,
}

/// One side of a pair.
#[derive(Clone, Debug)]
pub struct PairedSurface {
    /// Shape and kind.
    pub geometry: Geometry,
    /// Young's modulus of the body behind a deformable side, for the scaling of the complementarity.
    pub stiffness: f64,
    /// Texture, if the side has one.
    pub texture: Option<SideTexture>,
    /// Material behind each facet, where surfaces consist of faces: what overlaps with a facet by
    /// more than half of it faces it through it. Empty where no bound is known.
    pub behind: Vec<Behind>,
    /// Skin that the side is part of, for sides that consist of faces.
    pub enclosure: Option<Enclosure>,
}

/// The skin of a body that a side is part of.
///
/// Faces with nodes of their own, and parts of a skin, have edges beyond which nothing says what is
/// inside the body; their skin has none.
#[derive(Clone, Debug)]
pub struct Enclosure {
    /// The skin, as far as contact knows it.
    pub surface: Surface,
    /// Facets of the side that its facets are; `None` in other parts.
    pub facets: Vec<Option<FacetId>>,
}

/// The body behind a facet.
#[derive(Clone, Debug, PartialEq)]
pub struct Behind {
    /// Its thickness in the reference configuration, infinite where it has no end.
    pub thickness: f64,
    /// Its other side, if that is on a side of the pair.
    pub end: Option<End>,
    /// Facets beyond an edge or a corner of the body, see [`crate::body_edge`].
    pub beyond_edges: Vec<(Side, FacetId)>,
}

/// The end of a fibre through a body, on a side of the pair: the thickness follows the deformation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct End {
    /// The side.
    pub side: Side,
    /// Nodes around the end.
    pub nodes: [SurfaceNode; 4],
    /// Their weights; they sum to one.
    pub weights: [f64; 4],
}

/// Texture of one side of a pair.
#[derive(Clone, Debug)]
pub enum SideTexture {
    /// On the nodes of a surface of facets, deformable or rigid.
    Nodal(Texture),
    /// On a rigid plane, in its reference configuration.
    Plane(Field),
}

/// Shape of a side.
#[derive(Clone, Debug)]
pub enum Geometry {
    /// Surface of a deformable body.
    Deformable(Surface),
    /// Rigid facets.
    Rigid(Surface),
    /// Side `a` once more: its facets may touch each other. It has no nodes of its own.
    Itself,
    /// Unbounded rigid plane.
    Plane {
        /// A point of the plane in the reference configuration.
        point: Vec3,
        /// Unit normal out of the rigid half space.
        normal: Vec3,
    },
}

/// Enforcement of contact.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub enum Enforcement {
    /// One traction field for both sides and rows weighted with it.
    #[default]
    Weighted,
    /// A field on each side and collocated rows, as Jones & Papadopoulos.
    Collocated,
}

impl ContactPair {
    /// Numbers of the pair's unknowns.
    pub fn numbering(&self) -> Numbering {
        Numbering::new(self.carriers())
    }

    /// Returns whether friction wears a side.
    pub fn wears(&self) -> bool {
        self.wear != [0.0; 2]
    }

    /// Side whose texture wear depends on the direction to, if it depends on one: `a`, or `b` where
    /// `a` has none.
    pub fn wears_by(&self) -> Option<Side> {
        let is_directed = self.wears() && self.wear_across != 1.0;
        let mut sides = Side::BOTH.into_iter().filter(|_| is_directed);
        sides.find(|&side| self.sides[side].texture.is_some())
    }

    /// Number of nodes that may bear traction, by side: those of deformable sides.
    pub fn carriers(&self) -> [usize; 2] {
        Side::BOTH.map(|side| match &self.sides[side].geometry {
            Geometry::Deformable(surface) => surface.nodes().len(),
            Geometry::Rigid(_) | Geometry::Itself | Geometry::Plane { .. } => 0,
        })
    }

    /// Stress over which residuals of traction rows count: the largest pressure of the nodes.
    pub fn stress_scale(&self, nodes: &[Vec<NodeResult>; 2]) -> f64 {
        let modulus = self.sides[0].stiffness.min(self.sides[1].stiffness);
        let nodes = nodes.iter().flatten();
        let pressure = nodes.map(|node| node.pressure.abs()).fold(0.0, f64::max);
        pressure.max(SMALLEST_PRESSURE * modulus)
    }

    /// Returns whether the nodes of a side are deformable.
    pub(crate) fn is_deformable(&self, side: Side) -> bool {
        matches!(self.sides[side].geometry, Geometry::Deformable(_))
    }

    /// Returns whether side `b` is rigid.
    pub fn is_rigid(&self) -> bool {
        let geometry = &self.sides[Side::B].geometry;
        matches!(geometry, Geometry::Rigid(_) | Geometry::Plane { .. })
    }

    /// Returns whether facets of side `a` touch each other.
    pub fn is_self_contact(&self) -> bool {
        matches!(self.sides[Side::B].geometry, Geometry::Itself)
    }

    /// Returns whether what lies between facets that face each other may be their own body. Its
    /// skin, not the pair, then determines what is inside.
    pub fn is_in_one_body(&self) -> bool {
        self.one_body || self.is_self_contact()
    }

    /// Sides that carry traction unknowns.
    pub fn deformable_sides(&self) -> &'static [Side] {
        match self.sides[Side::B].geometry {
            Geometry::Deformable(_) => &Side::BOTH,
            Geometry::Rigid(_) | Geometry::Itself | Geometry::Plane { .. } => &[Side::A],
        }
    }

    /// Sides of the two facets of a segment.
    pub fn facing_sides(&self) -> [Side; 2] {
        match self.sides[Side::B].geometry {
            Geometry::Itself => [Side::A; 2],
            Geometry::Deformable(_) | Geometry::Rigid(_) | Geometry::Plane { .. } => Side::BOTH,
        }
    }

    /// The side that a side faces: the other one or, in self-contact, itself.
    pub fn opposing(&self, side: Side) -> Side {
        if self.is_self_contact() {
            side
        } else {
            side.opposite()
        }
    }

    /// Returns whether what a node may face is known from the facets around it.
    pub(crate) fn is_by_faces(&self) -> bool {
        self.has_faces || self.is_self_contact()
    }

    /// Part of the traction field that each of two facets contributes: half of it, or all against
    /// a rigid surface.
    pub fn share(&self) -> f64 {
        if self.is_rigid() { 1.0 } else { 0.5 }
    }
}

impl PairedSurface {
    /// Facets of the side; `None` for a plane, and for side `b` of self-contact.
    pub fn surface(&self) -> Option<&Surface> {
        match &self.geometry {
            Geometry::Deformable(surface) | Geometry::Rigid(surface) => Some(surface),
            Geometry::Itself | Geometry::Plane { .. } => None,
        }
    }
}

/// Square root of the mean area of the facets around every node.
pub(crate) fn local_sizes(surface: &Surface, x: &[Vec3]) -> Vec<f64> {
    let areas: Vec<f64> = surface
        .facets()
        .iter()
        .map(|facet| {
            let corners = distinct_corners(facet);
            let origin = x[corners[0]];
            let fan: Vec3 = corners[1..]
                .windows(2)
                .map(|pair| (x[pair[0]] - origin).cross(&(x[pair[1]] - origin)))
                .sum();
            0.5 * fan.norm()
        })
        .collect();
    SurfaceNode::all(x.len())
        .map(|node| {
            let corners = surface.corners(node);
            let sum: f64 = corners.iter().map(|c| areas[c.facet.index()]).sum();
            (sum / corners.len() as f64).sqrt()
        })
        .collect()
}
