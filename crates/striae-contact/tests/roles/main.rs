//! Kept nodes, transfer rows and ramp of flat pairs.

mod flat;
mod reference;
