//! What a run leaves behind: VTK files, histories, summaries and checkpoints.
//!
//! [`recorder`] writes a run under way; [`expected`] judges quantities of one that
//! has ended.

mod bodies;
pub mod checkpoint;
mod error;
pub mod expected;
mod folder;
pub mod history;
pub mod recorder;
mod rigid;
mod row;
mod settings;
pub mod summary;
mod tally;
pub mod vtk;

pub use error::OutputError;
pub use folder::Existing;
pub use row::row;
pub use settings::{FieldOutput, Output};
pub use tally::Tally;
