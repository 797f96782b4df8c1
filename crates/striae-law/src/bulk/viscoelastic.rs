//! Finite viscoelasticity over any law of rubber.
//!
//! Branches of a spring and a dashpot in series stand beside the law `W_iso + U` of slow
//! deformations. Branch `r` has the energy `g_r W_iso` of its elastic part and the relaxation
//! time `t_r`; the change of volume is elastic:
//!
//! ```text
//! F = F_e F_v in each branch,   b = J^-2/3 F C_v^-1 F^T = sum_a exp(2 e_a) n_a n_a
//! W = W_iso(F) + U(J) + sum_r g_r w(e^r) ,   tau_a = g_r dw/de_a
//! de_v/dt = tau / (2 g_r G t_r) ,   D = tau . de_v/dt >= 0
//! ```
//!
//! so that small strains have the modulus `G(t) = G (1 + sum_r g_r exp(-t/t_r))`, Prony's
//! series. In an increment the branch is strained at once and then flows at the
//! strains `e` that this gives, by the minimum of an incremental potential,
//!
//! ```text
//! min over y of  g w(y) + g G k |e - y|^2 ,   k = 1/(exp(dt/t) - 1)
//! ```
//!
//! with the elastic strains `y` at the end. For `w = G |y|^2` that is `y = exp(-dt/t) e`:
//! relaxation at rest is exact for increments of any size, the rest is of first order in
//! them. The potential makes the tangent symmetric; `g (w(e) - w(y))` is dissipated, never
//! less than nothing, as `y` is the minimum.
//!
//! Sources: the multiplicative split and the logarithmic flow of Reese & Govindjee, Int. J.
//! Solids Struct. 35 (1998) 3455-3482, doi:10.1016/S0020-7683(97)00217-5; the potential of
//! Fancello, Ponthot & Stainier, Int. J. Numer. Methods Eng. 65 (2006) 1831-1864.
//! The ratios are those of Holzapfel, "Nonlinear Solid Mechanics"
//! (2000), section 6.10. Why not the convolution of that book: `docs/decisions/viscoelasticity.md`.

use super::rubber::RELAXATION;
use super::spectrum::{FLOW, Spectrum};
use super::{Hyperelastic, LameConstants, Law, Material, Past, Present, Response, ResponseError};
use nalgebra::{Matrix3, Vector3};
use serde::Serialize;
use striae_declared::Values;

impl Branch {
    /// Branches that the value of [`RELAXATION`] states, if there are any.
    pub(super) fn stated(values: &Values) -> Option<Vec<Self>> {
        let branch = |values: &Values| Self {
            ratio: values.number("ratio"),
            time: values.number("time"),
        };
        let all = values.tables_if_any(RELAXATION.name)?;
        Some(all.iter().map(branch).collect())
    }
}

impl Material {
    /// Rubber that relaxes.
    pub fn viscoelastic(law: Viscoelastic) -> Self {
        let branch = |of: &Branch| Values::from([("ratio", of.ratio), ("time", of.time)]);
        let branches: Vec<Values> = law.branches.iter().map(branch).collect();
        let statement = law.slow.statement().map(|mut slow| {
            slow.values = slow.values.with(RELAXATION.name, branches);
            slow
        });
        Self::new(Law::Viscoelastic(law), statement)
    }
}

/// A spring and a dashpot in series.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Branch {
    /// Modulus over that of the law of slow deformations.
    pub ratio: f64,
    /// Relaxation time.
    pub time: f64,
}

/// Rubber with branches that relax.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Viscoelastic {
    slow: Hyperelastic,
    branches: Box<[Branch]>,
}

/// Branches that cannot be.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum InadmissibleBranch {
    /// There is none.
    #[error("there is no branch, but at least one is needed")]
    None,
    /// A ratio or a time is not positive.
    #[error("`{name}` of branch {branch} is {value}, but it must be positive and finite")]
    NotPositive {
        /// Number of the branch, from 0.
        branch: usize,
        /// Name of the constant.
        name: &'static str,
        /// Its value.
        value: f64,
    },
}

/// Iterations for the strains of a branch.
const ITERATIONS: usize = 60;
/// Residual over the shear modulus that is zero.
const ZERO: f64 = 1e-15;

impl Viscoelastic {
    /// Branches over the law of slow deformations.
    ///
    /// # Errors
    ///
    /// When there is no branch, or a ratio or time is not positive.
    pub fn new(slow: Hyperelastic, branches: &[Branch]) -> Result<Self, InadmissibleBranch> {
        if branches.is_empty() {
            return Err(InadmissibleBranch::None);
        }
        for (at, branch) in branches.iter().enumerate() {
            for (name, value) in [("ratio", branch.ratio), ("time", branch.time)] {
                if !(value > 0.0 && value.is_finite()) {
                    let branch = at;
                    return Err(InadmissibleBranch::NotPositive {
                        branch,
                        name,
                        value,
                    });
                }
            }
        }
        Ok(Self {
            slow,
            branches: branches.into(),
        })
    }

    /// The law of slow deformations.
    pub fn slow(&self) -> &Hyperelastic {
        &self.slow
    }

    /// The branches.
    pub fn branches(&self) -> &[Branch] {
        &self.branches
    }

    /// The Lame constants of slow small strains.
    pub fn lame_constants(&self) -> LameConstants {
        self.slow.lame_constants()
    }

    pub(super) fn variables(&self) -> usize {
        FLOW * self.branches.len()
    }

    pub(super) fn respond(
        &self,
        f: &Matrix3<f64>,
        past: Past,
        present: &mut Present,
    ) -> Result<Response, ResponseError> {
        let mut response = self.slow.response(f)?;
        // Isochoric flow is kept, and the strains of the shape follow by their deviator.
        let olds = past.variables.chunks_exact(FLOW);
        let news = present.variables.chunks_exact_mut(FLOW);
        present.dissipated = 0.0;
        for ((branch, old), new) in self.branches.iter().zip(olds).zip(news) {
            let spectrum = Spectrum::new(f, old)?;
            let strains = spectrum.strains;
            let mean = strains.mean();
            let relaxed = self.relaxed(branch, past.elapsed, strains.add_scalar(-mean))?;
            spectrum.add(&relaxed.stresses, &relaxed.slopes, &mut response);
            spectrum.flow(&relaxed.strains.add_scalar(mean), new);
            response.energy += relaxed.energy;
            present.dissipated += relaxed.dissipated;
        }
        // The eigenvectors leave it symmetric to round-off only.
        response.tangent = (response.tangent + response.tangent.transpose()) * 0.5;
        Ok(response)
    }

    /// A branch that is strained by `e` and relaxes for some time.
    fn relaxed(
        &self,
        branch: &Branch,
        elapsed: f64,
        e: Vector3<f64>,
    ) -> Result<Relaxed, ResponseError> {
        let law = self.slow.isochoric();
        let ratio = branch.ratio;
        // `(1 - a) w' + 2 G a (y - e) = 0` is the minimum times a factor finite for all steps.
        let left = (-elapsed / branch.time).exp();
        let (gone, spring) = (1.0 - left, 2.0 * law.shear() * left);
        let (full, ..) = law.principal(&e)?;
        let mean = Matrix3::repeat(2.0 * law.shear() / 3.0);
        let matrix =
            |curvature: &Matrix3<f64>| curvature * gone + Matrix3::identity() * spring + mean;
        let potential =
            |y: &Vector3<f64>, energy: f64| gone * energy + 0.5 * spring * (y - e).norm_squared();
        let mut y = e * left;
        let (mut energy, mut slope, mut curvature) = law.principal(&y)?;
        for _ in 0..ITERATIONS {
            let residual = slope * gone + (y - e) * spring;
            if residual.norm() <= ZERO * law.shear() {
                break;
            }
            let Some(inverse) = matrix(&curvature).try_inverse() else {
                break;
            };
            let change = -inverse * residual;
            let before = potential(&y, energy);
            let Some((next, found)) = shortened(&y, &change, |y| {
                let found = law.principal(y).ok()?;
                let slack = 16.0 * f64::EPSILON * (before.abs() + law.shear());
                (potential(y, found.0) <= before + slack).then_some(found)
            }) else {
                break;
            };
            let rests = (next - y).norm() <= 4.0 * f64::EPSILON * y.norm();
            y = next;
            (energy, slope, curvature) = found;
            if rests {
                break;
            }
        }
        let inverse = matrix(&curvature).try_inverse();
        let inverse = inverse.unwrap_or_else(Matrix3::zeros);
        let slopes = curvature * inverse * (ratio * spring);
        Ok(Relaxed {
            strains: y,
            stresses: slope * ratio,
            slopes: (slopes + slopes.transpose()) * 0.5,
            energy: ratio * energy,
            dissipated: ratio * (full - energy).max(0.0),
        })
    }
}

/// A branch at the end of an increment.
struct Relaxed {
    /// Elastic strains.
    strains: Vector3<f64>,
    stresses: Vector3<f64>,
    /// Derivatives of the stresses by the strains before the flow.
    slopes: Matrix3<f64>,
    energy: f64,
    dissipated: f64,
}

/// The first of `y + change`, `y + change/2`, ... that is good, with what it gives.
fn shortened<T>(
    y: &Vector3<f64>,
    change: &Vector3<f64>,
    good: impl Fn(&Vector3<f64>) -> Option<T>,
) -> Option<(Vector3<f64>, T)> {
    (0..30).find_map(|halves| {
        let next = y + change * 0.5f64.powi(halves);
        good(&next).map(|found| (next, found))
    })
}
