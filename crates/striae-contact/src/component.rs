//! Contact as a component of other finite-element programs.
//!
//! The caller has the mesh, elements, loads and Newton's method; [`Contact`] adds the traction
//! unknowns, their rows, and the forces that they exert. Nothing is global, everything is `Send`
//! and `Sync`, and nothing changes once it is made: an increment is a value, so one that failed is
//! dropped.
//!
//! ```text
//! Contact::new -> Contact::untouched -> State
//! Contact::begin(State, Imposed)     -> Increment              once per increment
//! Increment::evaluate(x, tractions)  -> Evaluated              in every iteration
//! Increment::reselected(Evaluated)   -> Increment              if Increment::missed finds nodes
//! Increment::accept(Evaluated)       -> State                  once the residual is small
//! ```
//!
//! # Unknowns and rows
//!
//! Of `N` nodes and `K` kept nodes, with the position of node `I` at `x_I` (positions, or
//! displacements, whose increments are the same) there are `3 N + 3 K` unknowns and rows:
//!
//! ```text
//! 3 I + c              x_I . e_c   -f_I . e_c                        to be added to f_int - f_ext
//! 3 N + 3 k            p_k         (1/w_k) integral phi_k (g + s) = 0
//! 3 N + 3 k + 1, 2     z_k         du_k = 0 where |y_k| <= varpi, else z_k - varpi y_k/|y_k| = 0
//!
//! f_I = +- integral N_I t da,    t = sum_k phi_k (-p_k n + R(n, n_k) tau_k)
//! y_k = z_k + r_t K^-1 du_k,     varpi = varpi(p^_k, |du_k|/dt, ...) = mu p^_k for Coulomb
//! ```
//!
//! `g` is the gap and `du` the slip since the last converged configuration; `s >= 0` is open where a
//! point of the support does not touch, so that its pressure is zero there. `p^_k` is the mean
//! pressure over the support. A node that faces nothing has `p_k = 0`, one without pressure
//! `z_k = 0`. For isotropic friction `tau_k = -z_k`. `phi_k`, the kept nodes and their numbers
//! hold for one increment; the rows are those of [`crate::complementarity`], the forces those of
//! [`crate::evaluation`]. Both sides have the same traction, so their forces balance to round-off.
//!
//! The tangent is the derivative of all these rows by all these unknowns, as triplets (several of
//! one place add up). It is not symmetric with friction, and has zeros on the diagonal: a direct
//! solver with pivoting is needed.
//!
//! # First iteration
//!
//! The first evaluation of an increment is at the positions where it starts. There touching
//! nodes count as closed, and nodes that slipped before go on slipping, so that the first correction
//! is that of contact as it was. All others take the evaluation before, `after`: where friction falls
//! with the slip rate, rows depend on the status that nodes have had.
//!
//! # What is prescribed
//!
//! Friction of a node is determined in the directions in which something moves. Prescribed
//! components are needed to know those, see [`crate::directions`], and the caller eliminates them
//! from the system. With none, all nodes count as free.
//!
//! # Units, shapes, errors
//!
//! Consistent units of the caller: lengths for positions and gaps, force per area for moduli,
//! pressures and tractions. Facets have four corners, counter-clockwise seen from outside, and a
//! triangle repeats its last one. Vectors are by node. Whatever cannot be evaluated is in
//! [`Faults`], each with its place, the value found and the remedy.

mod contact;
mod evaluated;
mod fault;
mod imposed;
mod increment;
mod input;
mod numbers;
mod restriction;
mod shape;
mod state;
#[cfg(test)]
mod tests;

pub use contact::Contact;
pub use evaluated::Evaluated;
pub use fault::{Fault, FaultKind, Faults};
pub use imposed::Imposed;
pub use increment::Increment;
pub use input::{Opponent, Pair, Surface};
pub use state::State;
