//! Mean dilatation: an element that does not lock where volumes cannot change.
//!
//! Pressure and volume ratio are constant in the element. With them condensed, the
//! energy is that of the deformation gradients whose volume ratio is the mean one, or a part
//! `beta` of the way from their own to it,
//!
//! ```text
//! theta = sum_g w J / V,   alpha = (theta/J)^(beta/3),   Fbar = alpha F
//! W_e   = sum_g w W(Fbar)
//! ```
//!
//! (Simo, Taylor & Pister, Comput. Methods Appl. Mech. Eng. 51 (1985) 177,
//! doi:10.1016/0045-7825(85)90033-7). `W` is any law; `beta` is 1 but in composite elements
//! (`composite.rs`). With `Pbar`, `Abar` of the law at `Fbar`, `H = F^-T`,
//! `pi = beta Pbar : Fbar / 3` and the pressure `p = sum_g w pi / (theta V)`
//!
//! ```text
//! P     = alpha Pbar + (p J - pi) H                           f_a = sum_g w P G_a
//! M     = alpha beta (Pbar + Abar : Fbar),   m = beta M : F
//! A     = alpha^2 Abar - (M x H + H x M)/3 + (p J + m/9) H x H - (p J - pi) H_iL H_kJ
//! b_a   = sum_g w J H G_a / (theta V),   c_a = sum_g w (M/3 - m/9 H) G_a
//! K     = sum_g w G_a A G_b + c x b + b x c + (sum_g w m/9 - p theta V) b x b,
//! ```
//!
//! which is the derivative of `f` and symmetric. Points of a material with a memory remember
//! what they have been through by `Fbar`. Where gradients are constant in the
//! element (tetrahedra) all is as without it.

use super::{
    ElementError, ElementResponse,
    reference::Reference,
    response::{error_at, product, stiffness},
};
use nalgebra::Matrix3;
use pulp::{Arch, Simd, WithSimd};
use striae_law::bulk::{Material, Past, Tangent};
use striae_mesh::Vec3;

/// Deformation at a quadrature point, and the law at `Fbar` but for its tangent.
#[derive(Clone, Copy, Default)]
struct Point {
    /// `F`.
    gradient: Matrix3<f64>,
    /// `F^-T`.
    inverse_transposed: Matrix3<f64>,
    /// `J`.
    ratio: f64,
    /// `alpha`.
    scale: f64,
    /// `Pbar`.
    first_piola: Matrix3<f64>,
    /// `pi`.
    third: f64,
}

impl<const N: usize, const Q: usize> Reference<N, Q> {
    /// As [`Reference::respond`], with mean dilatation.
    ///
    /// # Errors
    ///
    /// [`ElementError::Inverted`] where the element is turned inside out.
    pub(super) fn respond_with_mean_dilatation(
        &self,
        current: &[Vec3; N],
        material: &Material,
        past: Past,
        element: &mut ElementResponse,
        share: f64,
    ) -> Result<(), ElementError> {
        let (mut points, volume) = self.points(current, share)?;
        let mut tangents = [Tangent::zeros(); Q];
        (element.energy, element.dissipated) = (0.0, 0.0);
        for (g, point) in points.iter_mut().enumerate() {
            let scaled = point.gradient * point.scale;
            let mut present = element.present(g, Q);
            let law = material.respond(&scaled, past.of_point(g, Q), &mut present);
            let dissipated = present.dissipated;
            let law = law.map_err(error_at(g))?;
            element.energy += self.weights[g] * law.energy;
            element.dissipated += self.weights[g] * dissipated;
            tangents[g] = law.tangent;
            point.first_piola = law.first_piola;
            point.third = law.first_piola.dot(&scaled) * share / 3.0;
        }
        Arch::new().dispatch(Completion {
            reference: self,
            points: &points,
            pressure: self.mean(|g| points[g].third) / volume,
            volume,
            share,
            tangents: &mut tangents,
            element,
        });
        Ok(())
    }

    /// Cauchy stress at the quadrature points: the deviator of the law and the common
    /// pressure; with `Jbar = det Fbar` and `sigma` of the law at `Fbar`
    ///
    /// ```text
    /// Jbar/J (dev sigma + (1 - beta) tr(sigma)/3 I) + p I,
    /// p = sum_g w beta Jbar tr(sigma)/3 / (theta V).
    /// ```
    pub(super) fn stress_with_mean_dilatation(
        &self,
        current: &[Vec3; N],
        material: &Material,
        variables: &[f64],
        share: f64,
    ) -> Result<Vec<Matrix3<f64>>, ElementError> {
        let (points, volume) = self.points(current, share)?;
        let theta = volume / self.volume();
        let each = variables.len() / Q;
        let mut stress = Vec::with_capacity(Q);
        let ratio = |point: &Point| theta * (point.ratio / theta).powf(1.0 - share);
        for (g, point) in points.iter().enumerate() {
            let scaled = point.gradient * point.scale;
            let variables = &variables[g * each..(g + 1) * each];
            let found = material.cauchy_stress_after(&scaled, variables);
            stress.push(found.map_err(error_at(g))?);
        }
        let at_point = |g: usize| stress[g].trace() / 3.0 * (ratio(&points[g]) / theta);
        let pressure = self.mean(|g| share * at_point(g)) / self.volume();
        for (sigma, point) in stress.iter_mut().zip(&points) {
            let mean = Matrix3::identity() * (share * sigma.trace() / 3.0);
            let own = (*sigma - mean) * (ratio(point) / point.ratio);
            *sigma = own + Matrix3::identity() * pressure;
        }
        Ok(stress)
    }

    /// Deformation at all points, and the current volume `theta V`.
    fn points(&self, current: &[Vec3; N], share: f64) -> Result<([Point; Q], f64), ElementError> {
        let mut points = [Point::default(); Q];
        for (g, point) in points.iter_mut().enumerate() {
            let gradient = self.deformation_gradient(g, current);
            let [a, b, c] = [0, 1, 2].map(|j| gradient.column(j).into_owned());
            let (first, determinant) = (b.cross(&c), a.dot(&b.cross(&c)));
            if determinant.is_nan() || determinant <= 0.0 {
                let point = g;
                return Err(ElementError::Inverted { point, determinant });
            }
            let cofactors = Matrix3::from_columns(&[first, c.cross(&a), a.cross(&b)]);
            point.gradient = gradient;
            point.inverse_transposed = cofactors * determinant.recip();
            point.ratio = determinant;
        }
        let volume = self.mean(|g| points[g].ratio);
        let theta = volume / self.volume();
        let whole: [f64; Q] = cube_roots(std::array::from_fn(|g| theta / points[g].ratio));
        for (point, whole) in points.iter_mut().zip(whole) {
            point.scale = if share == 1.0 {
                whole
            } else {
                whole.powf(share)
            };
        }
        Ok((points, volume))
    }

    /// `sum_g w value`.
    fn mean(&self, value: impl Fn(usize) -> f64) -> f64 {
        (0..Q).map(|g| self.weights[g] * value(g)).sum()
    }
}

/// Cube roots of positive numbers, side by side: Halley's method, whose error is the cube
/// of the one before, from a third of the exponent, which is right to 5 %.
fn cube_roots<const Q: usize>(numbers: [f64; Q]) -> [f64; Q] {
    /// Two thirds of the bits of 1.
    const BIAS: u64 = 0x2a9f_7893_782d_a1ce;
    let mut roots = numbers.map(|x| f64::from_bits(x.to_bits() / 3 + BIAS));
    for _ in 0..3 {
        for (root, x) in roots.iter_mut().zip(numbers) {
            let cube = *root * *root * *root;
            *root *= (cube + 2.0 * x) / (2.0 * cube + x);
        }
    }
    roots
}

/// Makes of the tangents of the law those for the mean volume held,
/// `alpha^2 Abar + H x W + W x H - (p J - pi) H_iL H_kJ` with `W = (p J + m/9)/2 H - M/3`,
/// and writes force and stiffness, by as many lanes as the processor has.
struct Completion<'a, const N: usize, const Q: usize> {
    reference: &'a Reference<N, Q>,
    points: &'a [Point; Q],
    pressure: f64,
    volume: f64,
    share: f64,
    tangents: &'a mut [Tangent; Q],
    element: &'a mut ElementResponse,
}

impl<const N: usize, const Q: usize> WithSimd for Completion<'_, N, Q> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        // What the gradients of a point are multiplied by, by J: components i of the force, of
        // b_a and of c_a.
        let mut factors = [[[0.0; 9]; 3]; Q];
        let mut curvature = -self.pressure * self.volume;
        for (g, point) in self.points.iter().enumerate() {
            let tangent = &mut self.tangents[g].data.0;
            let weight = self.reference.weights[g];
            let f = components(&point.gradient);
            let h = components(&point.inverse_transposed);
            let stress = components(&point.first_piola);
            let m = turned(tangent, &f).map(|of_f| of_f * point.scale);
            let m: [f64; 9] =
                std::array::from_fn(|at| (stress[at] + m[at]) * (point.scale * self.share));
            let ninth = (0..9).map(|at| m[at] * f[at]).sum::<f64>() * self.share / 9.0;
            let normal = self.pressure * point.ratio;
            let excess = normal - point.third;
            curvature += weight * ninth;
            let ratio = point.ratio / self.volume;
            for at in 0..9 {
                let (i, j) = (at / 3, at % 3);
                factors[g][j][i] = (stress[at] * point.scale + h[at] * excess) * weight;
                factors[g][j][3 + i] = h[at] * ratio * weight;
                factors[g][j][6 + i] = (m[at] / 3.0 - h[at] * ninth) * weight;
            }
            let half = 0.5 * (normal + ninth);
            let w = std::array::from_fn(|at| h[at] * half - m[at] / 3.0);
            complete(tangent, point.scale * point.scale, &h, &w, excess);
        }
        let gradients = self.reference.gradients.as_flattened();
        let mut sums = [[0.0; N]; 9];
        product::<9, N, 3, 1>([(factors.as_flattened(), gradients)], &mut sums);
        let [f_x, f_y, f_z, b @ .., c_x, c_y, c_z] = sums;
        for (a, force) in self.element.force.iter_mut().enumerate() {
            *force = [f_x[a], f_y[a], f_z[a]];
        }
        // c x b + b x c + s b x b is d x b + b x d.
        let mut d = [c_x, c_y, c_z];
        for (d, b) in d.as_flattened_mut().iter_mut().zip(b.as_flattened()) {
            *d += 0.5 * curvature * b;
        }
        stiffness(
            self.reference,
            self.tangents,
            |i, k| ([d[i], b[i]], [b[k], d[k]]),
            &mut self.element.stiffness,
        );
    }
}

/// `A : F`, the tangent by columns.
#[inline(always)]
fn turned(tangent: &[[f64; 9]; 9], f: &[f64; 9]) -> [f64; 9] {
    let mut sums = [0.0; 9];
    for (column, by) in tangent.iter().zip(f) {
        for row in 0..9 {
            sums[row] += column[row] * by;
        }
    }
    sums
}

/// The tangent for the mean volume held, by columns; of its blocks those with `i <= k` and
/// what shares their lanes, as the stiffness needs no others.
#[inline(always)]
fn complete(tangent: &mut [[f64; 9]; 9], square: f64, h: &[f64; 9], w: &[f64; 9], excess: f64) {
    column_block::<4>(tangent, 0, square, h, w, excess);
    column_block::<8>(tangent, 1, square, h, w, excess);
    column_block::<9>(tangent, 2, square, h, w, excess);
}

/// Completes the first rows of the columns `3 k + L`.
#[inline(always)]
fn column_block<const ROWS: usize>(
    tangent: &mut [[f64; 9]; 9],
    k: usize,
    square: f64,
    h: &[f64; 9],
    w: &[f64; 9],
    excess: f64,
) {
    let along: [f64; ROWS] = std::array::from_fn(|row| excess * h[3 * k + row % 3]);
    for l in 0..3 {
        let (of_h, of_w, column) = (h[3 * k + l], w[3 * k + l], &mut tangent[3 * k + l]);
        let across: [f64; ROWS] = std::array::from_fn(|row| h[3 * (row / 3) + l]);
        for row in 0..ROWS {
            let mixed = h[row] * of_w + w[row] * of_h;
            column[row] = column[row] * square + mixed - along[row] * across[row];
        }
    }
}

/// Components `3 i + J`.
#[inline(always)]
fn components(matrix: &Matrix3<f64>) -> [f64; 9] {
    std::array::from_fn(|at| matrix[(at / 3, at % 3)])
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
