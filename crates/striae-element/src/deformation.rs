//! The deformation at the quadrature points of an element whose volume ratios are taken to their
//! mean, point by point in the lanes of the processor.

use super::{
    ElementError,
    reference::{Matrices, Reference},
};
use nalgebra::Matrix3;
use pulp::{Arch, Simd, WithSimd};
use striae_mesh::Vec3;

/// Deformation at the quadrature points.
pub(super) struct Deformation<const Q: usize> {
    /// `F`.
    pub(super) gradients: Matrices<Q>,
    /// `H = F^-T`.
    pub(super) inverse_transposed: Matrices<Q>,
    /// `J`.
    pub(super) ratios: [f64; Q],
    /// `alpha`.
    pub(super) scales: [f64; Q],
    /// `Fbar = alpha F`.
    pub(super) scaled: [Matrix3<f64>; Q],
    /// The current volume `theta V`.
    pub(super) volume: f64,
}

impl<const N: usize, const Q: usize> Reference<N, Q> {
    /// Deformation with current corners `x`, with volume ratios taken a `share` of the way to
    /// their mean.
    ///
    /// # Errors
    ///
    /// [`ElementError::Inverted`] where the element is turned inside out.
    pub(super) fn deformation(
        &self,
        current: &[Vec3; N],
        share: f64,
    ) -> Result<Deformation<Q>, ElementError> {
        let deformation = Arch::new().dispatch(Deformed {
            gradients: self.deformation_gradients(current),
            weights: &self.weights,
            volume: self.volume(),
            share,
        });
        let mut ratios = deformation.ratios.iter().copied().enumerate();
        match ratios.find(|(_, determinant)| determinant.is_nan() || *determinant <= 0.0) {
            Some((point, determinant)) => Err(ElementError::Inverted { point, determinant }),
            None => Ok(deformation),
        }
    }
}

/// Input of a [`Deformation`]: deformation gradients with their weights.
struct Deformed<'a, const Q: usize> {
    gradients: [Matrix3<f64>; Q],
    weights: &'a [f64; Q],
    /// `V`.
    volume: f64,
    share: f64,
}

impl<const Q: usize> WithSimd for Deformed<'_, Q> {
    type Output = Deformation<Q>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> Self::Output {
        let f = by_components(&self.gradients);
        let mut h = [[0.0; Q]; 9];
        for at in 0..9 {
            let (i, j) = (at / 3, at % 3);
            let [k, l, m, n] = [(i + 1) % 3, (i + 2) % 3, (j + 1) % 3, (j + 2) % 3];
            for g in 0..Q {
                h[at][g] = f[3 * k + m][g] * f[3 * l + n][g] - f[3 * k + n][g] * f[3 * l + m][g];
            }
        }
        let (mut ratios, mut volume) = ([0.0; Q], 0.0);
        for g in 0..Q {
            ratios[g] = f[0][g] * h[0][g] + f[3][g] * h[3][g] + f[6][g] * h[6][g];
        }
        for g in 0..Q {
            volume += self.weights[g] * ratios[g];
        }
        let theta = volume / self.volume;
        let (mut scales, mut scaled) = ([0.0; Q], self.gradients);
        for g in 0..Q {
            scales[g] = theta / ratios[g];
        }
        scales = cube_roots(scales);
        if self.share != 1.0 {
            for scale in &mut scales {
                *scale = scale.powf(self.share);
            }
        }
        for at in 0..9 {
            for g in 0..Q {
                h[at][g] /= ratios[g];
            }
        }
        for g in 0..Q {
            scaled[g] *= scales[g];
        }
        Deformation {
            gradients: f,
            inverse_transposed: h,
            ratios,
            scales,
            scaled,
            volume,
        }
    }
}

/// Matrices by components.
#[inline(always)]
pub(super) fn by_components<const Q: usize>(matrices: &[Matrix3<f64>; Q]) -> Matrices<Q> {
    let mut components = [[0.0; Q]; 9];
    for (g, matrix) in matrices.iter().enumerate() {
        for at in 0..9 {
            components[at][g] = matrix.data.0[at % 3][at / 3];
        }
    }
    components
}

/// Cube roots of positive numbers, side by side: Halley's method, whose error is the cube
/// of the one before, from a third of the exponent, which is right to 5 %.
#[inline(always)]
fn cube_roots<const Q: usize>(numbers: [f64; Q]) -> [f64; Q] {
    /// Two thirds of the bits of 1.
    const BIAS: u64 = 0x2a9f_7893_782d_a1ce;
    let mut roots = [0.0; Q];
    for g in 0..Q {
        roots[g] = f64::from_bits(numbers[g].to_bits() / 3 + BIAS);
    }
    for _ in 0..3 {
        for g in 0..Q {
            let (root, x) = (roots[g], numbers[g]);
            let cube = root * root * root;
            roots[g] = root * ((cube + 2.0 * x) / (2.0 * cube + x));
        }
    }
    roots
}

#[cfg(test)]
mod tests {
    use super::cube_roots;

    #[test]
    fn cube_roots_are_right_to_round_off_at_all_sizes() {
        let numbers = (-500..500).map(|at| (0.37 * f64::from(at)).exp());
        for x in numbers.chain([1.0, 8.0, 1e-300, 1e300]) {
            let [root] = cube_roots([x]);
            let error = (root / x.cbrt() - 1.0).abs();
            assert!(error < 4.0 * f64::EPSILON, "{x}: {error}");
        }
    }
}
