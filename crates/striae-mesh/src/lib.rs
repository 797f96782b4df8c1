//! Meshes of bodies.
//!
//! A [`Mesh`] is immutable once built: node positions in the reference
//! configuration, blocks of cells of one kind each, and named sets. Everything that
//! moves lives above this crate. Lengths are in the units of the user.
//!
//! | module | what it adds |
//! | --- | --- |
//! | [`Mesh`] | the mesh and the checks every mesh passes |
//! | [`CellKind`] | the kinds of cells, with faces, interpolation and quadrature |
//! | topology | boundary faces, nodes of faces, faces of nodes |
//! | [`quality`] | Jacobians, volumes, areas, sizes |
//! | [`generate`] | blocks, capped blocks, half cylinders, rings |
//! | [`Region`] and selection | sets from regions, directions, floods, other sets |
//! | [`Renumbering`] | permuted numbering and rigid motion, for invariance tests |

mod cell;
mod error;
mod figures;
pub mod generate;
mod id;
mod locate;
mod mesh;
mod pieces;
pub mod quality;
mod random;
mod region;
mod select;
mod sets;
mod topology;
mod transform;

pub use cell::{
    COMPOSITE_PARTS, CellBlock, CellKind, CellShape, MAX_CORNERS, MAX_POINTS, composite_linear,
};
pub use error::MeshError;
pub use figures::{place, significant};
pub use id::{ElementId, Face, FacetId, NodeId};
pub use locate::Located;
pub use mesh::Mesh;
pub use quality::Quality;
pub use region::Region;
pub use sets::Sets;
pub use topology::sorted_face;
pub use transform::Renumbering;

/// A point or vector in space.
pub type Vec3 = nalgebra::Vector3<f64>;
