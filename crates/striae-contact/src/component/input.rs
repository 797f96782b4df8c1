//! Statements of the caller: the pairs that may touch.

use striae_law::friction::Friction;
use striae_mesh::{NodeId, Vec3};
use striae_surface::texture::Paint;

/// Two surfaces that may touch; neither is master or slave.
#[derive(Clone, Debug)]
pub struct Pair {
    /// Unique name, for messages.
    pub name: String,
    /// First side.
    pub a: Surface,
    /// Second side.
    pub b: Opponent,
    /// Friction law.
    pub friction: Friction,
    /// Distance within which contact is searched; half the local facet size where it is less.
    pub search_distance: Option<f64>,
}

/// A surface of the caller's mesh.
#[derive(Clone, Debug)]
pub struct Surface {
    /// Corners of the facets, counter-clockwise seen from outside; a triangle repeats its last one.
    pub facets: Vec<[NodeId; 4]>,
    /// Young's modulus of what is behind the facets (force per area). With the facet size `h` it
    /// gives the flexibility `h/E` by which both sides share what is between them.
    pub youngs_modulus: f64,
    /// Texture that is painted on it in the reference configuration.
    pub texture: Option<Paint>,
}

/// Second side of a pair.
#[derive(Clone, Debug)]
pub enum Opponent {
    /// Another surface of the mesh, without a node of the first one.
    Deformable(Surface),
    /// A rigid surface.
    Rigid {
        /// Its points in the reference configuration.
        points: Vec<Vec3>,
        /// Corners of its facets among the points.
        facets: Vec<[NodeId; 4]>,
        /// Texture.
        texture: Option<Paint>,
    },
    /// An unbounded rigid plane.
    Plane {
        /// A point of the plane in the reference configuration.
        point: Vec3,
        /// Normal out of the rigid half space, of any length.
        normal: Vec3,
        /// Texture: a field.
        texture: Option<Paint>,
    },
}
