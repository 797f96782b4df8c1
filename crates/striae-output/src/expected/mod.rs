//! Computed quantities against expected ones.
//!
//! An `expected.toml` lists what a case must give:
//!
//! ```toml
//! [[quantity]]
//! name = "pair.interface.resultant_a.z"
//! value = 15712.0            # or: min = 15200.0, max = 15900.0
//! relative = 0.005           # or: absolute = 78.0
//! source = "two other codes, mesh 4 x 4 x 2"
//! unit = "N"                 # optional
//! ```
//!
//! [`Expected::read`] reads it, [`compare`] gives one [`Comparison`] an entry,
//! [`report`] prints them as aligned text and [`write_csv`] as a file.

mod file;
mod report;
#[cfg(test)]
mod tests;

pub use file::{Expected, Quantity, Target, Tolerance};
pub use report::{Comparison, Verdict, compare, report, write_csv};
