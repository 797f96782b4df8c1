//! Parameters that all rubber has, whatever its isochoric energy.

use super::volumetric::VOLUMETRIC;
use striae_declared::{Absent, NO_UNIT, POISSONS_RATIO, POSITIVE, Parameter, Set};

/// Bulk modulus or Poisson's ratio.
const COMPRESSIBILITY: Parameter = Parameter::one_of(
    "compressibility",
    &[
        Set {
            doc: "The bulk modulus.",
            parameters: &[Parameter::number(
                BULK_MODULUS,
                POSITIVE,
                "force per area",
                "Bulk modulus `K`.",
            )],
        },
        Set {
            doc: "Poisson's ratio.",
            parameters: &[Parameter::number(
                "poissons_ratio",
                POISSONS_RATIO,
                NO_UNIT,
                "Poisson's ratio at rest.",
            )],
        },
    ],
);

/// Name of the bulk modulus.
pub(super) const BULK_MODULUS: &str = "bulk_modulus";

/// Branches that relax.
pub(super) const RELAXATION: Parameter = Parameter::tables(
    "relaxation",
    &Set {
        doc: "A spring and a dashpot in series. If another program states the share `g` of the modulus of sudden deformations, the ratio is `g/(1 - sum of all g)`.",
        parameters: &[
            Parameter::number(
                "ratio",
                POSITIVE,
                NO_UNIT,
                "Ratio of its modulus to that of slow deformations.",
            ),
            Parameter::number(
                "time",
                POSITIVE,
                "time",
                "Relaxation time, in the unit of the durations of steps.",
            ),
        ],
    },
    "Branches with relaxing stress in parallel to the law, which describes slow deformations.",
)
.or(Absent::Nothing);

/// Parameters that all rubber has besides those of its isochoric energy;
/// [`Material::rubber`](super::Material::rubber) reads them.
pub const RUBBER: Parameter = Parameter::one_of(
    "rubber",
    &[Set {
        doc: "",
        parameters: &[COMPRESSIBILITY, VOLUMETRIC, RELAXATION],
    }],
);
