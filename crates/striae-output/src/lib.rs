//! Output of a run: VTK files, histories, summaries and checkpoints.
//!
//! [`recorder`] writes a run in progress; [`expected`] judges quantities of a completed one.

mod bodies;
pub mod checkpoint;
mod checksums;
mod collections;
mod error;
pub mod expected;
mod fibres;
mod folder;
pub mod history;
mod kept;
mod means;
mod memory;
mod parts;
mod pieces;
mod probes;
mod ranks;
pub mod recorder;
mod removal;
mod rigid;
mod row;
mod sections;
mod settings;
mod strain;
pub mod summary;
mod surfaces;
mod tally;
mod tied;
pub mod vtk;
mod watched;
pub mod worn;

pub use checksums::Checksums;
pub use error::OutputError;
pub use folder::{Existing, is_occupied};
pub use memory::available_bytes;
pub use probes::weights as probe_weights;
pub use ranks::{agreed, from_first};
pub use row::{before_touch, listed, row, state_row};
pub use sections::cut as section_cut;
pub use settings::{BodyField, ContactField, FieldOutput, Output, Probe, ProbePlace, Section};
pub use tally::Tally;
