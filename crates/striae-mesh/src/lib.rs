//! Hexahedral meshes of bodies.
//!
//! A [`Mesh`] is immutable once built: node positions in the reference
//! configuration, eight-node hexahedra and named sets. Everything that moves
//! lives above this crate. Lengths are in the units of the user.
//!
//! | module | what it adds |
//! | --- | --- |
//! | [`Mesh`] | the mesh and the checks every mesh passes |
//! | topology | boundary faces, nodes of faces, faces of nodes, neighbours |
//! | [`quality`] | Jacobians, volumes, areas, sizes |
//! | [`generate`] | blocks, capped blocks, half cylinders, rings |
//! | [`Renumbering`] | permuted numbering and rigid motion, for invariance tests |

mod error;
pub mod generate;
mod id;
mod mesh;
pub mod quality;
mod random;
mod sets;
mod topology;
mod transform;

pub use error::MeshError;
pub use id::{ElementId, Face, FacetId, NodeId};
pub use mesh::Mesh;
pub use quality::Quality;
pub use sets::Sets;
pub use transform::Renumbering;

/// A point or vector in space.
pub type Vec3 = nalgebra::Vector3<f64>;
