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
    ElementError, ElementResponse, Stiffness, reference::Reference, response::error_at,
    stiffness::COMPONENTS,
};
use nalgebra::{Matrix3, SVector};
use striae_law::bulk::{Material, Past, Response, Tangent};
use striae_mesh::Vec3;

/// A matrix by components `3 i + J`.
type Vector9 = SVector<f64, 9>;

/// Deformation at a quadrature point.
struct Point {
    /// `F`.
    gradient: Matrix3<f64>,
    /// `F^-T`.
    inverse_transposed: Matrix3<f64>,
    /// `J`.
    ratio: f64,
}

/// Pressure and volume of an element, and how they change.
struct Whole<const N: usize> {
    /// `p`.
    pressure: f64,
    /// `b_a`.
    volume_slopes: [[f64; 3]; N],
    /// `c_a`.
    pressure_slopes: [[f64; 3]; N],
    /// `sum_g w m/9 - p theta V`.
    curvature: f64,
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
        let (laws, scales) = self.laws(&points, volume, material, past, element, share)?;
        let pressure = self.mean(|g| laws[g].1) / volume;
        element.energy = (0..Q).map(|g| self.weights[g] * laws[g].0.energy).sum();
        let mut whole = Whole {
            pressure,
            volume_slopes: [[0.0; 3]; N],
            pressure_slopes: [[0.0; 3]; N],
            curvature: -pressure * volume,
        };
        let mut force = [[0.0; 3]; N];
        let mut tangents = [Tangent::zeros(); Q];
        for g in 0..Q {
            let (point, (law, third)) = (&points[g], &laws[g]);
            let (h, excess) = (&point.inverse_transposed, pressure * point.ratio - third);
            self.add_force(g, &(law.first_piola * scales[g] + h * excess), &mut force);
            tangents[g] =
                self.local_tangent(g, point, law, scales[g], *third, share, volume, &mut whole);
        }
        element.force.copy_from_slice(&force);
        self.sum(&tangents, &mut element.stiffness);
        add_products(&whole, &mut element.stiffness);
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
    fn points(&self, current: &[Vec3; N]) -> Result<(Vec<Point>, f64), ElementError> {
        let mut points = Vec::with_capacity(Q);
        for g in 0..Q {
            let gradient = self.deformation_gradient(g, current);
            let ratio = gradient.determinant();
            let inverse = gradient.try_inverse().filter(|_| ratio > 0.0);
            let inverse = inverse.ok_or(ElementError::Inverted {
                point: g,
                determinant: ratio,
            })?;
            points.push(Point {
                gradient,
                inverse_transposed: inverse.transpose(),
                ratio,
            });
        }
        let volume = self.mean(|g| points[g].ratio);
        Ok((points, volume))
    }

    /// The law at `Fbar` with `pi`, and `alpha`, at all points; writes down what they come to.
    #[allow(clippy::type_complexity, clippy::too_many_arguments)]
    fn laws(
        &self,
        points: &[Point],
        volume: f64,
        material: &Material,
        past: Past,
        element: &mut ElementResponse,
        share: f64,
    ) -> Result<(Vec<(Response, f64)>, [f64; Q]), ElementError> {
        let theta = volume / self.volume();
        let scales: [f64; Q] = std::array::from_fn(|g| scale(theta, &points[g], share));
        let mut laws = Vec::with_capacity(Q);
        element.dissipated = 0.0;
        for (g, point) in points.iter().enumerate() {
            let scaled = point.gradient * scales[g];
            let mut present = element.present(g, Q);
            let law = material.respond(&scaled, past.of_point(g, Q), &mut present);
            let dissipated = present.dissipated;
            let law = law.map_err(error_at(g))?;
            element.dissipated += self.weights[g] * dissipated;
            laws.push((law, law.first_piola.dot(&scaled) * share / 3.0));
        }
        Ok((laws, scales))
    }

    /// The tangent at a point for the mean volume held; adds what the point gives to the rest.
    #[allow(clippy::too_many_arguments)]
    fn local_tangent(
        &self,
        g: usize,
        point: &Point,
        law: &Response,
        scale: f64,
        third: f64,
        share: f64,
        volume: f64,
        whole: &mut Whole<N>,
    ) -> Tangent {
        let (f, h) = (vector(&point.gradient), vector(&point.inverse_transposed));
        let m = (vector(&law.first_piola) + law.tangent * f * scale) * (scale * share);
        let ninth = m.dot(&f) * share / 9.0;
        let excess = whole.pressure * point.ratio - third;
        let weight = self.weights[g];
        whole.curvature += weight * ninth;
        let volume_slope = point.inverse_transposed * (point.ratio / volume);
        self.add_force(g, &volume_slope, &mut whole.volume_slopes);
        self.add_force(
            g,
            &matrix(&(m / 3.0 - h * ninth)),
            &mut whole.pressure_slopes,
        );
        let (square, normal) = (scale * scale, whole.pressure * point.ratio + ninth);
        Tangent::from_fn(|row, column| {
            let ((i, j), (k, l)) = ((row / 3, row % 3), (column / 3, column % 3));
            let mixed = m[row] * h[column] + m[column] * h[row];
            law.tangent[(row, column)] * square - mixed / 3.0 + h[row] * h[column] * normal
                - excess * h[3 * i + l] * h[3 * k + j]
        })
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

/// Adds `c x b + b x c + s b x b`.
fn add_products<const N: usize>(whole: &Whole<N>, stiffness: &mut Stiffness) {
    let (b, c) = (&whole.volume_slopes, &whole.pressure_slopes);
    for ((i, k), block) in COMPONENTS.into_iter().zip(stiffness.blocks_mut::<N>()) {
        for row in 0..N {
            for column in 0..N {
                let mixed = c[row][i] * b[column][k] + b[row][i] * c[column][k];
                let square = whole.curvature * (b[row][i] * b[column][k]);
                block[row][column] += mixed + square;
            }
        }
    }
}

fn vector(matrix: &Matrix3<f64>) -> Vector9 {
    Vector9::from_fn(|at, _| matrix[(at / 3, at % 3)])
}

fn matrix(vector: &Vector9) -> Matrix3<f64> {
    Matrix3::from_fn(|i, j| vector[3 * i + j])
}
