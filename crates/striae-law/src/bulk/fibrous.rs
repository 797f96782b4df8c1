//! Families of fibres in a neo-Hookean solid or in rubber.
//!
//! A family has the unit direction `a` at rest. With the ground's energy `W_0`, the invariant
//! `I4 = a . C a`, `J = det F`, `I1 = tr C`, and sums over the families,
//!
//! ```text
//! W = W_0(F) + sum psi(E)
//!
//! exponential  psi = k1/(2 k2) (exp(k2 <E>^2) - 1) ,   E = J^-2/3 (k I1 + (1 - 3 k) I4) - 1
//! linear       psi = M/8 E^2 ,                         E = I4 - 1
//! ```
//!
//! *Exponential* fibres stiffen as they are stretched and bear no compression, `<E>` being `E`
//! where it is positive, else 0: the law of Holzapfel, Gasser and Ogden, with the dispersion
//! `k` from 0, all fibres along `a`, to 1/3, fibres in all directions. *Linear* fibres bear tension
//! and compression; at rest the family adds the modulus `M` along `a`. One family in a
//! neo-Hookean solid is transversely isotropic (the standard reinforcing model).
//!
//! With `M = k I + (1 - 3 k) a a`, `theta = tr(F M F^T)`, `H = F^-T`, and `s = J^-2/3`, `q = 2/3`
//! of exponential fibres, `s = 1`, `q = 0` of linear ones,
//!
//! ```text
//! D = dE/dF = s (2 F M - q theta H)
//! d2E/dF_iJ dF_kL = s (2 d_ik M_JL - 2 q (FM_iJ H_kL + H_iJ FM_kL)
//!                      + q^2 theta H_iJ H_kL + q theta H_iL H_kJ)
//! P = psi' D ,   A = psi'' D D + psi' d2E/dFdF
//! ```
//!
//! Directions are stated as a field in space and taken in the middle of each element. They
//! stand among the variables of its points, three for each family, and never change.
//!
//! Sources: Gasser, Ogden & Holzapfel, J. R. Soc. Interface 3 (2006) 15-35,
//! doi:10.1098/rsif.2005.0073; Qiu & Pence, J. Elasticity 49 (1997) 1-30,
//! doi:10.1023/A:1007410321319.

use super::invariants::inverse;
use super::{
    Direction, LameConstants, Law, Material, Past, Present, Response, ResponseError, Tangent,
};
use nalgebra::{Matrix3, Vector3};
use serde::Serialize;

/// Stiffness of a family of fibres.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub enum FibreStiffness {
    /// Stiffer the more they are stretched, slack in compression.
    Exponential {
        /// `k1`, a stress.
        k1: f64,
        /// `k2`, without unit; 0 for a quadratic energy.
        k2: f64,
        /// Dispersion `k`, from 0 to 1/3.
        dispersion: f64,
    },
    /// In tension and compression, with the modulus `M` at rest.
    Linear {
        /// `M`, a stress.
        modulus: f64,
    },
}

/// A family of fibres.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Fibres {
    /// Stiffness of the fibres.
    pub stiffness: FibreStiffness,
    /// Direction of the fibres at rest.
    pub direction: Direction,
}

/// A solid with families of fibres.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Fibrous {
    ground: Box<Material>,
    families: Box<[Fibres]>,
}

/// Fibres that cannot be.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum InadmissibleFibres {
    /// There is none.
    #[error("there is no family of fibres, but at least one is needed")]
    None,
    /// The ground is of another law.
    #[error(
        "fibres need a neo-Hookean solid or rubber without relaxation around them, not a solid that is {0}"
    )]
    Ground(String),
    /// A constant out of its range.
    #[error("`{name}` of family {family} is {value}, but it must be {expected}")]
    Constant {
        /// Number of the family, from 0.
        family: usize,
        /// Name of the constant.
        name: &'static str,
        /// Its value.
        value: f64,
        /// Requirement on the value.
        expected: &'static str,
    },
    /// A direction of no length.
    #[error("the direction of family {0} is the zero vector or not finite")]
    Direction(usize),
}

/// Strain up to which exponential fibres are slack: the round-off of one at rest. Fibres at
/// rest would else be slack or not by chance, each point of an element on its own, and the
/// first iteration of an increment from there would go astray where volumes can hardly change.
const SLACK: f64 = 1e-13;
/// `k2 E^2` up to which the exponential function is evaluated.
const LARGEST_EXPONENT: f64 = 200.0;

impl Material {
    /// Families of fibres in a solid, which keeps the statement of its law.
    pub fn fibrous(law: Fibrous) -> Self {
        Self::new(Law::Fibrous(law), None)
    }
}

impl Fibrous {
    /// Families of fibres in a ground.
    ///
    /// # Errors
    ///
    /// When the ground is neither neo-Hookean nor rubber that does not relax, or a constant or
    /// direction is not admissible.
    pub fn new(ground: Material, families: &[Fibres]) -> Result<Self, InadmissibleFibres> {
        if !matches!(ground.law(), Law::NeoHookean { .. } | Law::Hyperelastic(_)) {
            return Err(InadmissibleFibres::Ground(ground.name().to_owned()));
        }
        if families.is_empty() {
            return Err(InadmissibleFibres::None);
        }
        for (at, family) in families.iter().enumerate() {
            family.stiffness.check(at)?;
            if !family.direction.has_length() {
                return Err(InadmissibleFibres::Direction(at));
            }
        }
        Ok(Self {
            ground: Box::new(ground),
            families: families.into(),
        })
    }

    /// Matrix material around the fibres.
    pub fn ground(&self) -> &Material {
        &self.ground
    }

    /// The families.
    pub fn families(&self) -> &[Fibres] {
        &self.families
    }

    /// The Lame constants of the ground at rest.
    pub fn lame_constants(&self) -> LameConstants {
        self.ground.lame_constants()
    }

    pub(super) fn variables(&self) -> usize {
        3 * self.families.len()
    }

    /// Directions at a place of the body at rest, one family after the other.
    pub(super) fn rest(&self, place: &Vector3<f64>) -> Vec<f64> {
        let directions = self.families.iter();
        directions
            .flat_map(|family| <[f64; 3]>::from(family.direction.at(place)))
            .collect()
    }

    /// The response; what the point remembers are the directions.
    pub(super) fn respond(
        &self,
        f: &Matrix3<f64>,
        past: Past,
        present: &mut Present,
    ) -> Result<Response, ResponseError> {
        present.variables.copy_from_slice(past.variables);
        let mut response = self.ground.response(f)?;
        let (ratio, h) = inverse(f)?;
        let directions = past.variables.chunks_exact(3);
        for (family, direction) in self.families.iter().zip(directions) {
            let direction = Vector3::from_column_slice(direction);
            let strain = Strain::new(family.stiffness, &direction, f, ratio, &h);
            let [energy, slope, curvature] = family.stiffness.energy(strain.value)?;
            response.energy += energy;
            if slope != 0.0 || curvature != 0.0 {
                response.first_piola += strain.slope * slope;
                strain.add_tangent(slope, curvature, &mut response.tangent);
            }
        }
        Ok(response)
    }
}

impl FibreStiffness {
    fn check(&self, family: usize) -> Result<(), InadmissibleFibres> {
        let within = |name, value: f64, holds: bool, expected| {
            let fault = InadmissibleFibres::Constant {
                family,
                name,
                value,
                expected,
            };
            (holds && value.is_finite()).then_some(()).ok_or(fault)
        };
        match *self {
            Self::Exponential { k1, k2, dispersion } => {
                within("k1", k1, k1 > 0.0, "positive")?;
                within("k2", k2, k2 >= 0.0, "at least 0")?;
                let fits = (0.0..=1.0 / 3.0).contains(&dispersion);
                within("dispersion", dispersion, fits, "from 0 to 1/3")
            }
            Self::Linear { modulus } => within("modulus", modulus, modulus > 0.0, "positive"),
        }
    }

    /// `k`.
    fn dispersion(&self) -> f64 {
        match self {
            Self::Exponential { dispersion, .. } => *dispersion,
            Self::Linear { .. } => 0.0,
        }
    }

    /// `psi`, `psi'` and `psi''`.
    fn energy(&self, strain: f64) -> Result<[f64; 3], ResponseError> {
        match *self {
            Self::Linear { modulus } => {
                let quarter = 0.25 * modulus;
                Ok([0.5 * quarter * strain * strain, quarter * strain, quarter])
            }
            Self::Exponential { .. } if strain <= SLACK => Ok([0.0; 3]),
            Self::Exponential { k1, k2, .. } => {
                let exponent = k2 * strain * strain;
                if exponent > LARGEST_EXPONENT {
                    let limit = (LARGEST_EXPONENT / k2).sqrt();
                    return Err(ResponseError::OverstretchedFibres { strain, limit });
                }
                let growth = exponent.exp();
                let energy = match k2 {
                    0.0 => 0.5 * k1 * strain * strain,
                    _ => 0.5 * k1 / k2 * exponent.exp_m1(),
                };
                let curvature = k1 * (1.0 + 2.0 * exponent) * growth;
                Ok([energy, k1 * strain * growth, curvature])
            }
        }
    }
}

/// The strain `E` of a family with its derivatives.
struct Strain<'a> {
    /// `E`.
    value: f64,
    /// `D`.
    slope: Matrix3<f64>,
    /// `M`.
    structure: Matrix3<f64>,
    /// `F M`.
    turned: Matrix3<f64>,
    /// `theta`.
    square: f64,
    /// `s`, `q`.
    split: [f64; 2],
    /// `H`.
    h: &'a Matrix3<f64>,
}

impl<'a> Strain<'a> {
    fn new(
        stiffness: FibreStiffness,
        direction: &Vector3<f64>,
        f: &Matrix3<f64>,
        ratio: f64,
        h: &'a Matrix3<f64>,
    ) -> Self {
        let dispersion = stiffness.dispersion();
        let structure = Matrix3::identity() * dispersion
            + direction * direction.transpose() * (1.0 - 3.0 * dispersion);
        let split = match stiffness {
            FibreStiffness::Exponential { .. } => [ratio.cbrt().powi(-2), 2.0 / 3.0],
            FibreStiffness::Linear { .. } => [1.0, 0.0],
        };
        let turned = f * structure;
        let square = turned.dot(f);
        let [scale, part] = split;
        Self {
            value: scale * square - 1.0,
            slope: (turned * 2.0 - h * (part * square)) * scale,
            structure,
            turned,
            square,
            split,
            h,
        }
    }

    /// Adds `psi'' D D + psi' d2E/dFdF`.
    fn add_tangent(&self, slope: f64, curvature: f64, tangent: &mut Tangent) {
        let (d, h, fm) = (&self.slope, self.h, &self.turned);
        let [scale, part] = self.split;
        let by = slope * scale;
        for (k, l) in (0..9).map(|at| (at / 3, at % 3)) {
            for (i, j) in (0..9).map(|at| (at / 3, at % 3)) {
                let own = if i == k {
                    2.0 * self.structure[(j, l)]
                } else {
                    0.0
                };
                let mixed = fm[(i, j)] * h[(k, l)] + h[(i, j)] * fm[(k, l)];
                let direct = part * part * self.square * h[(i, j)] * h[(k, l)];
                let crossed = part * self.square * h[(i, l)] * h[(k, j)];
                tangent[(3 * i + j, 3 * k + l)] += curvature * d[(i, j)] * d[(k, l)]
                    + by * (own - 2.0 * part * mixed + direct + crossed);
            }
        }
    }
}
