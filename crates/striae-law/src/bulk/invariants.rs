//! Stress and tangent of a stored energy of invariants.
//!
//! With `C = F^T F`, `B = F^-T` and
//!
//! ```text
//! I1 = tr C          dI1/dF = 2 F
//! I2 = (I1^2 - C : C)/2   dI2/dF = 2 (I1 F - F C)
//! J  = det F         dJ/dF  = J B
//! ```
//!
//! the chain rule gives for any `W(I1, I2, J)`
//!
//! ```text
//! P = W_a g_a ,   A = W_ab g_a (x) g_b + W_a H_a ,   g_a = dI_a/dF ,   H_a = d2I_a/dF dF
//! H1_iJkL = 2 d_ik d_JL
//! H2_iJkL = 4 F_iJ F_kL + 2 (I1 d_ik d_JL - d_ik C_JL - F_iL F_kJ - (F F^T)_ik d_JL)
//! HJ_iJkL = J (B_iJ B_kL - B_iL B_kJ)
//! ```
//!
//! The derivatives `W_a`, `W_ab` are those of second-order dual numbers, exact to
//! round-off, so a law states its energy and nothing else.
//!
//! Source: Holzapfel, "Nonlinear Solid Mechanics" (2000), chapter 6.

use super::{Response, ResponseError, Tangent};
use nalgebra::{Matrix3, SVector};
use num_dual::{Dual2SVec64, hessian};

/// Dual numbers of `I1`, `I2` and `J`.
pub type Invariant = Dual2SVec64<3>;

/// Response of the energy `W(I1, I2, J)`, whose arguments are invariants of `F` itself.
#[allow(non_snake_case)]
pub(super) fn response(
    F: &Matrix3<f64>,
    energy: impl Fn(Invariant, Invariant, Invariant) -> Invariant,
) -> Result<Response, ResponseError> {
    let (J, B) = inverse(F)?;
    let C = F.transpose() * F;
    let I1 = C.trace();
    let I2 = 0.5 * (I1 * I1 - C.norm_squared());
    let at = SVector::from([I1, I2, J]);
    let (energy, W, WW) = hessian(|x| energy(x[0], x[1], x[2]), &at);
    let gradients = [F * 2.0, (F * I1 - F * C) * 2.0, B * J];
    let first_piola = gradients[0] * W[0] + gradients[1] * W[1] + gradients[2] * W[2];
    let mut tangent = outer(&gradients, &WW);
    add_curvatures(&mut tangent, F, &B, &C, [W[0], W[1], W[2] * J]);
    Ok(Response {
        energy,
        first_piola,
        tangent,
    })
}

/// `J` and `F^-T`.
#[allow(non_snake_case)]
pub(super) fn inverse(F: &Matrix3<f64>) -> Result<(f64, Matrix3<f64>), ResponseError> {
    let J = F.determinant();
    match F.try_inverse() {
        Some(inverse) if J > 0.0 => Ok((J, inverse.transpose())),
        _ => Err(ResponseError::Inverted { determinant: J }),
    }
}

/// `W_ab g_a (x) g_b`.
fn outer(gradients: &[Matrix3<f64>; 3], second: &Matrix3<f64>) -> Tangent {
    let g = gradients.map(|g| SVector::<f64, 9>::from_fn(|row, _| g[(row / 3, row % 3)]));
    let mut sum = Tangent::zeros();
    for a in 0..3 {
        let right = g[0] * second[(a, 0)] + g[1] * second[(a, 1)] + g[2] * second[(a, 2)];
        sum += g[a] * right.transpose();
    }
    sum
}

/// Adds `W_a H_a`; `slopes` are `W_1`, `W_2` and `J W_J`.
#[allow(non_snake_case)]
fn add_curvatures(
    tangent: &mut Tangent,
    F: &Matrix3<f64>,
    B: &Matrix3<f64>,
    C: &Matrix3<f64>,
    slopes: [f64; 3],
) {
    let [W1, W2, JWJ] = slopes;
    let left = F * F.transpose();
    let delta = |i: usize, k: usize| f64::from(u8::from(i == k));
    for (row, column) in (0..9).flat_map(|row| (0..9).map(move |column| (row, column))) {
        let ((i, j), (k, l)) = ((row / 3, row % 3), (column / 3, column % 3));
        let same = delta(i, k) * delta(j, l);
        let second = 4.0 * F[(i, j)] * F[(k, l)]
            + 2.0
                * (C.trace() * same
                    - delta(i, k) * C[(j, l)]
                    - F[(i, l)] * F[(k, j)]
                    - left[(i, k)] * delta(j, l));
        let third = B[(i, j)] * B[(k, l)] - B[(i, l)] * B[(k, j)];
        tangent[(row, column)] += 2.0 * W1 * same + W2 * second + JWJ * third;
    }
}
