//! Stored energy, internal force and consistent stiffness of an element.

use super::{ElementError, ReferenceElement, UNKNOWNS};
use nalgebra::Matrix3;
use striae_law::bulk::{Inverted, Material, Tangent};
use striae_mesh::Vec3;

/// Energy of an element with its first and second derivatives.
#[derive(Clone, Debug, PartialEq)]
pub struct ElementResponse {
    /// Stored energy.
    pub energy: f64,
    /// Internal force, the derivative of the energy by the corner positions.
    pub force: [f64; UNKNOWNS],
    /// Derivative of the force, row by row; symmetric to the last bit.
    pub stiffness: [f64; UNKNOWNS * UNKNOWNS],
}

impl Default for ElementResponse {
    fn default() -> Self {
        Self {
            energy: 0.0,
            force: [0.0; UNKNOWNS],
            stiffness: [0.0; UNKNOWNS * UNKNOWNS],
        }
    }
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
        let mut response = ElementResponse::default();
        self.respond(current, material, &mut response)?;
        Ok(response)
    }

    /// The same, written over an older response.
    ///
    /// # Errors
    ///
    /// As [`ReferenceElement::response`].
    pub fn respond(
        &self,
        current: &[Vec3; 8],
        material: &Material,
        element: &mut ElementResponse,
    ) -> Result<(), ElementError> {
        element.energy = 0.0;
        element.force = [0.0; UNKNOWNS];
        let mut tangents = [Tangent::zeros(); 8];
        for g in 0..8 {
            let f = self.deformation_gradient(g, current);
            let response = material.response(&f).map_err(inverted_at(g))?;
            element.energy += self.weights[g] * response.energy;
            self.add_force(g, &response.first_piola, &mut element.force);
            tangents[g] = response.tangent * self.weights[g];
        }
        self.stiffness(&tangents, &mut element.stiffness);
        Ok(())
    }

    /// `f_ai += w P_iJ G_a,J` at Gauss point `g`.
    fn add_force(&self, g: usize, first_piola: &Matrix3<f64>, force: &mut [f64; UNKNOWNS]) {
        let [x, y, z] = &self.gradients[g];
        let stress = first_piola * self.weights[g];
        for a in 0..8 {
            for i in 0..3 {
                force[3 * a + i] +=
                    stress[(i, 0)] * x[a] + stress[(i, 1)] * y[a] + stress[(i, 2)] * z[a];
            }
        }
    }

    /// Stiffness from the tangents `w A`, by its symmetric half: of the blocks
    /// `K_ik` over the corners those with `i <= k`.
    fn stiffness(&self, tangents: &[Tangent; 8], stiffness: &mut [f64; UNKNOWNS * UNKNOWNS]) {
        for (i, k) in [(0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)] {
            let block = self.block(tangents, i, k);
            for a in 0..8 {
                for b in 0..8 {
                    stiffness[UNKNOWNS * (3 * a + i) + 3 * b + k] = block[a][b];
                    stiffness[UNKNOWNS * (3 * b + k) + 3 * a + i] = block[a][b];
                }
            }
        }
    }

    /// `K_ab = sum_gJ G_a,J (sum_L w A_iJkL G_b,L)` for two components `i`, `k`:
    /// a product of an 8x24 and a 24x8 matrix, summed row by row in registers.
    fn block(&self, tangents: &[Tangent; 8], i: usize, k: usize) -> [[f64; 8]; 8] {
        let mut right = [[[0.0; 8]; 3]; 8];
        for ((right, tangent), [x, y, z]) in right.iter_mut().zip(tangents).zip(&self.gradients) {
            for j in 0..3 {
                let [t_x, t_y, t_z] = [0, 1, 2].map(|l| tangent[(3 * i + j, 3 * k + l)]);
                for b in 0..8 {
                    right[j][b] = t_x * x[b] + t_y * y[b] + t_z * z[b];
                }
            }
        }
        std::array::from_fn(|a| {
            let mut row = [0.0; 8];
            for (left, right) in self.gradients.iter().zip(&right) {
                for j in 0..3 {
                    for b in 0..8 {
                        row[b] += left[j][a] * right[j][b];
                    }
                }
            }
            row
        })
    }
}

/// The error of the material as an error of the element at Gauss point `g`.
pub(super) fn inverted_at(g: usize) -> impl Fn(Inverted) -> ElementError {
    move |inverted| ElementError::Inverted {
        gauss_point: g,
        determinant: inverted.determinant,
    }
}
