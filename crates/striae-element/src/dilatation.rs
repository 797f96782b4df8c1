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
    ElementError, ElementResponse, Stiffness,
    reference::{Gradients, Reference},
    response::error_at,
    stiffness::COMPONENTS,
};
use nalgebra::Matrix3;
use pulp::{Arch, Simd, WithSimd};
use striae_law::bulk::{Material, Past, Tangent};
use striae_mesh::Vec3;

/// Deformation at a quadrature point.
#[derive(Clone, Copy, Default)]
struct Point {
    /// `F`.
    gradient: Matrix3<f64>,
    /// `F^-T`.
    inverse_transposed: Matrix3<f64>,
    /// `J`.
    ratio: f64,
}

/// The law at `Fbar` at a quadrature point, but for the tangent.
#[derive(Clone, Copy, Default)]
struct Law {
    /// `alpha`.
    scale: f64,
    /// `Pbar`.
    first_piola: Matrix3<f64>,
    /// `pi`.
    third: f64,
}

/// What the points of an element come to, by component and corner.
struct Sums<const N: usize> {
    /// `f_a`.
    force: [[f64; N]; 3],
    /// `b_a`.
    volume_slopes: [[f64; N]; 3],
    /// `c_a + s/2 b_a` with `s = sum_g w m/9 - p theta V`.
    pressure_slopes: [[f64; N]; 3],
}

impl<const N: usize> Default for Sums<N> {
    fn default() -> Self {
        Self {
            force: [[0.0; N]; 3],
            volume_slopes: [[0.0; N]; 3],
            pressure_slopes: [[0.0; N]; 3],
        }
    }
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
        let (points, volume) = self.points(current)?;
        let mut tangents = [Tangent::zeros(); Q];
        let laws = self.laws(
            &points,
            volume,
            material,
            past,
            element,
            &mut tangents,
            share,
        )?;
        let pressure = self.mean(|g| laws[g].third) / volume;
        let mut sums = Sums::default();
        Arch::new().dispatch(Completion {
            element: self,
            points: &points,
            laws: &laws,
            pressure,
            volume,
            share,
            tangents: &mut tangents,
            sums: &mut sums,
        });
        for (a, force) in element.force.iter_mut().enumerate() {
            *force = [0, 1, 2].map(|i| sums.force[i][a]);
        }
        self.sum(&tangents, &mut element.stiffness);
        Arch::new().dispatch(Products {
            sums: &sums,
            stiffness: &mut element.stiffness,
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
        let (points, volume) = self.points(current)?;
        let theta = volume / self.volume();
        let each = variables.len() / Q;
        let mut stress = Vec::with_capacity(Q);
        let ratio = |point: &Point| theta * (point.ratio / theta).powf(1.0 - share);
        for (g, point) in points.iter().enumerate() {
            let scaled = point.gradient * scale(theta, point, share);
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
    fn points(&self, current: &[Vec3; N]) -> Result<([Point; Q], f64), ElementError> {
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
            *point = Point {
                gradient,
                inverse_transposed: cofactors / determinant,
                ratio: determinant,
            };
        }
        let volume = self.mean(|g| points[g].ratio);
        Ok((points, volume))
    }

    /// The law at `Fbar` at all points, its tangents apart; writes down energies and what the
    /// points come to.
    #[allow(clippy::too_many_arguments)]
    fn laws(
        &self,
        points: &[Point; Q],
        volume: f64,
        material: &Material,
        past: Past,
        element: &mut ElementResponse,
        tangents: &mut [Tangent; Q],
        share: f64,
    ) -> Result<[Law; Q], ElementError> {
        let theta = volume / self.volume();
        let mut laws = [Law::default(); Q];
        (element.energy, element.dissipated) = (0.0, 0.0);
        for (g, point) in points.iter().enumerate() {
            let scale = scale(theta, point, share);
            let scaled = point.gradient * scale;
            let mut present = element.present(g, Q);
            let law = material.respond(&scaled, past.of_point(g, Q), &mut present);
            let dissipated = present.dissipated;
            let law = law.map_err(error_at(g))?;
            element.energy += self.weights[g] * law.energy;
            element.dissipated += self.weights[g] * dissipated;
            tangents[g] = law.tangent;
            laws[g] = Law {
                scale,
                first_piola: law.first_piola,
                third: law.first_piola.dot(&scaled) * share / 3.0,
            };
        }
        Ok(laws)
    }

    /// `sum_g w value`.
    fn mean(&self, value: impl Fn(usize) -> f64) -> f64 {
        (0..Q).map(|g| self.weights[g] * value(g)).sum()
    }
}

/// `alpha` for the part `beta` of the way to the mean.
fn scale(theta: f64, point: &Point, share: f64) -> f64 {
    let whole = (theta / point.ratio).cbrt();
    if share == 1.0 {
        whole
    } else {
        whole.powf(share)
    }
}

/// Makes of the tangents of the law those for the mean volume held,
/// `alpha^2 Abar + H x W + W x H - (p J - pi) H_iL H_kJ` with `W = (p J + m/9)/2 H - M/3`,
/// and sums what the points come to, by as many lanes as the processor has.
struct Completion<'a, const N: usize, const Q: usize> {
    element: &'a Reference<N, Q>,
    points: &'a [Point; Q],
    laws: &'a [Law; Q],
    pressure: f64,
    volume: f64,
    share: f64,
    tangents: &'a mut [Tangent; Q],
    sums: &'a mut Sums<N>,
}

impl<const N: usize, const Q: usize> WithSimd for Completion<'_, N, Q> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let mut curvature = -self.pressure * self.volume;
        for g in 0..Q {
            let (point, law) = (&self.points[g], &self.laws[g]);
            let tangent = &mut self.tangents[g].data.0;
            let weight = self.element.weights[g];
            let (f, h) = (
                components(&point.gradient),
                components(&point.inverse_transposed),
            );
            let stress = components(&law.first_piola);
            let m = turned(tangent, &f).map(|of_f| of_f * law.scale);
            let m: [f64; 9] =
                std::array::from_fn(|at| (stress[at] + m[at]) * (law.scale * self.share));
            let ninth = (0..9).map(|at| m[at] * f[at]).sum::<f64>() * self.share / 9.0;
            let normal = self.pressure * point.ratio;
            let excess = normal - law.third;
            curvature += weight * ninth;
            let gradients = &self.element.gradients[g];
            let ratio = point.ratio / self.volume;
            let first_piola =
                std::array::from_fn(|at| (stress[at] * law.scale + h[at] * excess) * weight);
            let volume_slope = std::array::from_fn(|at| h[at] * ratio * weight);
            let pressure_slope = std::array::from_fn(|at| (m[at] / 3.0 - h[at] * ninth) * weight);
            add(&mut self.sums.force, &first_piola, gradients);
            add(&mut self.sums.volume_slopes, &volume_slope, gradients);
            add(&mut self.sums.pressure_slopes, &pressure_slope, gradients);
            let half = 0.5 * (normal + ninth);
            let w = std::array::from_fn(|at| h[at] * half - m[at] / 3.0);
            complete(tangent, law.scale * law.scale, &h, &w, excess);
        }
        let (slopes, volume) = (&mut self.sums.pressure_slopes, &self.sums.volume_slopes);
        for i in 0..3 {
            for a in 0..N {
                slopes[i][a] += 0.5 * curvature * volume[i][a];
            }
        }
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

/// Adds `w P_iJ G_a,J`.
#[inline(always)]
fn add<const N: usize>(to: &mut [[f64; N]; 3], of: &[f64; 9], [x, y, z]: &Gradients<N>) {
    for (i, to) in to.iter_mut().enumerate() {
        for a in 0..N {
            to[a] += of[3 * i] * x[a] + of[3 * i + 1] * y[a] + of[3 * i + 2] * z[a];
        }
    }
}

/// The tangent for the mean volume held, by columns; of its blocks only those with `i <= k`,
/// as the stiffness needs no others.
#[inline(always)]
fn complete(tangent: &mut [[f64; 9]; 9], square: f64, h: &[f64; 9], w: &[f64; 9], excess: f64) {
    for (i, k) in COMPONENTS {
        let along: [f64; 3] = std::array::from_fn(|j| excess * h[3 * k + j]);
        for l in 0..3 {
            let (of_h, of_w, across) = (h[3 * k + l], w[3 * k + l], h[3 * i + l]);
            for j in 0..3 {
                let (row, entry) = (3 * i + j, &mut tangent[3 * k + l][3 * i + j]);
                let mixed = h[row] * of_w + w[row] * of_h;
                *entry = *entry * square + mixed - along[j] * across;
            }
        }
    }
}

/// Adds `c x b + b x c + s b x b` to the stiffness, as `d x b + b x d` with `d = c + s/2 b`.
struct Products<'a, const N: usize> {
    sums: &'a Sums<N>,
    stiffness: &'a mut Stiffness,
}

impl<const N: usize> WithSimd for Products<'_, N> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let (b, d) = (&self.sums.volume_slopes, &self.sums.pressure_slopes);
        for ((i, k), block) in COMPONENTS.into_iter().zip(self.stiffness.blocks_mut::<N>()) {
            for (row, entries) in block.iter_mut().enumerate() {
                let (of_d, of_b) = (d[i][row], b[i][row]);
                for column in 0..N {
                    entries[column] += of_d * b[k][column] + of_b * d[k][column];
                }
            }
        }
    }
}

/// Components `3 i + J`.
#[inline(always)]
fn components(matrix: &Matrix3<f64>) -> [f64; 9] {
    std::array::from_fn(|at| matrix[(at / 3, at % 3)])
}
