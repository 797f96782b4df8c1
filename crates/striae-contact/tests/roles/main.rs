//! Kept nodes, transfer rows and ramp of flat pairs.

mod flat;
mod properties;
mod reference;
mod scenes;
