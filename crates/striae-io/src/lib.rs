//! Decks, meshes, VTK files, histories, summaries and figures.

pub mod checkpoint;
pub mod deck;
pub mod expected;
pub mod figure;
pub mod history;
pub mod mesh_file;
mod output;
pub mod recorder;
pub mod summary;
pub mod vtk;

pub use output::{OutputError, write_atomically};
