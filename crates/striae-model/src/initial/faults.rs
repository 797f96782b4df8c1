//! Faults that only meshes in their places show.

use striae_mesh::{ElementId, NodeId, Vec3, place, significant};

/// Faults of meshes that cannot be simulated as they lie.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum InitialFault {
    /// Bodies overlap.
    #[error(
        "pair `{pair}`: `{body}` is {depth} inside `{other}` at {}, next to its {node}; that is {:.0} % of the local facet size. {}",
        place(at), 100.0 * share, closing.remedy(),
        depth = significant(*depth, 4))]
    Overlap {
        /// Name of the pair.
        pair: String,
        /// Body or rigid surface of the node.
        body: String,
        /// The node.
        node: NodeId,
        /// Name of the one that it is inside of.
        other: String,
        /// Position of the place.
        at: Vec3,
        /// Depth.
        depth: f64,
        /// Depth over the local facet size.
        share: f64,
        /// Tells if nodes have been moved against it.
        closing: Closing,
    },
    /// Bodies overlap by so much that their other side is nearer.
    #[error(
        "pair `{pair}`: `{body}` is {depth} inside `{other}` at {}, next to its {node}, which is {:.0} % of the thickness of `{other}` there, {thickness}, and {:.0} % of the local facet size {size}. Overlaps can be resolved up to half the thickness; beyond that, the other side of `{other}` is nearer. Separate the bodies in the mesh, or bring them together in a step",
        place(at), 100.0 * depth / thickness, 100.0 * depth / size,
        depth = significant(*depth, 4), thickness = significant(*thickness, 4), size = significant(*size, 4))]
    Deep {
        /// Name of the pair.
        pair: String,
        /// Body or rigid surface of the node.
        body: String,
        /// The node.
        node: NodeId,
        /// Name of the one that it is inside of.
        other: String,
        /// Position of the place.
        at: Vec3,
        /// Depth.
        depth: f64,
        /// Thickness of the other one there.
        thickness: f64,
        /// The local facet size.
        size: f64,
    },
    /// No faces are near enough to be taken as touching.
    #[error(
        "pair `{pair}`: `interference` is measured from touching faces, but the two sides do not face each other within the search distance of the pair (by default half a facet); the smallest gap is {gap}. Set `search_distance` above the gap between the fitting faces, or close the gap in the mesh",
        gap = significant(*gap, 4))]
    Unseated {
        /// Name of the pair.
        pair: String,
        /// The smallest gap.
        gap: f64,
    },
    /// A body is on the wrong side of a rigid surface.
    #[error(
        "pair `{pair}`: body `{body}` is entirely behind `{rigid}`, which faces away from it; reverse {}, or exclude this contact if `{rigid}` is meant for another body",
        reversal.of(rigid)
    )]
    Behind {
        /// Name of the pair.
        pair: String,
        /// The body.
        body: String,
        /// The rigid surface.
        rigid: String,
        /// Part of its statement to reverse.
        reversal: Reversal,
    },
    /// The sides do not face each other, as where facets are turned inside out.
    #[error(
        "pair `{pair}`: the surface of `{body}` faces away from that of `{other}`, so they cannot touch: at {node} of `{body}`, {}, their normals are {angle:.0} degrees apart, and 180 would be face to face. {}",
        place(at),
        turning(rigid)
    )]
    Away {
        /// Name of the pair.
        pair: String,
        /// Body or rigid surface of the node.
        body: String,
        /// Name of the other one.
        other: String,
        /// The node.
        node: NodeId,
        /// Position of the place.
        at: Vec3,
        /// Angle between the normals there, in degrees.
        angle: f64,
        /// Rigid surface that is a side, if one is, and the part of its statement to reverse.
        rigid: Option<Box<(String, Reversal)>>,
    },
    /// Facets of one side are far smaller than those of the other.
    #[error(
        "pair `{pair}`: {count} facets of `{body}` lie opposite one facet of `{other}`, at {}, too many to compute their contact. Refine `{other}` there, coarsen `{body}`, or make `{other}` a rigid surface if it hardly deforms",
        place(at)
    )]
    Crowded {
        /// Name of the pair.
        pair: String,
        /// Body with the small facets.
        body: String,
        /// Body with the large one.
        other: String,
        /// Number of facets that lie opposite.
        count: usize,
        /// Position of the large facet.
        at: Vec3,
    },
    /// Moving nodes would turn an element inside out.
    #[error(
        "pair `{pair}`: `initial = \"close\"` would turn {element} of body `{body}` inside out. Set `initial = \"resolve\"` to remove overlaps gradually during the first step, close only gaps that are small compared with the elements (`initial = {{ close = 0 }}` closes none), or repair the mesh"
    )]
    Inverted {
        /// Name of the pair.
        pair: String,
        /// The body.
        body: String,
        /// The first such element.
        element: ElementId,
    },
}

/// Tells if nodes of a pair have been moved to close its gaps and overlaps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Closing {
    /// Gaps have not been closed.
    Open,
    /// Gaps have been closed.
    Made,
}

impl Closing {
    /// Returns advice on an overlap that is there.
    fn remedy(self) -> &'static str {
        match self {
            Self::Made => {
                "The overlap remains after `initial = \"close\"` has moved the nodes of the smaller or finer side, as the other side reaches deeper between them. Set `initial = \"resolve\"` to remove it gradually during the first step, refine the side that was moved, or repair the mesh"
            }
            Self::Open => {
                "Repair the mesh, set `initial = \"close\"` to move nodes, or set `initial = \"resolve\"` to remove the overlap gradually during the first step"
            }
        }
    }
}

impl InitialFault {
    /// Name of the pair.
    pub fn pair(&self) -> &str {
        match self {
            Self::Overlap { pair, .. }
            | Self::Deep { pair, .. }
            | Self::Unseated { pair, .. }
            | Self::Behind { pair, .. }
            | Self::Away { pair, .. }
            | Self::Crowded { pair, .. }
            | Self::Inverted { pair, .. } => pair,
        }
    }
}

/// Statement of a rigid surface that gives it its direction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reversal {
    /// The normal of a plane.
    Normal,
    /// The order of the corners of facets.
    Corners,
}

impl Reversal {
    /// Object of a request to reverse it.
    fn of(self, rigid: &str) -> String {
        match self {
            Self::Normal => format!("the normal of `{rigid}`"),
            Self::Corners => format!(
                "the facets of `{rigid}` (list their corners counter-clockwise as seen from the body)"
            ),
        }
    }
}

/// Advice for surfaces that look away from each other.
fn turning(rigid: &Option<Box<(String, Reversal)>>) -> String {
    match rigid.as_deref() {
        Some((rigid, reversal)) => format!(
            "Reverse {}, or name the facets of the body that face it",
            reversal.of(rigid)
        ),
        None => "Name the facets that face each other".to_owned(),
    }
}
