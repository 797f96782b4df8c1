//! What an element knows from its reference configuration alone.

use super::{ElementError, rule::Rule};
use nalgebra::Matrix3;
use striae_mesh::Vec3;

/// `G_a,J = dN_a/dX_J` by component `J` and corner `a`.
pub(super) type Gradients<const N: usize> = [[f64; N]; 3];

/// Reference gradients and volumes at the quadrature points of an element.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Reference<const N: usize, const Q: usize> {
    /// By quadrature point.
    pub(super) gradients: [Gradients<N>; Q],
    /// Reference volume that belongs to each quadrature point.
    pub(super) weights: [f64; Q],
}

impl<const N: usize, const Q: usize> Reference<N, Q> {
    /// From the reference positions `X` of the corners.
    ///
    /// # Errors
    ///
    /// [`ElementError::Degenerate`] where `dX/dxi` is not positive at a quadrature point.
    pub(super) fn new(rule: &Rule<N, Q>, corners: &[Vec3; N]) -> Result<Self, ElementError> {
        let mut gradients = [[[0.0; N]; 3]; Q];
        let mut weights = [0.0; Q];
        for g in 0..Q {
            let local = &rule.gradients[g];
            let jacobian: Matrix3<f64> = (0..N).map(|a| corners[a] * local[a].transpose()).sum();
            let determinant = jacobian.determinant();
            let Some(inverse) = jacobian.try_inverse().filter(|_| determinant > 0.0) else {
                return Err(ElementError::Degenerate {
                    point: g,
                    determinant,
                });
            };
            let inverse_transposed = inverse.transpose();
            for a in 0..N {
                let gradient = inverse_transposed * local[a];
                (0..3).for_each(|j| gradients[g][j][a] = gradient[j]);
            }
            weights[g] = determinant * rule.weights[g];
        }
        Ok(Self { gradients, weights })
    }

    /// Mean of `sum_g w |G_a|^2` over the corners.
    pub(super) fn stiffness_per_modulus(&self) -> f64 {
        let points = self.gradients.iter().zip(&self.weights);
        let sum: f64 = points
            .map(|(gradients, weight)| {
                let squares = gradients.as_flattened().iter().map(|g| g * g);
                weight * squares.sum::<f64>()
            })
            .sum();
        sum / N as f64
    }

    /// Reference volume.
    pub(super) fn volume(&self) -> f64 {
        self.weights.iter().sum()
    }

    /// Angle by which the element with the current corners `x` is turned on average.
    pub(super) fn rotation(&self, current: &[Vec3; N]) -> f64 {
        let points = (0..Q).map(|g| self.deformation_gradient(g, current) * self.weights[g]);
        let decomposed = points.sum::<Matrix3<f64>>().svd(true, true);
        let rotation = decomposed.u.zip(decomposed.v_t).map(|(u, v)| u * v);
        let cosine = rotation.map_or(1.0, |rotation| 0.5 * (rotation.trace() - 1.0));
        cosine.clamp(-1.0, 1.0).acos()
    }

    /// Deformation gradient `F` at a quadrature point for current corners `x`.
    pub(super) fn deformation_gradient(&self, g: usize, current: &[Vec3; N]) -> Matrix3<f64> {
        let gradients = &self.gradients[g];
        Matrix3::from_fn(|i, j| (0..N).map(|a| current[a][i] * gradients[j][a]).sum())
    }
}
