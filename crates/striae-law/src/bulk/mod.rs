//! Bulk laws: stored energy, first Piola-Kirchhoff stress and its tangent as
//! functions of the deformation gradient.
//!
//! ```text
//! P = dW/dF,   A = dP/dF = d2W/dF dF
//! ```
//!
//! `W` is energy per reference volume, `P` force per reference area, `A` the
//! first elasticity tensor: a 9x9 matrix whose row and column `3 i + J` belong
//! to the component `F_iJ` (`i` current, `J` reference), symmetric because `W`
//! exists. Units are those of the moduli.
//!
//! Laws with a memory have no energy that all stress comes from; they answer to a deformation
//! after a [`Past`] and say what is dissipated. Their `A` is symmetric all the same.
//!
//! Longer than other files, as it joins all laws in one type.
//!
//! A law is one file: parameters, formula, source, response; [`LAWS`] lists what decks, the
//! program and the Python package know by name. Further laws implement [`BulkLaw`], or
//! [`IsochoricLaw`] if they are rubber, in any crate.

mod analysis;
mod battery;
mod compact;
mod direction;
mod fibrous;
mod hardening;
mod history;
mod hyperelastic;
mod inadmissible;
mod invariants;
mod isochoric;
mod linear_elastic;
mod moduli;
mod neo_hookean;
mod own;
mod plastic;
mod rubber;
mod spectrum;
#[cfg(test)]
mod tests;
mod viscoelastic;
mod volumetric;

pub use analysis::{Mode, TestState};
pub use battery::{Violation, battery};
pub use compact::CompactTangent;
pub use direction::{DIRECTIONS, Direction, LinesAbout};
pub use fibrous::{FibreStiffness, Fibres, Fibrous, InadmissibleFibres};
pub use hardening::{HARDENING, Hardening, HardeningForm, InadmissibleHardening};
pub use history::{Field, Past, Present};
pub use hyperelastic::Hyperelastic;
pub use inadmissible::Inadmissible;
pub use invariants::Invariant;
pub use isochoric::ogden::OgdenTerm;
pub use isochoric::{InadmissibleHyperelastic, Isochoric, IsochoricLaw, OwnIsochoric};
pub use moduli::{ELASTIC_CONSTANTS, InadmissibleModuli, LameConstants};
pub use num_dual::DualNum;
pub use own::{BulkLaw, Own};
pub use plastic::Plastic;
pub use rubber::RUBBER;
use serde::Serialize;
pub use viscoelastic::{Branch, InadmissibleBranch, Viscoelastic};
pub use volumetric::{VOLUMETRIC, Volumetric};

use nalgebra::{Matrix3, SMatrix, Vector3};
use striae_declared::{Declared, Kind, Statement, Values};

/// The laws that decks, the program and the Python package know by name.
pub static LAWS: &[&Declared<Material>] = &[
    &neo_hookean::NEO_HOOKEAN,
    &linear_elastic::LINEAR_ELASTIC,
    &isochoric::neo_hookean::ISOCHORIC_NEO_HOOKEAN,
    &isochoric::mooney_rivlin::MOONEY_RIVLIN,
    &isochoric::yeoh::YEOH,
    &isochoric::ogden::OGDEN,
    &isochoric::gent::GENT,
    &isochoric::arruda_boyce::ARRUDA_BOYCE,
    &plastic::ELASTIC_PLASTIC,
];

/// First elasticity tensor `dP/dF`; row and column `3 i + J` for `F_iJ`.
pub type Tangent = SMatrix<f64, 9, 9>;

/// A bulk material; equal to others of the same law and constants, however these were stated.
#[derive(Clone, Debug, Serialize)]
#[serde(transparent)]
pub struct Material {
    law: Law,
    #[serde(skip)]
    statement: Option<Statement>,
}

impl PartialEq for Material {
    fn eq(&self, other: &Self) -> bool {
        self.law == other.law
    }
}

impl Kind for Material {
    type Refusal = Inadmissible;
    type Fit = std::convert::Infallible;

    fn with_statement(self, statement: Statement) -> Self {
        let statement = Some(statement);
        Self { statement, ..self }
    }

    fn statement(&self) -> Option<&Statement> {
        self.statement.as_ref()
    }

    fn refused(refusal: &Inadmissible) -> Option<&'static str> {
        refusal.parameter()
    }
}

/// A bulk law with its constants.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub enum Law {
    /// Compressible neo-Hookean solid.
    NeoHookean {
        /// First Lame constant.
        lambda: f64,
        /// Shear modulus `G`.
        shear: f64,
        /// Form of the volumetric energy.
        volumetric: Volumetric,
    },
    /// Linear elasticity of small strains.
    LinearElastic {
        /// First Lame constant.
        lambda: f64,
        /// Shear modulus `G`.
        shear: f64,
    },
    /// Rubber, with isochoric and volumetric energies apart.
    Hyperelastic(Hyperelastic),
    /// Rubber whose stress relaxes.
    Viscoelastic(Viscoelastic),
    /// Metal that yields.
    Plastic(Plastic),
    /// Families of fibres in one of the elastic solids.
    Fibrous(Fibrous),
    /// A law from outside the crate.
    Own(Own),
}

impl Law {
    pub(super) fn name(&self) -> &str {
        match self {
            Self::NeoHookean { .. } => "neo-Hookean",
            Self::LinearElastic { .. } => "linear elastic",
            Self::Hyperelastic(law) => law.isochoric().name(),
            Self::Viscoelastic(_) => "viscoelastic",
            Self::Plastic(_) => "elastic-plastic",
            Self::Fibrous(_) => "fibre-reinforced",
            Self::Own(own) => own.law().name(),
        }
    }

    /// Returns whether plastic flow limits the stress.
    pub(super) fn yields(&self) -> bool {
        matches!(self, Self::Plastic(_))
    }

    /// Returns whether rotations cost nothing.
    pub(super) fn is_objective(&self) -> bool {
        !matches!(self, Self::LinearElastic { .. })
    }

    pub(super) fn variables(&self) -> usize {
        match self {
            Self::Viscoelastic(law) => law.variables(),
            Self::Plastic(law) => law.variables(),
            Self::Fibrous(law) => law.variables(),
            Self::Own(own) => own.law().variables(),
            _ => 0,
        }
    }
}

/// Answer of a material to a deformation gradient.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Response<T = Tangent> {
    /// Stored energy `W` per reference volume.
    pub energy: f64,
    /// First Piola-Kirchhoff stress `P`.
    pub first_piola: Matrix3<f64>,
    /// First elasticity tensor `A = dP/dF`.
    pub tangent: T,
}

impl From<Response<CompactTangent>> for Response {
    #[inline]
    fn from(response: Response<CompactTangent>) -> Self {
        Self {
            energy: response.energy,
            first_piola: response.first_piola,
            tangent: response.tangent.full(),
        }
    }
}

/// A response with a compact tangent.
pub type CompactResult = Result<Response<CompactTangent>, ResponseError>;

/// Reason why a material has no response to a deformation gradient.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum ResponseError {
    /// The material is turned inside out.
    #[error("the deformation gradient has determinant {determinant:.6e}, but it must be positive")]
    Inverted {
        /// Determinant `J` of the deformation gradient.
        determinant: f64,
    },
    /// A law of one's own has no response to the deformation.
    #[error("the law has no response to a deformation gradient of determinant {determinant:.6e}")]
    Refused {
        /// Determinant `J` of the deformation gradient.
        determinant: f64,
    },
    /// The material is stretched beyond what its law allows.
    #[error("the invariant I1 - 3 is {strain:.6e}, but the law ends at {limit:.6e}")]
    Overstretched {
        /// `I1 - 3` of the isochoric deformation.
        strain: f64,
        /// The limit of the law.
        limit: f64,
    },
    /// Fibres are stretched beyond all measure.
    #[error("the strain of fibres is {strain:.6e}, but the law ends at {limit:.6e}")]
    OverstretchedFibres {
        /// Their strain `E`.
        strain: f64,
        /// The limit of the law.
        limit: f64,
    },
}

impl Material {
    /// A law from outside the crate.
    pub fn own(law: impl BulkLaw + 'static) -> Self {
        Self::new(Law::Own(Own::new(law)), None)
    }

    fn new(law: Law, statement: Option<Statement>) -> Self {
        Self { law, statement }
    }

    /// Rubber of an isochoric energy and the values of [`RUBBER`].
    ///
    /// # Errors
    ///
    /// When a constant is not admissible; see [`Hyperelastic::new`] and [`Viscoelastic::new`].
    pub fn rubber(isochoric: Isochoric, values: &Values) -> Result<Self, Inadmissible> {
        let volumetric = Volumetric::stated(values);
        let slow = match values.number_if_any(rubber::BULK_MODULUS) {
            Some(bulk) => Hyperelastic::new(isochoric, bulk, volumetric),
            None => {
                let ratio = values.number("poissons_ratio");
                Hyperelastic::with_poissons_ratio(isochoric, ratio, volumetric)
            }
        }?;
        let Some(branches) = Branch::stated(values) else {
            return Ok(Self::hyperelastic(slow));
        };
        Ok(Self::viscoelastic(Viscoelastic::new(slow, &branches)?))
    }

    /// The law with its constants.
    pub fn law(&self) -> &Law {
        &self.law
    }

    /// The name of the law.
    pub fn name(&self) -> &str {
        self.law.name()
    }

    /// Returns whether plastic flow, which keeps the volume, limits the stress.
    pub fn yields(&self) -> bool {
        self.law.yields()
    }

    /// Returns whether rotations cost nothing, as they do in all but small strains.
    pub fn is_objective(&self) -> bool {
        self.law.is_objective()
    }

    /// Number of internal variables of a point; zero if the law has none.
    pub fn variables(&self) -> usize {
        self.law.variables()
    }

    /// The variables of a point at rest at a place of the body: directions of fibres, else
    /// zeros.
    pub fn rest(&self, place: &Vector3<f64>) -> Vec<f64> {
        match &self.law {
            Law::Fibrous(law) => law.rest(place),
            _ => vec![0.0; self.variables()],
        }
    }

    /// The families of fibres.
    pub fn fibres(&self) -> &[Fibres] {
        match &self.law {
            Law::Fibrous(law) => law.families(),
            _ => &[],
        }
    }

    /// The material without its fibres.
    pub fn without_fibres(&self) -> &Self {
        match &self.law {
            Law::Fibrous(law) => law.ground(),
            _ => self,
        }
    }

    /// Returns whether all stress derives from an energy.
    fn is_elastic(&self) -> bool {
        self.variables() == 0 || matches!(self.law, Law::Fibrous(_))
    }

    /// Variables that are written with the results.
    pub fn fields(&self) -> Vec<Field> {
        match &self.law {
            Law::Plastic(law) => law.fields(),
            Law::Own(own) => own.law().fields(),
            _ => Vec::new(),
        }
    }

    /// Energy, stress and tangent at the deformation gradient `F` after what a point has
    /// been through; see [`Past`].
    ///
    /// # Errors
    ///
    /// As [`Material::response`].
    pub fn respond(
        &self,
        deformation_gradient: &Matrix3<f64>,
        past: Past,
        present: &mut Present,
    ) -> Result<Response, ResponseError> {
        match &self.law {
            Law::Viscoelastic(law) => law.respond(deformation_gradient, past, present),
            Law::Plastic(law) => law.respond(deformation_gradient, past, present),
            Law::Fibrous(law) => law.respond(deformation_gradient, past, present),
            Law::Own(own) => own.law().respond(deformation_gradient, past, present),
            _ => self.response(deformation_gradient),
        }
    }

    /// Energy, stress and tangent at the deformation gradient `F`; of a law with a memory
    /// what a point at rest answers at once, and with fibres a point at the origin.
    ///
    /// # Errors
    ///
    /// [`ResponseError`] where the law needs `det F > 0` and does not get it, or ends
    /// at a smaller stretch.
    pub fn response(&self, deformation_gradient: &Matrix3<f64>) -> Result<Response, ResponseError> {
        let f = deformation_gradient;
        match &self.law {
            Law::NeoHookean {
                lambda,
                shear,
                volumetric,
            } => neo_hookean::response(*lambda, *shear, *volumetric, f).map(Response::from),
            Law::LinearElastic { lambda, shear } => {
                Ok(linear_elastic::response(*lambda, *shear, f))
            }
            Law::Hyperelastic(law) => law.response(f),
            Law::Viscoelastic(_) | Law::Plastic(_) | Law::Fibrous(_) => {
                let rest = self.rest(&Vector3::zeros());
                let mut present = rest.clone();
                let past = Past {
                    variables: &rest,
                    elapsed: 0.0,
                };
                let mut present = Present {
                    variables: &mut present,
                    dissipated: 0.0,
                };
                self.respond(f, past, &mut present)
            }
            Law::Own(own) => own.law().response(f),
        }
    }

    /// The response as a function of the deformation gradient, where its tangent is compact.
    pub fn compact_response(&self) -> Option<impl Fn(&Matrix3<f64>) -> CompactResult + use<>> {
        match self.law {
            Law::NeoHookean {
                lambda,
                shear,
                volumetric,
            } => Some(move |f: &Matrix3<f64>| neo_hookean::response(lambda, shear, volumetric, f)),
            _ => None,
        }
    }

    /// Cauchy stress at the deformation gradient `F`: `P F^T / J`, and `P` itself for the law of
    /// small strains, which does not distinguish the two.
    ///
    /// # Errors
    ///
    /// As [`Material::response`].
    pub fn cauchy_stress(
        &self,
        deformation_gradient: &Matrix3<f64>,
    ) -> Result<Matrix3<f64>, ResponseError> {
        let first_piola = self.response(deformation_gradient)?.first_piola;
        Ok(self.cauchy(&first_piola, deformation_gradient))
    }

    /// Cauchy stress at the deformation gradient `F`, given the variables of the point.
    ///
    /// # Errors
    ///
    /// As [`Material::response`].
    pub fn cauchy_stress_after(
        &self,
        deformation_gradient: &Matrix3<f64>,
        variables: &[f64],
    ) -> Result<Matrix3<f64>, ResponseError> {
        let past = Past {
            variables,
            elapsed: 0.0,
        };
        let mut present = Present {
            variables: &mut variables.to_vec(),
            dissipated: 0.0,
        };
        let response = self.respond(deformation_gradient, past, &mut present)?;
        Ok(self.cauchy(&response.first_piola, deformation_gradient))
    }

    fn cauchy(&self, first_piola: &Matrix3<f64>, f: &Matrix3<f64>) -> Matrix3<f64> {
        match self.is_objective() {
            true => first_piola * f.transpose() / f.determinant(),
            false => *first_piola,
        }
    }

    /// The Lame constants of the small-strain limit.
    pub fn lame_constants(&self) -> LameConstants {
        match &self.law {
            Law::NeoHookean { lambda, shear, .. } | Law::LinearElastic { lambda, shear } => {
                LameConstants {
                    lambda: *lambda,
                    shear: *shear,
                }
            }
            Law::Hyperelastic(law) => law.lame_constants(),
            Law::Viscoelastic(law) => law.lame_constants(),
            Law::Plastic(law) => law.lame_constants(),
            Law::Fibrous(law) => law.lame_constants(),
            Law::Own(own) => own.law().lame_constants(),
        }
    }
}
