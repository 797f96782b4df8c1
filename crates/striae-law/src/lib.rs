//! Material responses without a mesh: bulk laws and friction laws.
//!
//! Every law is one page: parameters, admissibility, response, tangent,
//! formula and source. [`fit`] finds the constants of friction laws from measurements.

pub mod bulk;
pub mod fit;
pub mod friction;
#[cfg(test)]
mod tests;
