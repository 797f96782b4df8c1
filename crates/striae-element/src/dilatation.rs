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
    actuation::Law,
    compact::Compact,
    deformation::{Deformation, by_components},
    fault::error_at,
    reference::{Matrices, Reference},
    response::Answer,
    tangent::Tangents,
};
use nalgebra::Matrix3;
use pulp::{Arch, Simd, WithSimd};
use striae_law::bulk::{Past, Present, Tangent};
use striae_mesh::Vec3;

impl<const N: usize, const Q: usize> Reference<N, Q> {
    /// As [`Reference::respond`], with mean dilatation.
    ///
    /// # Errors
    ///
    /// [`ElementError::Inverted`] where the element is turned inside out.
    pub(super) fn respond_with_mean_dilatation(
        &self,
        current: &[Vec3; N],
        law: &Law,
        past: Past,
        element: &mut ElementResponse,
        share: f64,
    ) -> Result<(), ElementError> {
        let at = self.deformation(current, share)?;
        match law.compact_response() {
            Some(law) => self.dilate_by::<Compact<Q>>(&at, share, element, |_, f, _| law(f)),
            None => self.dilate_by::<[Tangent; Q]>(&at, share, element, |g, f, present| {
                law.respond(f, past.of_point(g, Q), present)
            }),
        }
    }

    /// Adds the response where `law` gives the stress at a point.
    fn dilate_by<T: Tangents<Q>>(
        &self,
        deformation: &Deformation<Q>,
        share: f64,
        element: &mut ElementResponse,
        law: impl Fn(usize, &Matrix3<f64>, &mut Present) -> Answer<T::OfLaw>,
    ) -> Result<(), ElementError> {
        let mut tangents = T::unknown();
        let stresses = self.answers(&deformation.scaled, element, law, &mut tangents)?;
        Arch::new().dispatch(Completion {
            reference: self,
            deformation,
            stresses: &stresses,
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
        law: &Law,
        variables: &[f64],
        share: f64,
    ) -> Result<Vec<Matrix3<f64>>, ElementError> {
        let at = self.deformation(current, share)?;
        let theta = at.volume / self.volume();
        let each = variables.len() / Q;
        let mut stress = Vec::with_capacity(Q);
        // Jbar.
        let scaled = at.ratios.map(|j| theta * (j / theta).powf(1.0 - share));
        for (g, gradient) in at.scaled.iter().enumerate() {
            let variables = &variables[g * each..(g + 1) * each];
            let found = law.cauchy_stress_after(gradient, variables);
            stress.push(found.map_err(error_at(g))?);
        }
        let at_point = |g: usize| stress[g].trace() / 3.0 * (scaled[g] / theta);
        let sum: f64 = (0..Q)
            .map(|g| self.weights[g] * (share * at_point(g)))
            .sum();
        let pressure = sum / self.volume();
        for (g, sigma) in stress.iter_mut().enumerate() {
            let mean = Matrix3::identity() * (share * sigma.trace() / 3.0);
            let own = (*sigma - mean) * (scaled[g] / at.ratios[g]);
            *sigma = own + Matrix3::identity() * pressure;
        }
        Ok(stress)
    }
}

/// Makes of the tangents of the law those for the mean volume held,
/// `alpha^2 Abar + H x W + W x H - (p J - pi) H_iL H_kJ` with `W = (p J + m/9)/2 H - M/3`,
/// and writes force and stiffness, by as many lanes as the processor has.
struct Completion<'a, T, const N: usize, const Q: usize> {
    reference: &'a Reference<N, Q>,
    deformation: &'a Deformation<Q>,
    /// `Pbar`.
    stresses: &'a [Matrix3<f64>; Q],
    share: f64,
    tangents: &'a mut T,
    element: &'a mut ElementResponse,
}

/// Stresses and tangents of the law after the volume is replaced by its mean.
struct Held<const Q: usize> {
    /// `w P`, of which the forces are gathered.
    stresses: Matrices<Q>,
    /// `w J H / (theta V)`, of which the `b_a` are gathered.
    dilatations: Matrices<Q>,
    /// `w (M/3 - m/9 H)`, of which the `c_a` are gathered.
    changes: Matrices<Q>,
    /// `W`.
    mixed: Matrices<Q>,
    /// `p J - pi`.
    excess: [f64; Q],
    /// `sum_g w m/9 - p theta V`.
    curvature: f64,
}

impl<T: Tangents<Q>, const N: usize, const Q: usize> WithSimd for Completion<'_, T, N, Q> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let held = self.held();
        self.tangents
            .complete(self.deformation, &held.mixed, &held.excess);
        self.element
            .set_force(&self.reference.gathered(&held.stresses));
        let b = self.reference.gathered(&held.dilatations);
        // c x b + b x c + s b x b is d x b + b x d.
        let mut d = self.reference.gathered(&held.changes);
        for i in 0..3 {
            for a in 0..N {
                d[i][a] += 0.5 * held.curvature * b[i][a];
            }
        }
        self.tangents.stiffness(
            self.reference,
            |i, k| ([d[i], b[i]], [b[k], d[k]]),
            self.element.stiffness.blocks_mut(),
        );
    }
}

impl<T: Tangents<Q>, const N: usize, const Q: usize> Completion<'_, T, N, Q> {
    #[inline(always)]
    fn held(&self) -> Held<Q> {
        let (at, weights) = (self.deformation, &self.reference.weights);
        let (f, h) = (&at.gradients, &at.inverse_transposed);
        let mut p = by_components(self.stresses);
        let mut m = self.tangents.times_gradients(at);
        let (mut ninth, mut third) = ([0.0; Q], [0.0; Q]);
        for c in 0..9 {
            for g in 0..Q {
                m[c][g] = (p[c][g] + m[c][g]) * (at.scales[g] * self.share);
                ninth[g] += m[c][g] * f[c][g] * (self.share / 9.0);
                third[g] += p[c][g] * f[c][g] * (at.scales[g] * self.share / 3.0);
            }
        }
        let (mut pressure, mut curvature) = (0.0, 0.0);
        for g in 0..Q {
            pressure += weights[g] * third[g];
            curvature += weights[g] * ninth[g];
        }
        pressure /= at.volume;
        let (mut mixed, mut dilatations) = ([[0.0; Q]; 9], [[0.0; Q]; 9]);
        let mut excess = [0.0; Q];
        for g in 0..Q {
            excess[g] = pressure * at.ratios[g] - third[g];
        }
        for c in 0..9 {
            for g in 0..Q {
                let half = 0.5 * (pressure * at.ratios[g] + ninth[g]);
                mixed[c][g] = h[c][g] * half - m[c][g] / 3.0;
                m[c][g] = (m[c][g] / 3.0 - h[c][g] * ninth[g]) * weights[g];
                p[c][g] = (p[c][g] * at.scales[g] + h[c][g] * excess[g]) * weights[g];
                dilatations[c][g] = h[c][g] * (at.ratios[g] / at.volume) * weights[g];
            }
        }
        Held {
            stresses: p,
            dilatations,
            changes: m,
            mixed,
            excess,
            curvature: curvature - pressure * at.volume,
        }
    }
}
