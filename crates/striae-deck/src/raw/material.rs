//! `[[material]]`.

use super::super::declare::{choice, either, table, words};
use super::Fibres;
use crate::{
    read::At,
    value::{NonNegative, Number, PoissonsRatio, Positive, Text},
};

table! {
    /// A bulk material.
    Material {
        /// Unique name.
        required name: Text,
        /// Mass per volume at rest. Required for inertia and gravity.
        optional density: Positive,
        /// Families of fibres in a neo-Hookean solid or in rubber without relaxation. Default:
        /// none.
        optional fibres: Vec<At<Fibres>>,
        /// Law and elastic constants.
        include law: BulkLaw,
    }
}

choice! {
    /// Bulk law.
    BulkLaw by law {
        "neo-hookean" => NeoHookean(NeoHookean),
        "linear-elastic" => LinearElastic(LinearElastic),
        "isochoric-neo-hookean" => IsochoricNeoHookean(IsochoricNeoHookean),
        "mooney-rivlin" => MooneyRivlin(MooneyRivlin),
        "yeoh" => Yeoh(Yeoh),
        "ogden" => Ogden(Ogden),
        "gent" => Gent(Gent),
        "arruda-boyce" => ArrudaBoyce(ArrudaBoyce),
        "elastic-plastic" => ElasticPlastic(ElasticPlastic),
    }
}

words! {
    /// Form of the volumetric energy for the volume ratio `J` and a modulus `k`.
    Volumetric {
        /// `k/2 (J - 1)^2`.
        Quadratic = "quadratic",
        /// `k/2 ln^2 J`.
        Logarithmic = "logarithmic",
    }
}

either! {
    /// Compressibility of rubber.
    Compressibility {
        BulkModulus(BulkModulus),
        Ratio(Ratio),
    }
}

table! {
    /// The bulk modulus.
    BulkModulus {
        /// Bulk modulus `K`.
        required bulk_modulus: Positive,
    }
}

table! {
    /// Poisson's ratio.
    Ratio {
        /// Poisson's ratio at rest.
        required poissons_ratio: PoissonsRatio,
    }
}

table! {
    /// Compressible neo-Hookean solid for large strains.
    NeoHookean {
        /// Elastic constants.
        include constants: ElasticConstants,
        /// Form of the volumetric energy, with `k = lambda`. Default: `quadratic`.
        optional volumetric: Volumetric,
    }
}

table! {
    /// Rubber with the energy `G/2 (I1 - 3)`, nearly incompressible.
    IsochoricNeoHookean {
        /// Shear modulus `G`.
        required shear_modulus: Positive,
        /// Bulk modulus or Poisson's ratio.
        include compressibility: Compressibility,
        /// Form of the volumetric energy. Default: `quadratic`.
        optional volumetric: Volumetric,
        /// Branches with relaxing stress in parallel to the law, which describes slow deformations.
        /// Default: none.
        optional relaxation: Vec<At<Branch>>,
    }
}

table! {
    /// Rubber with the energy `c10 (I1 - 3) + c01 (I2 - 3)`, nearly incompressible.
    MooneyRivlin {
        /// Constant of the first invariant.
        required c10: Number,
        /// Constant of the second invariant; `c10 + c01` must be positive.
        required c01: Number,
        /// Bulk modulus or Poisson's ratio.
        include compressibility: Compressibility,
        /// Form of the volumetric energy. Default: `quadratic`.
        optional volumetric: Volumetric,
        /// Branches with relaxing stress in parallel to the law, which describes slow deformations.
        /// Default: none.
        optional relaxation: Vec<At<Branch>>,
    }
}

table! {
    /// Rubber with a cubic energy of `I1 - 3`, nearly incompressible.
    Yeoh {
        /// Constant of `I1 - 3`, half the shear modulus at rest.
        required c10: Positive,
        /// Constant of `(I1 - 3)^2`.
        required c20: Number,
        /// Constant of `(I1 - 3)^3`.
        required c30: Number,
        /// Bulk modulus or Poisson's ratio.
        include compressibility: Compressibility,
        /// Form of the volumetric energy. Default: `quadratic`.
        optional volumetric: Volumetric,
        /// Branches with relaxing stress in parallel to the law, which describes slow deformations.
        /// Default: none.
        optional relaxation: Vec<At<Branch>>,
    }
}

table! {
    /// Rubber with the energy `sum mu/alpha (l1^alpha + l2^alpha + l3^alpha - 3)` of the isochoric stretches, nearly incompressible.
    Ogden {
        /// Terms; the shear modulus at rest, half the sum of `mu alpha`, must be positive.
        required terms: Vec<At<OgdenTerm>>,
        /// Bulk modulus or Poisson's ratio.
        include compressibility: Compressibility,
        /// Form of the volumetric energy. Default: `quadratic`.
        optional volumetric: Volumetric,
        /// Branches with relaxing stress in parallel to the law, which describes slow deformations.
        /// Default: none.
        optional relaxation: Vec<At<Branch>>,
    }
}

table! {
    /// A term of Ogden's law. Other programs write `2 mu/alpha^2` where this one writes `mu/alpha`.
    OgdenTerm {
        /// Modulus.
        required mu: Number,
        /// Exponent, not zero.
        required alpha: Number,
    }
}

table! {
    /// Rubber with chains of finite length: energy `-G Jm/2 ln(1 - (I1 - 3)/Jm)`, nearly incompressible.
    Gent {
        /// Shear modulus `G`.
        required shear_modulus: Positive,
        /// `Jm`, the limit of `I1 - 3`.
        required limit: Positive,
        /// Bulk modulus or Poisson's ratio.
        include compressibility: Compressibility,
        /// Form of the volumetric energy. Default: `quadratic`.
        optional volumetric: Volumetric,
        /// Branches with relaxing stress in parallel to the law, which describes slow deformations.
        /// Default: none.
        optional relaxation: Vec<At<Branch>>,
    }
}

table! {
    /// Rubber by the first five terms of the eight-chain model, nearly incompressible.
    ArrudaBoyce {
        /// Modulus `mu`, near the shear modulus at rest.
        required mu: Positive,
        /// Stretch at which the chains lock, above 1.
        required locking_stretch: Positive,
        /// Bulk modulus or Poisson's ratio.
        include compressibility: Compressibility,
        /// Form of the volumetric energy. Default: `quadratic`.
        optional volumetric: Volumetric,
        /// Branches with relaxing stress in parallel to the law, which describes slow deformations.
        /// Default: none.
        optional relaxation: Vec<At<Branch>>,
    }
}

table! {
    /// A spring and a dashpot in series. If another program states the share `g` of the modulus of sudden deformations, the ratio is `g/(1 - sum of all g)`.
    Branch {
        /// Ratio of its modulus to that of slow deformations.
        required ratio: Positive,
        /// Relaxation time, in the unit of the durations of steps.
        required time: Positive,
    }
}

table! {
    /// Metal with von Mises plasticity and isotropic hardening, for large strains.
    ElasticPlastic {
        /// Elastic constants.
        include constants: ElasticConstants,
        /// Yield stress over the equivalent plastic strain.
        include hardening: Hardening,
    }
}

either! {
    /// Yield stress over the equivalent plastic strain `p`.
    Hardening {
        Smooth(SmoothHardening),
        Table(HardeningTable),
    }
}

table! {
    /// A formula: `Y0 + (Ys - Y0) (1 - exp(-d p)) + H p`.
    SmoothHardening {
        /// First yield stress `Y0`.
        required yield_stress: Positive,
        /// Hardening modulus `H`. Default: 0.
        optional hardening_modulus: NonNegative,
        /// Saturation by Voce's law. Default: none.
        optional saturation: Saturation,
    }
}

table! {
    /// Saturation by Voce's law.
    Saturation {
        /// Stress `Ys`, at least the first yield stress.
        required stress: Positive,
        /// Rate `d` over the plastic strain.
        required rate: Positive,
    }
}

table! {
    /// Straight lines between points.
    HardeningTable {
        /// Pairs of equivalent plastic strain, from 0 on, and yield stress, which must not fall; the last stress holds beyond.
        required yield_table: Vec<At<[Number; 2]>>,
    }
}

table! {
    /// Linear elasticity for small strains and small rotations.
    LinearElastic {
        /// Elastic constants.
        include constants: ElasticConstants,
    }
}

either! {
    /// Two elastic constants.
    ElasticConstants {
        Engineering(EngineeringConstants),
        Lame(LameConstants),
    }
}

table! {
    /// Young's modulus and Poisson's ratio.
    EngineeringConstants {
        /// Young's modulus.
        required youngs_modulus: Positive,
        /// Poisson's ratio.
        required poissons_ratio: PoissonsRatio,
    }
}

table! {
    /// Lame's constants.
    LameConstants {
        /// First Lame constant; the bulk modulus, `lambda + 2/3 shear_modulus`, must be positive.
        required lambda: Number,
        /// Shear modulus.
        required shear_modulus: Positive,
    }
}
