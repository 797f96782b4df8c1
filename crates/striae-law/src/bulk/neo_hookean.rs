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
use super::volumetric::VOLUMETRIC;
use super::{
    CompactResult, CompactTangent, ELASTIC_CONSTANTS, LameConstants, Law, Material, Response,
    Volumetric,
};
use nalgebra::Matrix3;
use num_dual::DualNum;
use striae_declared::Declared;

/// The law.
pub static NEO_HOOKEAN: Declared<Material> = Declared {
    name: "neo-hookean",
    summary: "Compressible neo-Hookean solid for large strains; the modulus of the volumetric energy is `lambda`.",
    parameters: &[ELASTIC_CONSTANTS, VOLUMETRIC],
    build: |values| {
        let constants = LameConstants::stated(values)?;
        let volumetric = Volumetric::stated(values);
        Ok(Material::neo_hookean_with(constants, volumetric))
    },
    fit: None,
};

impl Material {
    /// The neo-Hookean solid with the given Lame constants.
    pub fn neo_hookean(constants: LameConstants) -> Self {
        Self::neo_hookean_with(constants, Volumetric::Quadratic)
    }

    /// The neo-Hookean solid with the given Lame constants and volumetric energy.
    pub fn neo_hookean_with(constants: LameConstants, volumetric: Volumetric) -> Self {
        let LameConstants { lambda, shear } = constants;
        let law = Law::NeoHookean {
            lambda,
            shear,
            volumetric,
        };
        let values = constants.values().with(VOLUMETRIC.name, volumetric.name());
        Self::new(law, Some(NEO_HOOKEAN.stated(values)))
    }
}

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
#[inline]
pub(super) fn response(
    lambda: f64,
    G: f64,
    volumetric: Volumetric,
    F: &Matrix3<f64>,
) -> CompactResult {
    let (J, B) = inverse(F)?;
    let (pressure, stiffness) = volumetric.pressure(lambda, J);
    Ok(Response {
        energy: energy(lambda, G, volumetric, F),
        first_piola: (F - B) * G + B * pressure,
        tangent: CompactTangent {
            identity: G,
            crossed: G - pressure,
            direct: stiffness,
            inverse_transposed: B,
        },
    })
}
