//! Frictional contact of two surfaces.
//!
//! A [`pair::ContactPair`] is what does not change. Once an increment the
//! [`selection::Selection`] says which nodes carry traction unknowns; in every iteration
//! [`evaluation::evaluate`] turns positions and traction unknowns into local terms of the
//! residual and its tangent. Nothing here knows of sparse matrices or iterates globally.
//!
//! The method is unbiased: neither side is master or slave. By default both sides share one
//! traction field on their common segments and contact holds in the mean weighted with it;
//! the collocated fields of Jones & Papadopoulos, "Simulating anisotropic frictional
//! response using smoothly interpolated traction fields", Comput. Methods Appl. Mech. Engrg.
//! 195 (2006), are the alternative.

mod absorption;
mod common_mass;
mod pivots;

pub mod clip;
pub mod collocated;
pub mod common_field;
pub mod complementarity;
pub mod configuration;
pub mod converged_friction;
pub mod coverage;
pub mod edge;
pub mod evaluation;
pub mod exposed;
pub mod facet_coverage;
pub mod field;
pub mod frame;
pub mod initial;
pub mod integral;
pub mod interface;
pub mod interference;
pub mod kinematics;
pub mod moving;
pub mod nodal_normal;
pub mod opposing;
pub mod pair;
pub mod pairing;
pub mod partner;
pub mod patch;
pub mod placement;
pub mod places;
pub mod pointed;
pub mod projection;
pub mod quadrature;
pub mod quantity;
pub mod ramp;
pub mod roles;
pub mod search;
pub mod segment;
pub mod segment_rows;
pub mod selection;
pub mod slip_rate;
pub mod spot;
pub mod table_1;
pub mod term;
pub mod texture;
pub mod tie;
pub mod tip;
pub mod tracked;
pub mod traction;
pub mod traction_basis;
pub mod transfer;
pub mod transported;
pub mod unknown;
pub mod unknowns;
pub mod weighted;
