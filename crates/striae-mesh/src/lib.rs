//! Hexahedral meshes of bodies and polygonal meshes of rigid surfaces.
//!
//! A [`Mesh`] is immutable once built: node positions in the reference
//! configuration, eight-node hexahedra and named sets. Everything that moves
//! lives above this crate.

mod id;
mod mesh;
mod sets;

pub use id::{ElementId, Face, FacetId, NodeId};
pub use mesh::{Mesh, MeshError};
pub use sets::Sets;

/// A point or vector in space.
pub type Vec3 = nalgebra::Vector3<f64>;
