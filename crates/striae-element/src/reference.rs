//! Data of an element that depend on its reference configuration only.

use super::{ElementError, rule::Rule};
use nalgebra::Matrix3;
use pulp::{Arch, Simd, WithSimd};
use striae_mesh::Vec3;

/// Matrices at the quadrature points, by component `3 i + J`.
pub(super) type Matrices<const Q: usize> = [[f64; Q]; 9];

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
        let points = self.deformation_gradients(current).into_iter();
        let points = points.zip(self.weights).map(|(f, weight)| f * weight);
        let decomposed = points.sum::<Matrix3<f64>>().svd(true, true);
        let rotation = decomposed.u.zip(decomposed.v_t).map(|(u, v)| u * v);
        let cosine = rotation.map_or(1.0, |rotation| 0.5 * (rotation.trace() - 1.0));
        cosine.clamp(-1.0, 1.0).acos()
    }

    /// `sum_g T_iJ G_a,J` of matrices at the quadrature points, by component and corner.
    #[inline(always)]
    pub(super) fn gathered(&self, matrices: &Matrices<Q>) -> Gradients<N> {
        let mut sums = [[0.0; N]; 3];
        for (i, sums) in sums.iter_mut().enumerate() {
            for (g, [x, y, z]) in self.gradients.iter().enumerate() {
                let [t_x, t_y, t_z] = [
                    matrices[3 * i][g],
                    matrices[3 * i + 1][g],
                    matrices[3 * i + 2][g],
                ];
                for a in 0..N {
                    sums[a] += t_x * x[a] + t_y * y[a] + t_z * z[a];
                }
            }
        }
        sums
    }

    /// Deformation gradients `F` at the quadrature points for current corners `x`.
    pub(super) fn deformation_gradients(&self, current: &[Vec3; N]) -> [Matrix3<f64>; Q] {
        let gradients = &self.gradients;
        Arch::new().dispatch(DeformationGradients { gradients, current })
    }
}

/// Deformation gradients by as many lanes as the processor has: they are filled with
/// components of the positions.
struct DeformationGradients<'a, const N: usize, const Q: usize> {
    gradients: &'a [Gradients<N>; Q],
    current: &'a [Vec3; N],
}

impl<const N: usize, const Q: usize> WithSimd for DeformationGradients<'_, N, Q> {
    type Output = [Matrix3<f64>; Q];

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> Self::Output {
        // With a fourth component, as lanes come in fours.
        let mut positions = [[0.0; 4]; N];
        for (position, x) in positions.iter_mut().zip(self.current) {
            position[..3].copy_from_slice(&x.data.0[0]);
        }
        let mut all = [Matrix3::zeros(); Q];
        for (f, gradients) in all.iter_mut().zip(self.gradients) {
            for (column, gradients) in f.data.0.iter_mut().zip(gradients) {
                let mut sums = [0.0; 4];
                for (x, gradient) in positions.iter().zip(gradients) {
                    (0..4).for_each(|i| sums[i] += x[i] * gradient);
                }
                column.copy_from_slice(&sums[..3]);
            }
        }
        all
    }
}
