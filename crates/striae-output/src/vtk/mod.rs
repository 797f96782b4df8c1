//! Grids and results for ParaView and VTK.
//!
//! [`write()`] makes one `.vtu` file: a `VTKFile` of type `UnstructuredGrid`,
//! version 1.0, whose arrays are raw appended binary in blocks compressed by
//! zlib (`vtkZLibDataCompressor`), little endian, with `UInt64` headers. Real
//! numbers are `Float64` and survive a round trip bit by bit. The time of the
//! state is the field array `TimeValue`.
//! On several ranks a body is in pieces, `.vtu` files that a `.pvtu` file names.
//! [`Series`] strings such files together in time as a `.pvd` collection. [`Stored`] and
//! [`read_series`] read both back.
//!
//! Source: "VTK XML file formats", <https://docs.vtk.org/en/latest/vtk_file_formats/vtkxml_file_format.html>.
//!
//! ```no_run
//! use striae_output::vtk::{self, Array, Cells, Grid, Values};
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! # let (points, blocks, displacement) = (vec![], vec![], vec![]);
//! let grid = Grid {
//!     points: &points,
//!     cells: Cells::Blocks(&blocks),
//!     point_arrays: vec![Array::new("displacement", Values::Vectors(displacement))],
//!     cell_arrays: vec![],
//!     time: 0.5,
//! };
//! vtk::write("block_0001.vtu".as_ref(), &grid)?;
//! # Ok(()) }
//! ```

mod appended;
#[cfg(test)]
mod decode;
mod grid;
mod read;
mod series;
mod stored;
#[cfg(test)]
mod tests;
mod together;
mod xml;

pub use grid::{Array, Cells, Grid, Values};
pub use read::{Stored, read_series};
pub use series::{Series, Snapshot};
pub use stored::{StoredCells, StoredValues};
pub(crate) use together::{ELEMENT, NODE, write_together};
pub use xml::write;
