//! Stored energy, internal force and consistent stiffness of an element.

use super::{ElementError, ReferenceElement, UNKNOWNS};
use striae_law::bulk::{Inverted, Material, Tangent};
use striae_mesh::Vec3;

/// Energy of an element with its first and second derivatives.
#[derive(Clone, Debug, PartialEq)]
pub struct ElementResponse {
    /// Stored energy.
    pub energy: f64,
    /// Internal force, the derivative of the energy by the corner positions.
    pub force: [f64; UNKNOWNS],
    /// Derivative of the force, row by row; symmetric.
    pub stiffness: [f64; UNKNOWNS * UNKNOWNS],
}

/// Response of the element with reference corners `X` and current corners `x`.
///
/// # Errors
///
/// [`ElementError`] if the element is inside out in either configuration.
pub fn response(
    reference: &[Vec3; 8],
    current: &[Vec3; 8],
    material: &Material,
) -> Result<ElementResponse, ElementError> {
    ReferenceElement::new(reference)?.response(current, material)
}

/// `w A_iJkL G_b,L` with row `3 i + J` and column `3 b + k`.
type WeightedTangent = [[f64; UNKNOWNS]; 9];

impl ReferenceElement {
    /// Response to current corner positions `x`.
    ///
    /// # Errors
    ///
    /// [`ElementError::Inverted`] where the material is turned inside out.
    pub fn response(
        &self,
        current: &[Vec3; 8],
        material: &Material,
    ) -> Result<ElementResponse, ElementError> {
        let mut energy = 0.0;
        let mut force = [0.0; UNKNOWNS];
        let mut tangents = [[[0.0; UNKNOWNS]; 9]; 8];
        for g in 0..8 {
            let (weight, gradients) = (self.weights[g], &self.gradients[g]);
            let f = self.deformation_gradient(g, current);
            let response = material.response(&f).map_err(inverted_at(g))?;
            energy += weight * response.energy;
            let stress = response.first_piola * weight;
            for (a, gradient) in gradients.iter().enumerate() {
                for i in 0..3 {
                    force[3 * a + i] += (0..3).map(|j| stress[(i, j)] * gradient[j]).sum::<f64>();
                }
            }
            tangents[g] = weighted_tangent(weight, &response.tangent, gradients);
        }
        Ok(ElementResponse {
            energy,
            force,
            stiffness: self.stiffness(&tangents),
        })
    }

    /// `K_aibk = sum_gJ G_a,J T_iJ,bk`: whole rows of `K` are summed in
    /// registers over all Gauss points.
    fn stiffness(&self, tangents: &[WeightedTangent; 8]) -> [f64; UNKNOWNS * UNKNOWNS] {
        let mut stiffness = [0.0; UNKNOWNS * UNKNOWNS];
        for (row, target) in stiffness.chunks_exact_mut(UNKNOWNS).enumerate() {
            let (a, i) = (row / 3, row % 3);
            let mut sum = [0.0; UNKNOWNS];
            for (gradients, tangent) in self.gradients.iter().zip(tangents) {
                let [x, y, z] = gradients[a];
                let [t_x, t_y, t_z] = [&tangent[3 * i], &tangent[3 * i + 1], &tangent[3 * i + 2]];
                for column in 0..UNKNOWNS {
                    sum[column] += x * t_x[column] + y * t_y[column] + z * t_z[column];
                }
            }
            target.copy_from_slice(&sum);
        }
        stiffness
    }
}

/// The error of the material as an error of the element at Gauss point `g`.
pub(super) fn inverted_at(g: usize) -> impl Fn(Inverted) -> ElementError {
    move |inverted| ElementError::Inverted {
        gauss_point: g,
        determinant: inverted.determinant,
    }
}

fn weighted_tangent(weight: f64, tangent: &Tangent, gradients: &[[f64; 3]; 8]) -> WeightedTangent {
    let weighted = tangent * weight;
    let mut product = [[0.0; UNKNOWNS]; 9];
    for (b, gradient) in gradients.iter().enumerate() {
        for k in 0..3 {
            for row in 0..9 {
                product[row][3 * b + k] = (0..3)
                    .map(|l| weighted[(row, 3 * k + l)] * gradient[l])
                    .sum();
            }
        }
    }
    product
}
