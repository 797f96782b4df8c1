//! The results of a run as one HTML file that opens anywhere, without a network, and as
//! [pictures](picture).
//!
//! ```text
//! results folder -> Results -> parts: skin, motion, arrays -> page
//!   VTU, PVD, history.csv,      [`part`]: 16 bits a number,    [`page`]: text, blocks
//!   summary.json, deck.toml,    predicted, deflated, base64    and the viewer in one file
//!   law-*.svg
//! ```
//!
//! The page shows the surfaces of all bodies as they deform, with fields, arrows, cuts and
//! a time slider; histories, increments, warnings, friction laws and the deck. The viewer is
//! plain JavaScript in `assets/viewer` over a bundled [three.js](https://threejs.org).
//!
//! Numbers on surfaces are rounded to 16 bits of the range of their array at their time;
//! extremes are those of the files, to the last bit. A file stays below [`LIMIT`]: where all
//! times would need more, every second, fourth, ... is left out, and the page says so.

mod boundary;
mod cell;
mod error;
mod invariants;
mod pack;
mod page;
mod part;
pub mod picture;
mod quantised;
mod results;

pub use error::ReportError;

use std::path::Path;

use striae_files::write_atomically;

/// Bytes that a report may have.
pub const LIMIT: usize = 25_000_000;

/// Name of a report in the folder of its results.
pub const FILE: &str = "report.html";

/// Writes the report of a results folder, whole or not at all.
///
/// # Errors
/// When there is nothing to report, or a file cannot be read or written.
pub fn write(folder: &Path, file: &Path) -> Result<(), ReportError> {
    Ok(write_atomically(file, render(folder)?.as_bytes())?)
}

/// The report of a results folder.
///
/// # Errors
/// When there is nothing to report, or a file cannot be read.
pub fn render(folder: &Path) -> Result<String, ReportError> {
    let results = results::Results::read(folder)?;
    page::page(&results)
}
