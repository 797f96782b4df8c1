//! Linear elasticity of small strains (Hooke's law).
//!
//! With the small strain `e = sym(F - I)`,
//!
//! ```text
//! W = lambda/2 (tr e)^2 + G e : e
//! P = lambda (tr e) I + 2 G e
//! A_iJkL = lambda d_iJ d_kL + G (d_ik d_JL + d_iL d_kJ)
//! ```
//!
//! The law is not objective: rotations produce strain. It serves for comparisons with closed forms
//! of the linear theory. No deformation gradient is rejected.

use super::{ELASTIC_CONSTANTS, LameConstants, Law, Material, Response, Tangent};
use nalgebra::Matrix3;
use num_dual::DualNum;
use striae_declared::Declared;

/// The law.
pub static LINEAR_ELASTIC: Declared<Material> = Declared {
    name: "linear-elastic",
    summary: "Linear elasticity for small strains and small rotations.",
    parameters: &[ELASTIC_CONSTANTS],
    build: |values| Ok(Material::linear_elastic(LameConstants::stated(values)?)),
    fit: None,
};

impl Material {
    /// Linear elasticity with the given Lame constants.
    pub fn linear_elastic(constants: LameConstants) -> Self {
        let LameConstants { lambda, shear } = constants;
        let law = Law::LinearElastic { lambda, shear };
        Self::new(law, Some(LINEAR_ELASTIC.stated(constants.values())))
    }
}

/// Stored energy `W` over any scalar.
pub(super) fn energy<D: DualNum<Primitive = f64> + Copy>(
    lambda: f64,
    shear: f64,
    deformation_gradient: &Matrix3<D>,
) -> D {
    let strain = Matrix3::from_fn(|i, j| {
        let mean = (deformation_gradient[(i, j)] + deformation_gradient[(j, i)]) * 0.5;
        if i == j { mean - 1.0 } else { mean }
    });
    let trace = strain[(0, 0)] + strain[(1, 1)] + strain[(2, 2)];
    let square = strain
        .iter()
        .fold(D::from(0.0), |sum, component| sum + *component * *component);
    trace * trace * (0.5 * lambda) + square * shear
}

#[allow(non_snake_case)]
pub(super) fn response(lambda: f64, G: f64, F: &Matrix3<f64>) -> Response {
    let strain = (F + F.transpose()) * 0.5 - Matrix3::identity();
    let mut tangent = Tangent::zeros();
    for a in 0..3 {
        for b in 0..3 {
            tangent[(4 * a, 4 * b)] += lambda;
            tangent[(3 * a + b, 3 * a + b)] += G;
            tangent[(3 * a + b, 3 * b + a)] += G;
        }
    }
    Response {
        energy: energy(lambda, G, F),
        first_piola: Matrix3::identity() * (lambda * strain.trace()) + strain * (2.0 * G),
        tangent,
    }
}
