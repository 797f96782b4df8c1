//! Material responses without a mesh: bulk laws and friction laws.
//!
//! Every law is one page: parameters, admissibility, response, tangent,
//! formula and source.

pub mod bulk;
pub mod friction;
