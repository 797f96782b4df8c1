//! The eight-node hexahedron, total Lagrangian, with 2x2x2 Gauss points.
//!
//! With shape functions `N_a`, reference gradients `G_a = dN_a/dX` and nodal
//! positions `x_a`, at every Gauss point of weight `w` (reference volume)
//!
//! ```text
//! F_iJ = sum_a x_a,i G_a,J
//! W_e  = sum_g w W(F)                                 stored energy
//! f_ai = sum_g w P_iJ G_a,J                           = dW_e/dx_ai, internal force
//! K_aibk = sum_g w G_a,J A_iJkL G_b,L                 = df_ai/dx_bk, stiffness
//! ```
//!
//! (e.g. Wriggers, *Nonlinear Finite Element Methods*, 2008, ch. 4,
//! doi:10.1007/978-3-540-71001-1). Unknown `3 a + i` is the component `i` of
//! the position of corner `a`; corners are numbered as VTK's hexahedron.
//!
//! [`ReferenceElement`] keeps what depends on the reference configuration
//! alone; nothing of it is found again while iterating.

mod fault;
mod mass;
mod reference;
mod response;
mod shape;
mod stiffness;
mod stress;
#[cfg(test)]
mod tests;

pub use fault::{ElementError, ElementFault};
pub use mass::redistributed;
pub use reference::{ReferenceElement, reference_elements};
pub use response::{ElementResponse, response};
pub use stiffness::Stiffness;
pub use stress::{nodal_cauchy_stress, von_mises};

/// Unknowns of an element: three for each of its eight corners.
pub const UNKNOWNS: usize = 24;
