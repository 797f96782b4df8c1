//! Reasons to refuse the constants of a material.

use super::{
    InadmissibleBranch, InadmissibleHardening, InadmissibleHyperelastic, InadmissibleModuli,
};

/// Constants of a material that cannot be.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Inadmissible {
    /// Elastic constants.
    #[error(transparent)]
    Moduli(#[from] InadmissibleModuli),
    /// Constants of rubber.
    #[error(transparent)]
    Hyperelastic(#[from] InadmissibleHyperelastic),
    /// Branches of relaxing rubber.
    #[error(transparent)]
    Branch(#[from] InadmissibleBranch),
    /// The yield stress of metal.
    #[error(transparent)]
    Hardening(#[from] InadmissibleHardening),
    /// Constants that a law from outside the crate refuses.
    #[error("{reason}")]
    Own {
        /// Parameter at fault, if it is one.
        parameter: Option<&'static str>,
        /// The reason, with the value that was found and what is needed.
        reason: String,
    },
}

impl Inadmissible {
    /// The parameter at fault, if it is one.
    pub fn parameter(&self) -> Option<&'static str> {
        match self {
            Self::Moduli(moduli) => Some(match moduli {
                InadmissibleModuli::YoungsModulus(_) => "youngs_modulus",
                InadmissibleModuli::PoissonsRatio(_) => "poissons_ratio",
                InadmissibleModuli::BulkModulus { .. } => "lambda",
            }),
            Self::Hyperelastic(constants) => match constants {
                InadmissibleHyperelastic::NotFinite { name, .. }
                | InadmissibleHyperelastic::NotPositive { name, .. } => Some(name),
                InadmissibleHyperelastic::NoExponent(_) | InadmissibleHyperelastic::NoTerm => {
                    Some("terms")
                }
                InadmissibleHyperelastic::Locked(_) => Some("locking_stretch"),
                InadmissibleHyperelastic::Shear(_) | InadmissibleHyperelastic::Bulk { .. } => None,
            },
            Self::Branch(_) => Some("relaxation"),
            Self::Hardening(hardening) => Some(match hardening {
                InadmissibleHardening::Constant { name, .. } => name,
                InadmissibleHardening::Saturation { .. } => "saturation",
                InadmissibleHardening::Start | InadmissibleHardening::Order(_) => "yield_table",
            }),
            Self::Own { parameter, .. } => *parameter,
        }
    }
}
