//! Compressible neo-Hookean solid.
//!
//! With `J = det F`, `C = F^T F`, Lame constant `lambda` and shear modulus `G`,
//!
//! ```text
//! W = G/2 (tr C - 3) - G ln J + U(J) ,   U = lambda/2 (J - 1)^2  or  lambda/2 ln^2 J
//! P = G (F - F^-T) + J U' F^-T
//! A_iJkL = G d_ik d_JL + (G - J U') B_iL B_kJ + J (J U')' B_iJ B_kL,   B = F^-T
//! ```
//!
//! the first `U` is that of Jones & Papadopoulos, "Simulating anisotropic frictional response
//! using smoothly interpolated traction fields", Comput. Methods Appl. Mech.
//! Engrg. (2006), the second that of many programs, for example FEBio and GetFEM. `W`
//! grows without bound both as `J -> 0` and as `J -> oo`; small strains obey linear
//! elasticity with `lambda` and `G`.

use super::invariants::inverse;
use super::{Response, ResponseError, Tangent, Volumetric};
use nalgebra::Matrix3;
use num_dual::DualNum;

/// Stored energy `W` over any scalar; not a number where `J <= 0`.
pub(super) fn energy<D: DualNum<Primitive = f64> + Copy>(
    lambda: f64,
    shear: f64,
    volumetric: Volumetric,
    deformation_gradient: &Matrix3<D>,
) -> D {
    let [first, second, third] = [0, 1, 2].map(|j| deformation_gradient.column(j).clone_owned());
    let determinant = first.cross(&second).dot(&third);
    let trace_c = deformation_gradient
        .iter()
        .fold(D::from(0.0), |sum, component| sum + *component * *component);
    (trace_c - 3.0) * (0.5 * shear) - determinant.ln() * shear
        + volumetric.energy(lambda, determinant)
}

#[allow(non_snake_case)]
pub(super) fn response(
    lambda: f64,
    G: f64,
    volumetric: Volumetric,
    F: &Matrix3<f64>,
) -> Result<Response, ResponseError> {
    let (J, B) = inverse(F)?;
    let (pressure, stiffness) = volumetric.pressure(lambda, J);
    Ok(Response {
        energy: energy(lambda, G, volumetric, F),
        first_piola: (F - B) * G + B * pressure,
        tangent: tangent(G, G - pressure, stiffness, &B),
    })
}

/// `A_iJkL = G d_ik d_JL + crossed B_iL B_kJ + direct B_iJ B_kL`, column `3 k + L` by column.
#[allow(non_snake_case)]
fn tangent(G: f64, crossed: f64, direct: f64, B: &Matrix3<f64>) -> Tangent {
    let mut A = Tangent::zeros();
    let (crossed_B, direct_B) = (B * crossed, B * direct);
    // All rows `3 i + J` of a column at once.
    let direct_iJ: [f64; 9] = std::array::from_fn(|row| direct_B[(row / 3, row % 3)]);
    for k in 0..3 {
        let B_kJ: [f64; 9] = std::array::from_fn(|row| B[(k, row % 3)]);
        for L in 0..3 {
            let crossed_iL: [f64; 9] = std::array::from_fn(|row| crossed_B[(row / 3, L)]);
            let (at, B_kL) = (3 * k + L, B[(k, L)]);
            let column = &mut A.data.0[at];
            for row in 0..9 {
                column[row] = crossed_iL[row] * B_kJ[row] + direct_iJ[row] * B_kL;
            }
            column[at] += G;
        }
    }
    A
}
