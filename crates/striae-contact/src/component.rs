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
//! row                  unknown     residual
//! 3 I + c              x_I . e_c   -f_I . e_c                                to be added to f_int - f_ext
//! 3 N + 3 k            p_k         (1/w_k) integral phi_k min(g, p_k/r_k)    p_k where it faces nothing
//! 3 N + 3 k + 1, 2     z_k         du_k where |y_k| <= varpi, else z_k - varpi y_k/|y_k|
//!
//! f_I = +- integral N_I t,     t = -P n + sum_k phi_k R(n, n_k) tau_k,     P = sum_k phi_k max(0, p_k - r_k g)
//! y_k = z_k + r_t K^-1 du_k,   varpi = mu P_k for Coulomb,   tau_k = -z_k where friction is isotropic
//! ```
//!
//! `g` is the gap, `du` the slip since the last converged configuration, `P_k` the mean pressure
//! over the support of `phi_k`, `w_k` the integral of `phi_k` and `r_k` a bedding, that is small
//! where a support is closed. A node without pressure has the rows `z_k`. The kept nodes, and so the
//! numbers of their unknowns, hold for one increment. Both sides have the same traction, so their
//! forces balance to round-off. The rows are derived in [`crate::complementarity`],
//! [`crate::segment`] and [`crate::evaluation`].
//!
//! The tangent consists of triplets, one for each place, by row and then by column. It is the
//! derivative of the residual where the slip rows hold, and elsewhere their globalised derivative.
//! It is not symmetric with friction, and has zeros on the diagonal: it takes a direct solver with
//! pivoting.
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
mod triplets;

pub use contact::Contact;
pub use evaluated::Evaluated;
pub use fault::{Fault, FaultKind, Faults};
pub use imposed::Imposed;
pub use increment::Increment;
pub use input::{Opponent, Pair, Surface};
pub use state::State;
