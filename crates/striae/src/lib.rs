//! Finite-element contact with anisotropic friction.
//!
//! [`Simulation`] owns a run: its start, its resumption, its interruption and its
//! record. An [`Observer`] watches it, [`Results`] reads its fields, and [`figures`]
//! draws friction laws and textures. The `striae` program is a client of this crate.

mod error;
pub mod figures;
mod interrupt;
mod log;
mod observer;
mod results;
mod simulation;

pub use error::Error;
pub use interrupt::{Before, Interrupt};
pub use observer::{Converged, Next, Observer};
pub use results::{PairSide, Results};
pub use simulation::{Finished, Simulation, case_name};
