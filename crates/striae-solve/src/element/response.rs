//! Stored energy, internal force and consistent stiffness of an element.

use super::{
    ElementError, ReferenceElement, Stiffness, UNKNOWNS,
    reference::Gradients,
    stiffness::{Block, COMPONENTS},
};
use nalgebra::Matrix3;
use pulp::{Arch, Simd, WithSimd};
use striae_law::bulk::{Material, ResponseError, Tangent};
use striae_mesh::Vec3;

/// Energy of an element with its first and second derivatives.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ElementResponse {
    /// Stored energy.
    pub energy: f64,
    /// Internal force, the derivative of the energy by the corner positions.
    pub force: [f64; UNKNOWNS],
    /// Derivative of the force, symmetric to the last bit.
    pub stiffness: Stiffness,
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
            let response = material.response(&f).map_err(error_at(g))?;
            element.energy += self.weights[g] * response.energy;
            self.add_force(g, &response.first_piola, &mut element.force);
            tangents[g] = response.tangent;
        }
        Arch::new().dispatch(Sum {
            element: self,
            tangents: &tangents,
            stiffness: &mut element.stiffness,
        });
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
}

/// The stiffness from the tangents, by as many lanes as the processor has: they are filled
/// with corners, so that sums do not depend on their number.
struct Sum<'a> {
    element: &'a ReferenceElement,
    tangents: &'a [Tangent; 8],
    stiffness: &'a mut Stiffness,
}

impl WithSimd for Sum<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let gradients = &self.element.gradients;
        for ((i, k), block) in COMPONENTS.into_iter().zip(&mut self.stiffness.0) {
            let right = right(self.element, self.tangents, i, k);
            product(gradients.as_flattened(), right.as_flattened(), block);
            if i == k {
                mirror(block);
            }
        }
    }
}

/// `sum_L w A_iJkL G_b,L` for two components `i`, `k` by Gauss point, `J` and corner.
#[inline(always)]
fn right(
    element: &ReferenceElement,
    tangents: &[Tangent; 8],
    i: usize,
    k: usize,
) -> [Gradients; 8] {
    let mut right = [[[0.0; 8]; 3]; 8];
    for g in 0..8 {
        let ([x, y, z], weight) = (&element.gradients[g], element.weights[g]);
        for j in 0..3 {
            let [t_x, t_y, t_z] =
                [0, 1, 2].map(|l| tangents[g].data.0[3 * k + l][3 * i + j] * weight);
            for b in 0..8 {
                right[g][j][b] = t_x * x[b] + t_y * y[b] + t_z * z[b];
            }
        }
    }
    right
}

/// `K_ab = sum_gJ G_a,J R_gJ,b`, a product of an 8x24 and a 24x8 matrix, some rows at a
/// time in registers.
#[inline(always)]
fn product(left: &[[f64; 8]], right: &[[f64; 8]], block: &mut Block) {
    const ROWS: usize = 4;
    for (first, rows) in (0..8).step_by(ROWS).zip(block.chunks_exact_mut(ROWS)) {
        let mut sums = [[0.0; 8]; ROWS];
        for (left, right) in left.iter().zip(right) {
            for a in 0..ROWS {
                for b in 0..8 {
                    sums[a][b] += left[first + a] * right[b];
                }
            }
        }
        rows.copy_from_slice(&sums);
    }
}

/// Makes a block symmetric to the last bit.
#[inline(always)]
fn mirror(block: &mut Block) {
    for a in 0..8 {
        for b in 0..a {
            block[b][a] = block[a][b];
        }
    }
}

/// The error of the material as an error of the element at Gauss point `g`.
pub(super) fn error_at(g: usize) -> impl Fn(ResponseError) -> ElementError {
    move |error| match error {
        ResponseError::Inverted { determinant } => ElementError::Inverted {
            gauss_point: g,
            determinant,
        },
        ResponseError::Overstretched { strain, limit } => ElementError::Overstretched {
            gauss_point: g,
            strain,
            limit,
        },
    }
}
