//! Decks, meshes, VTK files, histories, summaries and figures.

pub mod deck;
pub mod expected;
pub mod history;
mod output;
pub mod summary;
pub mod vtk;

pub use output::{OutputError, write_atomically};
