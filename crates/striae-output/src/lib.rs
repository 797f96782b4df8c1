//! What a run leaves behind: VTK files, histories, summaries and checkpoints.
//!
//! [`recorder`] writes a run under way; [`expected`] judges quantities of one that
//! has ended.

mod bodies;
pub mod checkpoint;
mod checksums;
mod error;
pub mod expected;
mod folder;
pub mod history;
mod memory;
mod probes;
pub mod recorder;
mod rigid;
mod row;
mod settings;
pub mod summary;
mod surfaces;
mod tally;
pub mod vtk;
pub mod worn;

pub use checksums::Checksums;
pub use error::OutputError;
pub use folder::Existing;
pub use memory::available_bytes;
pub use probes::weights as probe_weights;
pub use row::row;
pub use settings::{BodyField, FieldOutput, Output, Probe, ProbePlace};
pub use tally::Tally;
