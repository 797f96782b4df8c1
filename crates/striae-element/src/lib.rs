//! Elements, total Lagrangian: response, mass and stress, in blocks of one kind.
//!
//! With shape functions `N_a`, reference gradients `G_a = dN_a/dX` and nodal
//! positions `x_a`, at every quadrature point of weight `w` (reference volume)
//!
//! ```text
//! F_iJ = sum_a x_a,i G_a,J
//! W_e  = sum_g w W(F)                                 stored energy
//! f_ai = sum_g w P_iJ G_a,J                           = dW_e/dx_ai, internal force
//! K_aibk = sum_g w G_a,J A_iJkL G_b,L                 = df_ai/dx_bk, stiffness
//! ```
//!
//! (e.g. Wriggers, *Nonlinear Finite Element Methods*, 2008, ch. 4,
//! doi:10.1007/978-3-540-71001-1). Interpolation and quadrature are those of the
//! [`CellKind`](striae_mesh::CellKind). `dilatation.rs` has the same with the volume ratio
//! constant in the element, see [`Formulation`], `enhanced.rs` hexahedra
//! that bend, `composite.rs` a gradient that is projected. Sums over quadrature points take
//! `A` by all components (`tangent.rs`), or half the work where it takes a few numbers only
//! (`compact.rs`).
//!
//! Stress-free strain and active tension make an element of a grown reference configuration
//! (`actuation.rs`).
//!
//! [`Elements`] keeps what depends on the reference configuration alone; none of it is computed
//! again while iterating. The numbers of corners and points of the elements of an [`ElementBlock`]
//! are known at compile time: each call is dispatched once, and the sums inside fill the lanes of
//! the processor.
//!
//! A new kind is a file of `striae-mesh/src/cell/`, a line in its table and one in the
//! table of `block.rs`.

mod actuation;
mod block;
mod compact;
mod composite;
mod deformation;
mod dilatation;
mod element;
mod elements;
mod enhanced;
mod fault;
mod formulation;
mod inertia;
mod mass;
mod product;
mod reference;
mod response;
mod rule;
mod stiffness;
mod stress;
mod tangent;
#[cfg(test)]
mod tests;

pub use actuation::{Actuation, Driven, Tension};
pub use block::ElementBlock;
pub use element::Element;
pub use elements::Elements;
pub use fault::{ElementError, ElementFault};
pub use formulation::Formulation;
pub use mass::{Mass, redistributed};
pub use response::ElementResponse;
pub use stiffness::Stiffness;
pub use stress::{nodal_cauchy_stress, nodal_stress_sums, von_mises};
