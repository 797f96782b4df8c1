//! What an element knows from its reference configuration alone.

use super::shape::{gauss_point, shape_gradients};
use super::{ElementError, ElementFault};
use nalgebra::Matrix3;
use striae_mesh::{ElementId, Mesh, Vec3};

/// `G_a,J = dN_a/dX_J` by component `J` and corner `a`.
pub(super) type Gradients = [[f64; 8]; 3];

/// Reference gradients and volumes at the Gauss points of an element.
#[derive(Clone, Debug, PartialEq)]
pub struct ReferenceElement {
    /// By Gauss point.
    pub(super) gradients: [Gradients; 8],
    /// Reference volume that belongs to each Gauss point.
    pub(super) weights: [f64; 8],
}

/// The reference elements of a mesh, in the order of its elements.
///
/// # Errors
///
/// The first element whose reference shape is degenerate.
pub fn reference_elements(mesh: &Mesh) -> Result<Vec<ReferenceElement>, ElementFault> {
    (0..mesh.elements.len())
        .map(ElementId::new)
        .map(|element| {
            ReferenceElement::new(&mesh.element_positions(element))
                .map_err(|error| ElementFault { element, error })
        })
        .collect()
}

impl ReferenceElement {
    /// From the reference positions `X` of the corners.
    ///
    /// # Errors
    ///
    /// [`ElementError::Degenerate`] where `dX/dxi` is not positive at a Gauss point.
    pub fn new(reference: &[Vec3; 8]) -> Result<Self, ElementError> {
        let mut gradients = [[[0.0; 8]; 3]; 8];
        let mut weights = [0.0; 8];
        for g in 0..8 {
            let local = shape_gradients(&gauss_point(g));
            let jacobian: Matrix3<f64> = (0..8).map(|a| reference[a] * local[a].transpose()).sum();
            let determinant = jacobian.determinant();
            let Some(inverse) = jacobian.try_inverse().filter(|_| determinant > 0.0) else {
                return Err(ElementError::Degenerate {
                    gauss_point: g,
                    determinant,
                });
            };
            let inverse_transposed = inverse.transpose();
            for a in 0..8 {
                let gradient = inverse_transposed * local[a];
                (0..3).for_each(|j| gradients[g][j][a] = gradient[j]);
            }
            weights[g] = determinant;
        }
        Ok(Self { gradients, weights })
    }

    /// Mean of `sum_g w |G_a|^2` over the corners: what a modulus is multiplied by to give
    /// the mean of the diagonal of a stiffness, `h/3` in a cube and `V/h^2` across what is flat.
    pub fn stiffness_per_modulus(&self) -> f64 {
        let points = self.gradients.iter().zip(&self.weights);
        let sum: f64 = points
            .map(|(gradients, weight)| {
                let squares = gradients.as_flattened().iter().map(|g| g * g);
                weight * squares.sum::<f64>()
            })
            .sum();
        sum / 8.0
    }

    /// Reference volume.
    pub fn volume(&self) -> f64 {
        self.weights.iter().sum()
    }

    /// Angle by which the element with the current corners `x` is turned on average.
    pub fn rotation(&self, current: &[Vec3; 8]) -> f64 {
        let points = (0..8).map(|g| self.deformation_gradient(g, current) * self.weights[g]);
        let decomposed = points.sum::<Matrix3<f64>>().svd(true, true);
        let rotation = decomposed.u.zip(decomposed.v_t).map(|(u, v)| u * v);
        let cosine = rotation.map_or(1.0, |rotation| 0.5 * (rotation.trace() - 1.0));
        cosine.clamp(-1.0, 1.0).acos()
    }

    /// Deformation gradient `F` at Gauss point `g`, `0..8`, for current corners `x`.
    pub(super) fn deformation_gradient(&self, g: usize, current: &[Vec3; 8]) -> Matrix3<f64> {
        let gradients = &self.gradients[g];
        Matrix3::from_fn(|i, j| (0..8).map(|a| current[a][i] * gradients[j][a]).sum())
    }
}
