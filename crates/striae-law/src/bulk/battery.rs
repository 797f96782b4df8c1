//! Battery of properties that every bulk law must satisfy, checked in one call.
//!
//! A user-defined law is checked against the laws of elasticity before it is used in a mesh: no
//! energy and no stress at rest, `P = dW/dF`, `A = dP/dF = A^T`, and `W(Q F) = W(F)` for every
//! rotation `Q`. A law with internal variables is first driven along a random path; these are held
//! fixed while derivatives are taken. `P = dW/dF` is required only of laws without internal
//! variables, and the dissipation must not be negative. Derivatives are judged by the order at
//! which finite-difference errors fall, so no tolerance has to be chosen.

use std::fmt;

use nalgebra::{DMatrix, DVector, Matrix3, Vector3};
use striae_verify::derivative::directional;
use striae_verify::{Difference, Random};

use super::{Material, Past, Present, Response, ResponseError};

/// Something a bulk law gets wrong.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Violation {
    /// A deformation near the state of rest has no answer.
    #[error("the law fails for a deformation gradient near the identity: {0}")]
    NoResponse(ResponseError),
    /// Energy or stress at rest.
    #[error(
        "at rest the energy is {energy:.6e} and the norm of the stress {stress:.6e}, but both must be 0"
    )]
    Rest {
        /// Stored energy.
        energy: f64,
        /// Norm of the stress.
        stress: f64,
    },
    /// The stress is not the derivative of the energy.
    #[error("the stress is not the derivative of the energy\n{0}")]
    Stress(String),
    /// The tangent is not the derivative of the stress.
    #[error("the tangent is not the derivative of the stress\n{0}")]
    Tangent(String),
    /// The tangent is not symmetric.
    #[error("the tangent differs from its transpose by {0:.3e} of its norm")]
    Asymmetric(f64),
    /// Less than nothing is dissipated.
    #[error("the dissipation of an increment is {0:.6e}, but it must not be negative")]
    Dissipation(f64),
    /// A rotation changes the energy or more than the direction of the stress.
    #[error(
        "a rotation changes the energy by {energy:.3e} and the turned-back stress by {stress:.3e}"
    )]
    NotObjective {
        /// Change of the energy, over the shear modulus.
        energy: f64,
        /// Norm of the change of the stress, over the shear modulus.
        stress: f64,
    },
}

/// Number of states in which the law is checked.
const STATES: u64 = 5;
/// Largest disturbance of a component of the identity.
const AMPLITUDE: f64 = 0.15;
/// Increments in which a law with a memory is led to a state, each of this duration.
const INCREMENTS: usize = 4;
const ELAPSED: f64 = 0.3;
/// Differences below this share of the shear modulus are round-off.
const ROUND_OFF: f64 = 1e-10;

/// Everything the law of a material gets wrong, empty for a sound elastic law.
///
/// [Linear elasticity](Material::linear_elastic) is not objective, which is what it is found guilty of.
pub fn battery(material: &Material) -> Vec<Violation> {
    let mut violations = Vec::new();
    let mut judge = |judged: Result<(), Violation>| violations.extend(judged.err());
    judge(rest(material));
    for seed in 0..STATES {
        let mut random = Random::new(seed);
        let point = match Point::led(material, &mut random) {
            Ok(point) => point,
            Err(wrong) => {
                judge(Err(wrong));
                continue;
            }
        };
        let f = random.near_identity(AMPLITUDE);
        let q = *random.rotation().matrix();
        match point.response(&f) {
            Ok((response, _)) => {
                judge(symmetric(&response));
                judge(point.objective(&f, &q));
                judge(point.consistent(&f, &response, &mut random));
            }
            Err(wrong) => judge(Err(wrong)),
        }
    }
    violations.sort_by_key(Violation::kind);
    violations.dedup_by_key(|violation| violation.kind());
    violations
}

impl Violation {
    fn kind(&self) -> u8 {
        match self {
            Self::NoResponse(_) => 0,
            Self::Rest { .. } => 1,
            Self::Stress(_) => 2,
            Self::Tangent(_) => 3,
            Self::Asymmetric(_) => 4,
            Self::NotObjective { .. } => 5,
            Self::Dissipation(_) => 6,
        }
    }
}

fn rest(material: &Material) -> Result<(), Violation> {
    let rest = material
        .response(&Matrix3::identity())
        .map_err(Violation::NoResponse)?;
    let (energy, stress) = (rest.energy, rest.first_piola.norm());
    let scale = ROUND_OFF * material.lame_constants().shear;
    if energy.abs() <= scale && stress <= scale {
        Ok(())
    } else {
        Err(Violation::Rest { energy, stress })
    }
}

fn symmetric(response: &Response) -> Result<(), Violation> {
    let tangent = &response.tangent;
    let share = (tangent - tangent.transpose()).norm() / tangent.norm();
    if share <= ROUND_OFF {
        Ok(())
    } else {
        Err(Violation::Asymmetric(share))
    }
}

/// A point of a material and what it has been through.
struct Point<'a> {
    material: &'a Material,
    variables: Vec<f64>,
}

impl<'a> Point<'a> {
    /// A point at the end of a random path; at rest where there is no memory.
    fn led(material: &'a Material, random: &mut Random) -> Result<Self, Violation> {
        let mut point = Self {
            material,
            variables: material.rest(&Vector3::zeros()),
        };
        if !point.variables.is_empty() {
            for _ in 0..INCREMENTS {
                let f = random.near_identity(AMPLITUDE);
                let (_, (variables, dissipated)) = point.response(&f)?;
                if dissipated.is_nan() || dissipated < 0.0 {
                    return Err(Violation::Dissipation(dissipated));
                }
                point.variables = variables;
            }
        }
        Ok(point)
    }

    /// The response with the variables that follow and what is dissipated.
    fn response(&self, f: &Matrix3<f64>) -> Result<(Response, (Vec<f64>, f64)), Violation> {
        let mut variables = self.variables.clone();
        let past = Past {
            variables: &self.variables,
            elapsed: ELAPSED,
        };
        let mut present = Present {
            variables: &mut variables,
            dissipated: 0.0,
        };
        let response = self.material.respond(f, past, &mut present);
        let dissipated = present.dissipated;
        let response = response.map_err(Violation::NoResponse)?;
        Ok((response, (variables, dissipated)))
    }

    fn objective(&self, f: &Matrix3<f64>, q: &Matrix3<f64>) -> Result<(), Violation> {
        let (before, _) = self.response(f)?;
        let (after, _) = self.response(&(q * f))?;
        let shear = self.material.lame_constants().shear;
        let energy = (before.energy - after.energy).abs() / shear;
        let stress = (before.first_piola - q.transpose() * after.first_piola).norm() / shear;
        if energy <= ROUND_OFF && stress <= ROUND_OFF {
            Ok(())
        } else {
            Err(Violation::NotObjective { energy, stress })
        }
    }

    /// Stress and tangent against differences along a random direction.
    fn consistent(
        &self,
        f: &Matrix3<f64>,
        response: &Response,
        random: &mut Random,
    ) -> Result<(), Violation> {
        let (x, direction) = (components(f), random.unit(9));
        let at = |x: &DVector<f64>| self.response(&Matrix3::from_row_slice(x.as_slice()));
        let energy = |x: &DVector<f64>| {
            let energy = at(x).map_or(f64::NAN, |(response, _)| response.energy);
            DVector::from_element(1, energy)
        };
        let stress = |x: &DVector<f64>| {
            at(x).map_or_else(
                |_| DVector::from_element(9, f64::NAN),
                |(response, _)| components(&response.first_piola),
            )
        };
        if self.material.is_elastic() {
            let slope = components(&response.first_piola).dot(&direction);
            let slope = DVector::from_element(1, slope);
            directional(Difference::Central, energy, &slope, &x, &direction)
                .map_err(|wrong| Violation::Stress(words(&wrong)))?;
        }
        let tangent = DMatrix::from_iterator(9, 9, response.tangent.iter().copied());
        let slope = tangent * &direction;
        directional(Difference::Central, stress, &slope, &x, &direction)
            .map_err(|wrong| Violation::Tangent(words(&wrong)))?;
        Ok(())
    }
}

fn words(wrong: &impl fmt::Display) -> String {
    wrong.to_string().trim_end().to_owned()
}

/// Components in the order of the tangent, row by row.
fn components(f: &Matrix3<f64>) -> DVector<f64> {
    DVector::from_iterator(9, f.transpose().iter().copied())
}
