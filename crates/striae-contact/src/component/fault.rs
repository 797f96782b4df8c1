//! Faults of what the caller gives.

use std::fmt;

use striae_mesh::NodeId;
use striae_surface::texture::TextureError;

use crate::side::Side;

/// All faults that were found.
#[derive(Clone, Debug, PartialEq)]
pub struct Faults(pub Vec<Fault>);

/// A fault with its place.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{place}: {kind}")]
pub struct Fault {
    /// The faulty part, such as `pairs[0].a.facets`, counted from 0.
    pub place: String,
    /// Message: what was found and what is needed.
    pub kind: FaultKind,
}

/// Kind of a fault.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum FaultKind {
    /// There is no pair.
    #[error("there is none; at least one is needed")]
    NoPair,
    /// Two pairs have one name.
    #[error("`{name}` is the name of another pair; give each a name of its own")]
    Name {
        /// The name.
        name: String,
    },
    /// A surface has no facet.
    #[error("there is none; a surface needs at least one")]
    NoFacet,
    /// A facet has a node that does not exist.
    #[error("facet {facet} has {node}, but there are {nodes} nodes; they count from 0")]
    Node {
        /// The facet.
        facet: usize,
        /// The node.
        node: NodeId,
        /// Number of nodes.
        nodes: usize,
    },
    /// A facet without area, or one that is not convex.
    #[error(
        "facet {facet} is degenerate: it needs three or four corners that differ, in order around it, and an area"
    )]
    Degenerate {
        /// The facet.
        facet: usize,
    },
    /// Facets at a node do not have a side in common.
    #[error(
        "the facets at {node} face opposite ways; order the corners of each counter-clockwise seen from outside"
    )]
    Folded {
        /// The node.
        node: NodeId,
    },
    /// Sides that look away from each other, as where facets are turned inside out.
    #[error(
        "its sides face away from each other, so they cannot touch: at {node} of side `{side}` their normals are {angle:.0} degrees apart, and 180 would be face to face; order the corners of each facet counter-clockwise seen from outside"
    )]
    Away {
        /// The node, of the mesh or of the rigid surface.
        node: NodeId,
        /// Its side.
        side: Side,
        /// Angle between the normals there, in degrees.
        angle: f64,
    },
    /// A node on both sides of a pair.
    #[error("{node} is on side `a`, too; the sides of a pair must have no node in common")]
    Shared {
        /// The node.
        node: NodeId,
    },
    /// A number that must be positive.
    #[error("it must be positive, but is {value}")]
    NotPositive {
        /// The number.
        value: f64,
    },
    /// An infinite duration for friction with a state, or with a factor of one's own that depends on
    /// the slip.
    #[error(
        "friction of pairs[{pair}] has a state or a factor that depends on slip: state how long the increment takes"
    )]
    Endless {
        /// The pair.
        pair: usize,
    },
    /// A vector that is not finite.
    #[error("row {row} is not finite")]
    NotFinite {
        /// Its place in the list.
        row: usize,
    },
    /// A direction that is none.
    #[error("a direction must not be the zero vector")]
    Zero,
    /// A list of another length.
    #[error("{found} are given, but {needed} are needed")]
    Count {
        /// Number given.
        found: usize,
        /// Number needed.
        needed: usize,
    },
    /// Friction without the textures that give it a direction, or with too many.
    #[error("the friction law needs a texture on {required}, but {found} are given")]
    Textures {
        /// The sides.
        required: &'static str,
        /// Number of textured sides.
        found: usize,
    },
    /// A texture at nodes of a plane that has none.
    #[error("a rigid plane takes a uniform, circumferential, axial or radial texture")]
    PlaneTexture,
    /// A texture cannot be painted.
    #[error("{}{error}", at(*node))]
    Texture {
        /// The node of the mesh, or of the rigid surface.
        node: Option<NodeId>,
        /// Reason, by nodes of the surface.
        error: TextureError,
    },
    /// A placement that deforms.
    #[error("the rotation is none: its columns must be orthogonal unit vectors, right-handed")]
    Rotation,
    /// A texture has collapsed.
    #[error("the texture has no direction left at {node}; the increment is too large")]
    CollapsedTexture {
        /// The node.
        node: NodeId,
    },
    /// Surfaces are folded over each other.
    #[error("the surfaces are folded over each other; the increment is too large")]
    FoldedSurfaces,
    /// A factor of friction is not sound, or its law has failed.
    #[error("{cause}")]
    Factor {
        /// Cause, in words.
        cause: String,
    },
    /// An evaluation that another increment has made.
    #[error("it belongs to another increment; use one that this increment has made")]
    OtherIncrement,
    /// A facet that is there already.
    #[error("facet {facet} has the corners of facet {first}; give each facet once")]
    Repeated {
        /// The facet.
        facet: usize,
        /// The one before it.
        first: usize,
    },
    /// A state of other surfaces.
    #[error("it belongs to other surfaces; use one that this contact has made")]
    Foreign,
}

fn at(node: Option<NodeId>) -> String {
    node.map_or_else(String::new, |node| format!("at {node}: "))
}

impl Faults {
    /// A single fault.
    pub(super) fn one(place: impl Into<String>, kind: FaultKind) -> Self {
        let place = place.into();
        Self(vec![Fault { place, kind }])
    }
}

impl fmt::Display for Faults {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (at, fault) in self.0.iter().enumerate() {
            let line_break = if at == 0 { "" } else { "\n" };
            write!(f, "{line_break}{fault}")?;
        }
        Ok(())
    }
}

impl std::error::Error for Faults {}
