//! Data from which the roles and the traction field of a pair are determined: nodes, common
//! integrals and projections of both surfaces, as plain values.
//!
//! Lengths, areas and moduli in the user's units; `h` is a size of the facets at a
//! node, `E` a modulus of the body behind it.

use crate::side::Side;
use striae_mesh::Vec3;
use striae_surface::node::SurfaceNode;

/// Record of whether a node carried traction unknowns in the last increment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LastIncrement {
    /// The node was kept: it competes with twice its pivot.
    Kept,
    /// The node was not kept.
    NotKept,
}

/// A node of a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InterfaceNode {
    /// Position of the node.
    pub position: Vec3,
    /// `h/E` of the body behind it, zero if rigid or wholly prescribed.
    pub flexibility: f64,
    /// `1/(E h)`, zero if rigid or wholly prescribed.
    pub compliance: f64,
    /// Role in the last increment.
    pub last: LastIncrement,
}

/// Common polygon of two facets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Overlap {
    /// Corners of both facets; a triangle repeats its last one.
    pub corners: [[SurfaceNode; 4]; 2],
    /// `integral N_c N_d` over the polygon, first the corners of the first facet, then those
    /// of the second one. A repeated corner has no mass.
    pub mass: [[f64; 8]; 8],
    /// Unit normal, outward of the first facet.
    pub normal: Vec3,
}

/// A facet of the deformable surface as if it were covered wholly.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FacetMass {
    /// Its corners; a triangle repeats its last one.
    pub corners: [SurfaceNode; 4],
    /// `integral N_c N_d` over the whole facet. A repeated corner has no mass.
    pub mass: [[f64; 4]; 4],
}

/// Corners of the opposing facet and their weights at the projection of a node,
/// clamped to the opposing surface: non-negative, of sum one.
pub type ClampedProjection = ([SurfaceNode; 4], [f64; 4]);

/// Kind of side 1.
#[derive(Clone, Copy, Debug)]
pub enum Opponent<'a> {
    /// A deformable body: nodes of both sides compete.
    Deformable,
    /// A rigid surface: nodes of side 0 only.
    Rigid {
        /// Facets of side 0: at least those that touch a node with an overlap or a
        /// projection.
        whole: &'a [FacetMass],
    },
    /// Side 0 itself: facets of it overlap with each other, and side 1 has no nodes.
    Itself {
        /// Numbers of the nodes of the mesh that the nodes of side 0 are; on an edge between
        /// faces several nodes are one.
        mesh: &'a [u32],
        /// Unit normals at the nodes of side 0.
        normals: &'a [Vec3],
    },
}

/// Two surfaces and what they have in common.
#[derive(Clone, Copy, Debug)]
pub struct Interface<'a> {
    /// Nodes of both sides.
    pub nodes: [&'a [InterfaceNode]; 2],
    /// Common polygons.
    pub overlaps: &'a [Overlap],
    /// For every node its projection if it is within reach.
    pub opposing: [&'a [Option<ClampedProjection>]; 2],
    /// Kind of side 1.
    pub opponent: Opponent<'a>,
    /// Coefficients of wear of both sides over their hardness.
    pub wear: [f64; 2],
}

impl Interface<'_> {
    /// Sides whose nodes carry the field.
    pub(crate) fn sides(&self) -> &'static [Side] {
        match self.opponent {
            Opponent::Deformable => &Side::BOTH,
            Opponent::Rigid { .. } | Opponent::Itself { .. } => &[Side::A],
        }
    }

    /// Sides of the facets of an overlap whose nodes carry the field.
    pub(crate) fn facets(&self) -> &'static [Side] {
        match self.opponent {
            Opponent::Deformable => &Side::BOTH,
            Opponent::Rigid { .. } => &[Side::A],
            Opponent::Itself { .. } => &[Side::A; 2],
        }
    }

    /// Part of the field that each of the facets of an overlap contributes.
    pub(crate) fn share(&self) -> f64 {
        1.0 / self.facets().len() as f64
    }

    /// The side that the nodes of a side face.
    pub(crate) fn opposing_side(&self, side: Side) -> Side {
        match self.opponent {
            Opponent::Itself { .. } => side,
            Opponent::Deformable | Opponent::Rigid { .. } => side.opposite(),
        }
    }

    /// Sign of friction that one node hands on to another one without an overlap: by their sides
    /// or, on one side, by their normals.
    pub(crate) fn sign(&self, nodes: [(Side, SurfaceNode); 2]) -> f64 {
        let [(side, node), (other_side, other)] = nodes;
        match self.opponent {
            Opponent::Itself { normals, .. } => {
                normals[node.index()].dot(&normals[other.index()]).signum()
            }
            _ if side == other_side => 1.0,
            _ => -1.0,
        }
    }
}
