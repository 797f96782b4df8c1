//! Generators: plain parameter structs with a `mesh()` method, and [`GENERATORS`], which lists them
//! as decks and the Python package know them.
//!
//! | generator | body |
//! | --- | --- |
//! | [`Block`] | box, graded, turned, with oblique faces, turned or irregular mesh inside, of cells of any kind |
//! | [`CappedBlock`] | block with a spherical lower face, fine at its lowest point, of cells of any kind |
//! | [`HalfCylinder`] | slice of a half cylinder, fine at the end of its middle radius |
//! | [`Annulus`] | ring of rectangular section, a tyre |
//! | [`Cylinder`] | solid cylinder, or a quarter of it |
//! | [`Torus`] | ring of round section, an O-ring |
//!
//! Faces of the outline are named both as facet sets and as node sets; node
//! set and element set `all` hold everything. Every mesh has passed
//! [`Mesh::check`](crate::Mesh::check) and
//! [`Mesh::check_shape`](crate::Mesh::check_shape). Angles are in degrees.
//!
//! ```
//! use striae_mesh::{MeshError, Vec3, generate::Block};
//!
//! let mesh = Block {
//!     size: Vec3::new(2.0, 1.0, 1.0),
//!     divisions: [4, 2, 2],
//!     top_slopes: [0.1, 0.0],
//!     ..Block::default()
//! }
//! .mesh()?;
//! assert_eq!(mesh.facet_sets.get("zmax").map(<[_]>::len), Some(8));
//! assert!((mesh.volume() - 2.0).abs() < 1e-14);
//! # Ok::<(), MeshError>(())
//! ```

mod annulus;
mod block;
mod capped_block;
mod cylinder;
mod disc;
mod division;
mod generator;
mod grading;
mod grid;
mod half_cylinder;
mod sweep;
#[cfg(test)]
mod tests;
mod torus;

pub use annulus::{ANNULUS, Annulus, Refinement};
pub use block::{BLOCK, Block, Pivot, Rotation};
pub use capped_block::{CAPPED_BLOCK, CappedBlock, Part};
pub use cylinder::{CYLINDER, Cylinder};
pub use disc::Sector;
pub use generator::{Generate, Generator};
pub use grading::{Grading, refined_lengths};
pub use grid::MOST_ELEMENTS;
pub use half_cylinder::{HALF_CYLINDER, Half, HalfCylinder};
use striae_declared::Declared;
pub use torus::{TORUS, Torus};

/// The generators that decks and the Python package know by name.
pub static GENERATORS: &[&Declared<Generator>] = &[
    &BLOCK,
    &CAPPED_BLOCK,
    &HALF_CYLINDER,
    &ANNULUS,
    &CYLINDER,
    &TORUS,
];
