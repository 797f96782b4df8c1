//! Errors of textures.

use crate::node::SurfaceNode;
use striae_mesh::FacetId;

/// Reason why a texture cannot be painted or convected; nodes are numbered as in the surface.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum TextureError {
    /// A list has another length than the surface has nodes.
    #[error("{found} {what} for a surface of {nodes} nodes")]
    Count {
        /// Name of the listed quantity.
        what: &'static str,
        /// Number given.
        found: usize,
        /// Nodes of the surface.
        nodes: usize,
    },
    /// A facet or a painted place names a node that does not exist.
    #[error("{node} does not exist: the surface has {nodes} nodes")]
    MissingNode {
        /// The node that is named.
        node: SurfaceNode,
        /// Nodes of the surface.
        nodes: usize,
    },
    /// A corner of a facet is flat, or folded against the nodal normal.
    #[error(
        "{facet} is degenerate or folded at {node}: its edges there span no area facing along the nodal normal"
    )]
    DegenerateFacet {
        /// The facet.
        facet: FacetId,
        /// The corner.
        node: SurfaceNode,
    },
    /// No facet has this node.
    #[error("{node} belongs to no facet, so it has no tangent plane")]
    LooseNode {
        /// The node.
        node: SurfaceNode,
    },
    /// Interpolation from no places at all.
    #[error("no direction is painted anywhere")]
    NothingPainted,
    /// Two painted places fall on the same node.
    #[error(
        "{node} is painted twice: it is the nearest node of two painted places; remove one of them or refine the surface"
    )]
    PaintedTwice {
        /// The node.
        node: SurfaceNode,
    },
    /// A part of the surface is not connected with any painted place.
    #[error("{node} is in a part of the surface on which no direction is painted")]
    Unpainted {
        /// First node of that part.
        node: SurfaceNode,
    },
    /// The width of the interpolation is not a positive number.
    #[error("the width of the interpolation must be positive, not {width}")]
    Width {
        /// The width.
        width: f64,
    },
    /// The interpolation is not positive definite, so it would oscillate.
    #[error(
        "the interpolation of width {width} is not positive definite (smallest eigenvalue {smallest_eigenvalue:.1e}) and would oscillate; a width of {advice} is safe"
    )]
    IndefiniteKernel {
        /// The width.
        width: f64,
        /// Smallest eigenvalue of the kernel matrix.
        smallest_eigenvalue: f64,
        /// A width for which the kernel is positive definite.
        advice: f64,
    },
    /// The direction is zero or along the normal.
    #[error("the direction at {node} has no tangential part")]
    Vanishing {
        /// The node.
        node: SurfaceNode,
    },
}

impl TextureError {
    /// The surface node it is about, if it is about one.
    pub fn node(&self) -> Option<SurfaceNode> {
        match *self {
            Self::MissingNode { node, .. }
            | Self::DegenerateFacet { node, .. }
            | Self::LooseNode { node }
            | Self::PaintedTwice { node }
            | Self::Unpainted { node }
            | Self::Vanishing { node } => Some(node),
            Self::Count { .. }
            | Self::NothingPainted
            | Self::Width { .. }
            | Self::IndefiniteKernel { .. } => None,
        }
    }
}

/// Reason why a texture refuses a value.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{reason}")]
pub struct InadmissibleTexture {
    /// Parameter that it is about, if it is about one.
    pub parameter: Option<&'static str>,
    /// Reason, which names the value.
    pub reason: String,
}
