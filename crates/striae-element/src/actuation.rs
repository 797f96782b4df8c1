//! Elements that move themselves: a stress-free strain and tensions of their own.
//!
//! At rest without stress the material at a point has the deformation gradient `G = I + S`, so
//! that its law sees `F_e = F G^-1` only. Along unit vectors `a` of the reference configuration
//! it pulls with forces `T` per reference area. The energy per reference volume is
//!
//! ```text
//! det(G) W(F_e) + sum T |F a|,      P = det(G) P_e G^-T + sum T (F a x a)/|F a|
//! ```
//!
//! (growth: Rodriguez, Hoger & McCulloch, J. Biomech. 27 (1994) 455,
//! doi:10.1016/0021-9290(94)90021-3). This is the element whose reference configuration is the
//! grown one, with gradients `G^-T G_a` and weights `w det(G)`; its points pull with `T/det(G)`
//! along `b = G a`. So every formulation and law is actuated in the way it is without. Directions
//! of fibres in a law, and what its points remember, are those of the grown configuration; mass and
//! densities are those of the reference configuration.
//!
//! The work of actuation is that of a change of `G` and `T` at given positions,
//!
//! ```text
//! sum_g w ( det(G) (W tr(L) - P_e : F_e L) + sum dT |F a| ),    L = dG G^-1
//! ```
//!
//! with `F_e` of the formulation: mean dilatation takes volume ratios to their mean by a factor
//! that does not depend on `G`, and enhanced parameters are those of least energy.

use super::{ElementError, reference::Reference};
use nalgebra::Matrix3;
use std::borrow::Cow;
use striae_law::bulk::{CompactResult, Material, Past, Present, Response, ResponseError};
use striae_mesh::Vec3;

/// Actuation of an element, the same at all of its points.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Actuation {
    /// `S = G - I`, symmetric, with principal values above -1.
    pub strain: Matrix3<f64>,
    /// Tensions along lines.
    pub tensions: Vec<Tension>,
}

/// An active tension of a material.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tension {
    /// Unit vector `a` in the reference configuration.
    pub along: Vec3,
    /// Force `T` per reference area.
    pub value: f64,
}

/// Material of an element, and its actuation.
#[derive(Clone, Debug)]
pub struct Driven<'a> {
    /// The material.
    pub material: &'a Material,
    /// Its actuation, if there is any.
    pub actuation: Option<Actuation>,
}

impl<'a> From<&'a Material> for Driven<'a> {
    fn from(material: &'a Material) -> Self {
        Self {
            material,
            actuation: None,
        }
    }
}

impl Driven<'_> {
    /// The law that points of the grown element answer by.
    pub(super) fn law(&self) -> Law<'_> {
        let actuation = self.actuation.iter();
        let pulls = actuation.flat_map(|actuation| {
            let growth = actuation.growth();
            let ratio = growth.determinant();
            let pull = move |tension: &Tension| Pull {
                along: growth * tension.along,
                tension: tension.value / ratio,
            };
            actuation.tensions.iter().map(pull)
        });
        Law {
            material: self.material,
            pulls: pulls.collect(),
        }
    }
}

impl Actuation {
    /// `G`.
    fn growth(&self) -> Matrix3<f64> {
        Matrix3::identity() + self.strain
    }

    /// `G^-1` and `det(G)`.
    ///
    /// # Errors
    ///
    /// [`ElementError::Shrunk`] where nothing is left of the volume.
    fn inverse(&self) -> Result<(Matrix3<f64>, f64), ElementError> {
        let growth = self.growth();
        let determinant = growth.determinant();
        let inverse = growth.try_inverse().filter(|_| determinant > 0.0);
        let inverse = inverse.ok_or(ElementError::Shrunk { determinant })?;
        Ok((inverse, determinant))
    }
}

impl<const N: usize, const Q: usize> Reference<N, Q> {
    /// The element in its grown configuration.
    ///
    /// # Errors
    ///
    /// [`ElementError::Shrunk`] where nothing is left of the volume.
    pub(super) fn driven(&self, driven: &Driven) -> Result<Cow<'_, Self>, ElementError> {
        let Some(actuation) = &driven.actuation else {
            return Ok(Cow::Borrowed(self));
        };
        if actuation.strain == Matrix3::zeros() {
            return Ok(Cow::Borrowed(self));
        }
        let (inverse, ratio) = actuation.inverse()?;
        let mut grown = self.clone();
        for [x, y, z] in &mut grown.gradients {
            for ((x, y), z) in x.iter_mut().zip(y).zip(z) {
                let gradient = inverse.tr_mul(&Vec3::new(*x, *y, *z));
                (*x, *y, *z) = (gradient.x, gradient.y, gradient.z);
            }
        }
        grown.weights.iter_mut().for_each(|weight| *weight *= ratio);
        Ok(Cow::Owned(grown))
    }

    /// Work of a change of actuation at the `F_e` of the points of the grown element, which is
    /// this one.
    pub(super) fn work(
        &self,
        elastic: &[Matrix3<f64>; Q],
        driven: &Driven,
        variables: &[f64],
        change: &Actuation,
    ) -> Result<f64, ElementError> {
        let elapsed = 0.0;
        let past = Past { variables, elapsed };
        let none = Actuation::default();
        let actuation = driven.actuation.as_ref().unwrap_or(&none);
        let (growth, (inverse, ratio)) = (actuation.growth(), actuation.inverse()?);
        let rate = change.strain * inverse;
        let mut room = vec![0.0; variables.len() / Q];
        let mut work = 0.0;
        for (g, f) in elastic.iter().enumerate() {
            let mut present = Present {
                variables: &mut room,
                dissipated: 0.0,
            };
            let response = driven
                .material
                .respond(f, past.of_point(g, Q), &mut present);
            let response = response.map_err(super::fault::error_at(g))?;
            let stored = response.energy * rate.trace();
            let done = response.first_piola.dot(&(f * rate));
            let pulled = change.tensions.iter().map(|tension| {
                let length = (f * (growth * tension.along)).norm();
                tension.value * length / ratio
            });
            work += self.weights[g] * (stored - done + pulled.sum::<f64>());
        }
        Ok(work)
    }
}

/// A material that pulls.
pub(super) struct Law<'a> {
    pub(super) material: &'a Material,
    pulls: Vec<Pull>,
}

/// A tension per area of the grown configuration, with the energy `t |F b|` per volume.
struct Pull {
    /// `b`, of any length.
    along: Vec3,
    /// `t`.
    tension: f64,
}

impl Law<'_> {
    /// As [`Material::compact_response`], of a material that does not pull.
    pub(super) fn compact_response(
        &self,
    ) -> Option<impl Fn(&Matrix3<f64>) -> CompactResult + use<>> {
        let plain = self.pulls.is_empty().then_some(self.material);
        plain.and_then(Material::compact_response)
    }

    /// As [`Material::respond`].
    pub(super) fn respond(
        &self,
        f: &Matrix3<f64>,
        past: Past,
        present: &mut Present,
    ) -> Result<Response, ResponseError> {
        let mut response = self.material.respond(f, past, present)?;
        for pull in &self.pulls {
            pull.add_to(f, &mut response);
        }
        Ok(response)
    }

    /// As [`Material::cauchy_stress_after`].
    pub(super) fn cauchy_stress_after(
        &self,
        f: &Matrix3<f64>,
        variables: &[f64],
    ) -> Result<Matrix3<f64>, ResponseError> {
        let stress = self.material.cauchy_stress_after(f, variables)?;
        let ratio = f.determinant();
        let pulls = self.pulls.iter().map(|pull| pull.cauchy_stress(f, ratio));
        Ok(pulls.fold(stress, |sum, pull| sum + pull))
    }
}

impl Pull {
    /// Adds `t |F b|`, `t n x b` and `t/|F b| (I - n x n)_ik b_J b_L` with `n = F b/|F b|`.
    fn add_to(&self, f: &Matrix3<f64>, response: &mut Response) {
        let (b, t) = (&self.along, self.tension);
        let pulled = f * b;
        let length = pulled.norm();
        if length == 0.0 {
            return;
        }
        let n = pulled / length;
        response.energy += t * length;
        response.first_piola += n * b.transpose() * t;
        for (column, entries) in response.tangent.data.0.iter_mut().enumerate() {
            let (k, l) = (column / 3, column % 3);
            for (row, entry) in entries.iter_mut().enumerate() {
                let (i, j) = (row / 3, row % 3);
                let across = f64::from(u8::from(i == k)) - n[i] * n[k];
                *entry += t / length * across * (b[j] * b[l]);
            }
        }
    }

    /// `t/J (F b x F b)/|F b|`.
    fn cauchy_stress(&self, f: &Matrix3<f64>, ratio: f64) -> Matrix3<f64> {
        let pulled = f * self.along;
        let length = pulled.norm();
        if length == 0.0 {
            return Matrix3::zeros();
        }
        pulled * pulled.transpose() * (self.tension / (ratio * length))
    }
}
