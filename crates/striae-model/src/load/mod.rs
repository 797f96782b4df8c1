//! Loads on faces with three or four nodes, with 2x2 Gauss points. A triangle repeats its
//! last corner; in the quadrilateral folded upon it the points are exact.
//!
//! With the tangents `g_1 = x,xi`, `g_2 = x,eta` of the bilinear face, its
//! normal `m = g_1 x g_2` (outward, `|m| = da/dxi deta`), `n = m/|m|`, and the
//! same in the reference configuration in capitals, the force per
//! `dxi deta` is
//!
//! ```text
//! |M| t0                        dead traction t0
//! |m| R(N, n) t0                follower traction t0
//! -p m                          pressure p
//! R = c I + [v]_x + v v^T / (1 + c),   v = N x n,  c = N . n
//! f_a = int N_a (...) dxi deta
//! ```
//!
//! `R` is the rotation by the smallest angle that takes `N` to `n`; it does not
//! follow a spin of the face about its own normal, and it has no limit where
//! the face is turned by 180 degrees. Pressure: e.g. Wriggers, *Nonlinear
//! Finite Element Methods*, 2008, sec. 4.2.5, doi:10.1007/978-3-540-71001-1.
//!
//! Forces are external: they count against the internal ones. Their derivative
//! by the positions is exact, and in general not symmetric. Unknown `3 a + i`
//! is the component `i` of corner `a`; corners as [`Mesh::face_nodes`].
//!
//! [`traction`] is the integrand at any point of the face over any scalar, for
//! loads that are integrated over a part of the face which itself moves.
//!
//! [`Mesh::face_nodes`]: striae_mesh::Mesh::face_nodes

mod integrand;
mod response;
#[cfg(test)]
mod tests;

pub use integrand::traction;
pub use response::{FaceLoad, LoadError, response};

/// Unknowns of a face: three for each of its four corners.
pub const UNKNOWNS: usize = 12;
