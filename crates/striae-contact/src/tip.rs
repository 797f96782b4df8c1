//! What is pointed: a node, or a point of a rigid surface.
//!
//! A point of a rigid surface is a vertex or a point on an edge. It is told by the ends of
//! that edge and the share of the way between them, so it goes along with the surface.

use serde::{Deserialize, Serialize};
use striae_mesh::{FacetId, Vec3};
use striae_surface::node::SurfaceNode;

use crate::{configuration::Configuration, pairing::farthest, side::Side, term::Source};

/// A point of a rigid surface of facets, `x = (1 - s) x_0 + s x_1`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct RigidPoint {
    /// Surface-local ends of the edge that it lies on; both the same at a vertex.
    pub ends: [SurfaceNode; 2],
    /// Share `s` of the way from the first to the second.
    pub share: f64,
    /// Depth that its row leaves to it.
    pub left: f64,
}

/// Points of a rigid surface with traction unknowns, by the node of side `a` that they lodge
/// with; empty where side `b` is no rigid surface of facets.
pub type RigidPoints = Vec<Option<RigidPoint>>;

impl RigidPoint {
    /// A vertex.
    pub fn vertex(node: SurfaceNode) -> Self {
        Self {
            ends: [node; 2],
            share: 0.0,
            left: 0.0,
        }
    }

    /// The same point with a depth that is left to it.
    pub fn leaving(self, left: f64) -> Self {
        Self { left, ..self }
    }

    /// Where it is.
    pub fn position(&self, configuration: &Configuration) -> Vec3 {
        self.between(&configuration.side(Side::B).x)
    }

    /// Unit normal, between those of the ends.
    pub fn normal(&self, configuration: &Configuration) -> Vec3 {
        let normals = &configuration.side(Side::B).normals;
        let between = self.between(normals);
        between.try_normalize(1e-6).unwrap_or(normals[self.ends[0]])
    }

    fn between(&self, of_nodes: &[Vec3]) -> Vec3 {
        let [start, end] = self.ends.map(|node| of_nodes[node]);
        start + (end - start) * self.share
    }
}

/// What is pointed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Tip {
    /// A node of a deformable side.
    Node {
        /// The side.
        side: Side,
        /// Surface-local node.
        node: SurfaceNode,
        /// The opposing facet that it was in at the start of the increment.
        home: Option<FacetId>,
    },
    /// A point of the rigid side `b`.
    Rigid(RigidPoint),
}

impl Tip {
    /// Depth that is left to it: its row states `g + left` for the gap.
    pub fn left(&self) -> f64 {
        match self {
            Self::Node { .. } => 0.0,
            Self::Rigid(point) => point.left,
        }
    }

    /// Its side.
    pub fn side(&self) -> Side {
        match self {
            Self::Node { side, .. } => *side,
            Self::Rigid(_) => Side::B,
        }
    }

    /// Where it is.
    pub fn position(&self, configuration: &Configuration) -> Vec3 {
        match self {
            Self::Node { side, node, .. } => configuration.side(*side).x[*node],
            Self::Rigid(point) => point.position(configuration),
        }
    }

    /// Unit outward normal of its own surface.
    pub fn normal(&self, configuration: &Configuration) -> Vec3 {
        match self {
            Self::Node { side, node, .. } => configuration.side(*side).normals[*node],
            Self::Rigid(point) => point.normal(configuration),
        }
    }

    /// Distance within which it looks for the other side.
    pub fn reach(&self, configuration: &Configuration) -> f64 {
        match self {
            Self::Node { side, node, .. } => configuration.reach(*side, *node),
            Self::Rigid(_) => farthest(configuration),
        }
    }

    /// First of its position unknowns; a rigid point has none.
    pub fn unknown(&self, configuration: &Configuration) -> Option<u32> {
        match self {
            Self::Node { side, node, .. } => {
                Some(configuration.pair.numbering().position(*side, *node))
            }
            Self::Rigid(_) => None,
        }
    }

    /// The three lanes of its position.
    pub fn lanes<'a>(&self, configuration: &Configuration) -> Source<'a> {
        match self.unknown(configuration) {
            Some(first) => Source::Unknowns { first, count: 3 },
            None => Source::Constant(3),
        }
    }

    /// Whether nodes of the side that it presses on can move.
    pub(crate) fn presses_on_deformable(&self, configuration: &Configuration) -> bool {
        configuration.pair.is_deformable(self.side().opposite())
    }
}
