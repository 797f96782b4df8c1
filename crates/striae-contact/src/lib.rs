//! Frictional contact of two surfaces.
//!
//! A [`pair::ContactPair`] is what does not change. Once an increment the
//! [`selection::Selection`] says which nodes carry traction unknowns; in every iteration
//! [`evaluation::evaluate`] turns positions and traction unknowns into local terms of the
//! residual and its tangent. Nothing here knows of sparse matrices or iterates globally.
//!
//! Other finite-element programs use [`component`], which wraps these steps.
//!
//! The method is unbiased: neither side is master or slave. By default both sides share one
//! traction field on their common segments, and every point of them decides whether it touches;
//! the collocated fields of Jones & Papadopoulos, "Simulating anisotropic frictional
//! response using smoothly interpolated traction fields", Comput. Methods Appl. Mech. Engrg.
//! 195 (2006), are the alternative.

mod absorption;
mod clip;
mod collocated;
mod common_field;
mod common_mass;
mod contest;
mod coverage;
mod edge;
mod integral;
mod kinematics;
mod moving;
mod nodal_normal;
mod opposing;
mod pairing;
mod partner;
mod patch;
mod pivots;
mod places;
mod projection;
mod quadrature;
mod quantity;
mod ramp;
mod sagitta;
mod search;
mod segment_rows;
mod slip_rate;
mod tracked;
mod traction;
mod transfer;
mod transported;
mod wear_rows;
mod weighted;

pub mod bedding;
pub mod body_edge;
pub mod common_pivots;
pub mod complementarity;
pub mod component;
pub mod configuration;
pub mod converged_friction;
pub mod directions;
pub mod evaluation;
pub mod exposed;
pub mod facet_coverage;
pub mod factor_states;
pub mod factors;
pub mod field;
pub mod frame;
pub mod history;
pub mod initial;
pub mod interface;
pub mod interference;
pub mod moved_pair;
pub mod opposite;
pub mod pair;
pub mod pair_state;
pub mod placement;
pub mod roles;
pub mod seating;
pub mod segment;
pub mod selection;
pub mod side;
pub mod slip_freedom;
pub mod table_1;
pub mod term;
pub mod texture;
pub mod tie;
pub mod traction_basis;
pub mod unknown;
pub mod unknowns;
pub mod wear;
