//! `[[material]]`, `[[body]]` and `[[rigid]]`.

use super::{
    super::declare::{choice, either, table, words},
    FacetSet, Mesh, NodeSet,
};
use crate::{
    read::At,
    value::{NonNegative, Number, PoissonsRatio, Positive, Text, Whole},
};

table! {
    /// A bulk material.
    Material {
        /// Unique name.
        required name: Text,
        /// Mass per volume at rest. Needed where there is inertia or gravity.
        optional density: Positive,
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
    /// How far rubber changes its volume.
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
        /// Branches whose stress relaxes, beside the law, which is that of slow deformations. Default: none.
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
        /// Branches whose stress relaxes, beside the law, which is that of slow deformations. Default: none.
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
        /// Branches whose stress relaxes, beside the law, which is that of slow deformations. Default: none.
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
        /// Branches whose stress relaxes, beside the law, which is that of slow deformations. Default: none.
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
    /// Rubber whose chains have a finite length: energy `-G Jm/2 ln(1 - (I1 - 3)/Jm)`, nearly incompressible.
    Gent {
        /// Shear modulus `G`.
        required shear_modulus: Positive,
        /// `Jm`, the limit of `I1 - 3`.
        required limit: Positive,
        /// Bulk modulus or Poisson's ratio.
        include compressibility: Compressibility,
        /// Form of the volumetric energy. Default: `quadratic`.
        optional volumetric: Volumetric,
        /// Branches whose stress relaxes, beside the law, which is that of slow deformations. Default: none.
        optional relaxation: Vec<At<Branch>>,
    }
}

table! {
    /// Rubber by the eight-chain model, its first five terms, nearly incompressible.
    ArrudaBoyce {
        /// Modulus `mu`, near the shear modulus at rest.
        required mu: Positive,
        /// Stretch at which the chains lock, above 1.
        required locking_stretch: Positive,
        /// Bulk modulus or Poisson's ratio.
        include compressibility: Compressibility,
        /// Form of the volumetric energy. Default: `quadratic`.
        optional volumetric: Volumetric,
        /// Branches whose stress relaxes, beside the law, which is that of slow deformations. Default: none.
        optional relaxation: Vec<At<Branch>>,
    }
}

table! {
    /// A spring and a dashpot in series. Where other programs state the share `g` of the modulus of sudden deformations, the ratio is `g/(1 - sum of all g)`.
    Branch {
        /// Modulus over that of slow deformations.
        required ratio: Positive,
        /// Relaxation time.
        required time: Positive,
    }
}

table! {
    /// Metal that yields by von Mises' rule, for large strains, with isotropic hardening.
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
    /// Straight lines.
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

table! {
    /// A deformable body.
    Body {
        /// Unique name.
        required name: Text,
        /// Name of its material.
        required material: Text,
        /// Its mesh, read from a file or generated.
        required mesh: Mesh,
        /// How its elements take up strain. Default: `mean-dilatation` where Poisson's ratio is above 0.45, else `standard`.
        optional formulation: Formulation,
        /// Mass of the nodes of its contact surfaces in dynamic steps. Default: `consistent`.
        optional contact_mass: ContactMass,
        /// More sets of nodes.
        optional node_sets: Vec<At<NodeSet>>,
        /// More sets of facets.
        optional facet_sets: Vec<At<FacetSet>>,
    }
}

words! {
    /// How elements take up strain.
    Formulation {
        /// By displacements alone; locks where volumes can hardly change.
        Standard = "standard",
        /// With pressure and volume constant in the element; linear tetrahedra lock also with it.
        MeanDilatation = "mean-dilatation",
    }
}

words! {
    /// Mass of the nodes of contact surfaces.
    ContactMass {
        /// What the consistent mass matrix gives them.
        Consistent = "consistent",
        /// None: it is moved to the nodes behind, against oscillations of contact.
        Redistributed = "redistributed",
    }
}

table! {
    /// A rigid body: a surface to touch, or what nodes are tied to.
    Rigid {
        /// Unique name.
        required name: Text,
        /// Its shape.
        include shape: RigidShape,
        /// Point about which it turns, and centre of a given `mass`. Default: the centre of the mass with `density`, else the origin.
        optional reference: [Number; 3],
        /// Density of the solid inside a closed `mesh`, from which mass, centre and moments of inertia follow. Default: none.
        optional density: Positive,
        /// Mass; needs `inertia`. Default: none.
        optional mass: Positive,
        /// Principal moments of inertia about the coordinate axes through the reference point; needs `mass`.
        optional inertia: [Positive; 3],
    }
}

either! {
    /// Shape of a rigid surface.
    RigidShape {
        Plane(RigidPlane),
        Mesh(RigidMesh),
        Tied(RigidTied),
    }
}

table! {
    /// An unbounded plane.
    RigidPlane {
        /// The plane by a point of it and its normal.
        required plane: Plane,
    }
}

table! {
    /// Nodes that follow the body.
    RigidTied {
        /// Sets of nodes that are tied to it.
        required tied: Vec<At<Tie>>,
    }
}

table! {
    /// Nodes of a deformable body.
    Tie {
        /// Name of the body.
        required body: Text,
        /// Name of its node set.
        required nodes: Text,
    }
}

table! {
    /// A point and a normal.
    Plane {
        /// A point of the plane.
        required point: [Number; 3],
        /// Normal of any length, out of the rigid half space.
        required normal: [Number; 3],
    }
}

table! {
    /// A surface of triangles and quadrilaterals.
    RigidMesh {
        /// Its facets, outward by the right-hand rule.
        required mesh: SurfaceMesh,
    }
}

either! {
    /// A surface mesh.
    SurfaceMesh {
        File(super::MeshFile),
        Inline(InlineSurface),
    }
}

table! {
    /// A surface mesh written in the deck.
    InlineSurface {
        /// Positions of the nodes.
        required positions: Vec<At<[Number; 3]>>,
        /// Nodes of the facets, counted from 0, outward by the right-hand rule; a triangle repeats its last node.
        required facets: Vec<At<[Whole<0>; 4]>>,
    }
}
