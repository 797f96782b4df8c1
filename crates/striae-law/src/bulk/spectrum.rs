//! Stress and tangent of laws in the principal elastic stretches of a material that flows.
//!
//! With the flow so far, `G = C_p^-1`, held, and `F_p` the part of `F` that it is,
//!
//! ```text
//! b = F G F^T = sum_a exp(2 e_a) n_a (x) n_a          elastic left Cauchy-Green tensor
//! ```
//!
//! and Kirchhoff stresses `tau_a(e_1, e_2, e_3)` with `T_ab = dtau_a/de_b`,
//!
//! ```text
//! P = sum_a tau_a n_a m_a ,   m_a = F^-1 n_a
//! A = sum_ab (T_ab - d_ab tau_a) (n_a m_a)(n_b m_b)
//!   + sum_a/=b D_ab b_b (n_a m_b)(n_a m_b) + (D_ab (b_a + b_b) - tau_a - tau_b)/2 (n_a m_b)(n_b m_a)
//! D_ab = (tau_a - tau_b)/(b_a - b_b) ,   b_a = exp(2 e_a)
//! ```
//!
//! where `D_ab` tends to `(T_aa - T_ab)/(2 b_a)` as `b_b` tends to `b_a`. `A` is symmetric
//! where `T` is. After a flow that turns the elastic strains into `y_a`, at the same `F` and
//! along the same axes, `G = sum_a exp(2 y_a) m_a (x) m_a`.
//!
//! The six components of `G` are kept as differences from the unit tensor, in the order
//! 11, 22, 33, 12, 13, 23.
//!
//! Source: Simo, Comput. Methods Appl. Mech. Eng. 99 (1992) 61-112,
//! doi:10.1016/0045-7825(92)90123-2.

use super::invariants::inverse;
use super::{Response, ResponseError};
use nalgebra::{Matrix3, SVector, SymmetricEigen, Vector3};

/// Components of `G` that are kept.
const COMPONENTS: [(usize, usize); 6] = [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)];
/// Number of components.
pub(super) const FLOW: usize = COMPONENTS.len();
/// Difference of strains below which `D_ab` is that of equal ones: its error is the square,
/// that of the quotient a unit in the last place over the difference.
const EQUAL: f64 = 1e-5;

/// Elastic strains and axes at a deformation, for a flow that is held.
pub(super) struct Spectrum {
    /// Logarithmic elastic strains `e_a`.
    pub(super) strains: Vector3<f64>,
    /// `b_a`.
    squares: Vector3<f64>,
    /// `n_a` by column.
    axes: Matrix3<f64>,
    /// `m_a` by column.
    pulled: Matrix3<f64>,
}

impl Spectrum {
    /// At the deformation gradient `F` after the flow that is kept in six components.
    ///
    /// # Errors
    ///
    /// [`ResponseError::Inverted`] unless `det F > 0`.
    #[allow(non_snake_case)]
    pub(super) fn new(F: &Matrix3<f64>, flow: &[f64]) -> Result<Self, ResponseError> {
        let (J, B) = inverse(F)?;
        let mut G = Matrix3::identity();
        for (&(i, j), component) in COMPONENTS.iter().zip(flow) {
            G[(i, j)] += component;
            if i != j {
                G[(j, i)] += component;
            }
        }
        let eigen = SymmetricEigen::new(F * G * F.transpose());
        let squares = eigen.eigenvalues;
        if squares.iter().all(|square| *square > 0.0) {
            Ok(Self {
                strains: squares.map(|square| 0.5 * square.ln()),
                squares,
                axes: eigen.eigenvectors,
                pulled: B.transpose() * eigen.eigenvectors,
            })
        } else {
            Err(ResponseError::Inverted { determinant: J })
        }
    }

    /// Adds stress and tangent of Kirchhoff stresses with their derivatives.
    pub(super) fn add(
        &self,
        stresses: &Vector3<f64>,
        slopes: &Matrix3<f64>,
        response: &mut Response,
    ) {
        let dyad = |a: usize, b: usize| {
            SVector::<f64, 9>::from_fn(|row, _| self.axes[(row / 3, a)] * self.pulled[(row % 3, b)])
        };
        let tangent = &mut response.tangent;
        for (a, b) in (0..3).flat_map(|a| (0..3).map(move |b| (a, b))) {
            let own = if a == b { stresses[a] } else { 0.0 };
            *tangent += dyad(a, a) * dyad(b, b).transpose() * (slopes[(a, b)] - own);
            if a == b {
                let axis = self.axes.column(a) * self.pulled.column(a).transpose();
                response.first_piola += axis * stresses[a];
                continue;
            }
            let quotient = self.quotient(a, b, stresses, slopes);
            let (x, y) = (self.squares[a], self.squares[b]);
            let crossed = 0.5 * (quotient * (x + y) - stresses[a] - stresses[b]);
            *tangent += dyad(a, b) * dyad(a, b).transpose() * (quotient * y);
            *tangent += dyad(a, b) * dyad(b, a).transpose() * crossed;
        }
    }

    /// `D_ab`.
    fn quotient(&self, a: usize, b: usize, tau: &Vector3<f64>, slopes: &Matrix3<f64>) -> f64 {
        let (x, y) = (self.squares[a], self.squares[b]);
        if (self.strains[a] - self.strains[b]).abs() < EQUAL {
            let slope = slopes[(a, a)] + slopes[(b, b)] - slopes[(a, b)] - slopes[(b, a)];
            0.5 * slope / (x + y)
        } else {
            (tau[a] - tau[b]) / (x - y)
        }
    }

    /// The flow, to be kept in six components, that leaves the given elastic strains.
    pub(super) fn flow(&self, elastic: &Vector3<f64>, flow: &mut [f64]) {
        let stretch = Matrix3::from_diagonal(&elastic.map(|strain| (2.0 * strain).exp()));
        let inverse = self.pulled * stretch * self.pulled.transpose();
        for (&(i, j), component) in COMPONENTS.iter().zip(flow) {
            let unit = if i == j { 1.0 } else { 0.0 };
            *component = inverse[(i, j)] - unit;
        }
    }
}
