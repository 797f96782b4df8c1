//! Compressible neo-Hookean solid.
//!
//! With `J = det F`, `C = F^T F`, Lame constant `lambda` and shear modulus `G`,
//!
//! ```text
//! W = G/2 (tr C - 3) - G ln J + lambda/2 (J - 1)^2
//! P = G (F - F^-T) + lambda (J - 1) J F^-T
//! A_iJkL = G d_ik d_JL + (G - lambda (J - 1) J) B_iL B_kJ + lambda (2 J - 1) J B_iJ B_kL,   B = F^-T
//! ```
//!
//! the law of Jones & Papadopoulos, "Simulating anisotropic frictional response
//! using smoothly interpolated traction fields", Comput. Methods Appl. Mech.
//! Engrg. (2006). `W` grows without bound both as `J -> 0` and as `J -> oo`;
//! small strains obey linear elasticity with `lambda` and `G`.

use super::{Inverted, Response, Tangent};
use nalgebra::Matrix3;
use num_dual::DualNum;

/// Stored energy `W` over any scalar; not a number where `J <= 0`.
pub(super) fn energy<D: DualNum<Primitive = f64> + Copy>(
    lambda: f64,
    shear: f64,
    deformation_gradient: &Matrix3<D>,
) -> D {
    let [first, second, third] = [0, 1, 2].map(|j| deformation_gradient.column(j).clone_owned());
    let determinant = first.cross(&second).dot(&third);
    let trace_c = deformation_gradient
        .iter()
        .fold(D::from(0.0), |sum, component| sum + *component * *component);
    let dilatation = determinant - 1.0;
    (trace_c - 3.0) * (0.5 * shear) - determinant.ln() * shear
        + dilatation * dilatation * (0.5 * lambda)
}

#[allow(non_snake_case)]
pub(super) fn response(lambda: f64, G: f64, F: &Matrix3<f64>) -> Result<Response, Inverted> {
    let J = F.determinant();
    let B = match F.try_inverse() {
        Some(inverse) if J > 0.0 => inverse.transpose(),
        _ => return Err(Inverted { determinant: J }),
    };
    let volumetric = lambda * (J - 1.0) * J;
    Ok(Response {
        energy: energy(lambda, G, F),
        first_piola: (F - B) * G + B * volumetric,
        tangent: tangent(G, G - volumetric, lambda * (2.0 * J - 1.0) * J, &B),
    })
}

/// `A_iJkL = G d_ik d_JL + crossed B_iL B_kJ + direct B_iJ B_kL`.
#[allow(non_snake_case)]
fn tangent(G: f64, crossed: f64, direct: f64, B: &Matrix3<f64>) -> Tangent {
    let mut A = Tangent::zeros();
    for k in 0..3 {
        for L in 0..3 {
            let column = 3 * k + L;
            for i in 0..3 {
                for J in 0..3 {
                    A[(3 * i + J, column)] =
                        crossed * B[(i, L)] * B[(k, J)] + direct * B[(i, J)] * B[(k, L)];
                }
            }
            A[(column, column)] += G;
        }
    }
    A
}
