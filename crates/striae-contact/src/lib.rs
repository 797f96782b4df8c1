//! Frictional contact of two surfaces.
//!
//! A [`pair::ContactPair`] is what does not change. Once an increment the
//! [`selection::Selection`] gives every node its role; in every iteration
//! [`evaluation::evaluate`] turns positions and traction unknowns into local
//! terms of the residual and its tangent. Nothing here knows of sparse matrices
//! or iterates globally.
//!
//! The method is unbiased: traction fields live on both surfaces and each body
//! integrates its own, after Jones & Papadopoulos, "Simulating anisotropic
//! frictional response using smoothly interpolated traction fields", Comput.
//! Methods Appl. Mech. Engrg. 195 (2006).

pub mod balance;
pub mod clip;
pub mod complementarity;
pub mod configuration;
pub mod coverage;
pub mod evaluation;
pub mod exposed;
pub mod extension;
pub mod facet_coverage;
pub mod field;
pub mod frame;
pub mod initial;
pub mod integral;
pub mod interference;
pub mod moving;
pub mod opposing;
pub mod pair;
pub mod patch;
pub mod placement;
pub mod projection;
pub mod quadrature;
pub mod quantity;
pub mod search;
pub mod selection;
pub mod slip_rate;
pub mod table_1;
pub mod term;
pub mod texture;
pub mod traction;
pub mod transfer;
pub mod transported;
pub mod unknown;
pub mod unknowns;
