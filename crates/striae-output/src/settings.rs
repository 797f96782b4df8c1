//! Settings of the output: what a run writes, and how often.

use serde::{Deserialize, Serialize};
use std::num::NonZeroUsize;

use striae_mesh::Vec3;

/// Output of a run.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Output {
    /// Increments or times at which fields are written.
    pub fields: FieldOutput,
    /// Names of the bodies whose fields are written; `None`: all.
    pub bodies: Option<Vec<String>>,
    /// Fields of bodies.
    pub body_fields: Vec<BodyField>,
    /// Fields of contact surfaces.
    pub contact_fields: Vec<ContactField>,
    /// Archard's coefficient `k`, wear depth over pressure and slip; `None`: wear is not
    /// written.
    pub wear_coefficient: Option<f64>,
    /// Probes written to `probes.csv` after every increment.
    pub probes: Vec<Probe>,
    /// Cuts whose forces are written to `sections.csv` after every increment.
    pub sections: Vec<Section>,
    /// Increments between checkpoints at most; `None`: only when the run stops.
    pub checkpoint_every: Option<NonZeroUsize>,
}

/// Fields of all bodies after every increment, checkpoints after every ten.
impl Default for Output {
    fn default() -> Self {
        Self {
            fields: FieldOutput::Every(NonZeroUsize::MIN),
            bodies: None,
            body_fields: BodyField::USUAL.to_vec(),
            contact_fields: ContactField::USUAL.to_vec(),
            wear_coefficient: None,
            probes: Vec::new(),
            sections: Vec::new(),
            checkpoint_every: NonZeroUsize::new(10),
        }
    }
}

/// Increments or times at which fields are written.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum FieldOutput {
    /// After every so many increments, and after the last.
    Every(NonZeroUsize),
    /// After the first increment that reaches each multiple of a time, and after the last.
    Interval(f64),
    /// After the last increment only.
    Last,
}

/// A field of a body.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub enum BodyField {
    /// Displacement.
    Displacement,
    /// Velocity, in dynamic steps.
    Velocity,
    /// Cauchy stress.
    CauchyStress,
    /// Equivalent stress of von Mises.
    VonMises,
    /// Principal values of the Cauchy stress, the largest first.
    PrincipalStress,
    /// Unit vectors along the principal axes of the Cauchy stress, that of the largest first.
    PrincipalStressDirections,
    /// Logarithmic strain.
    LogarithmicStrain,
    /// Principal values of the logarithmic strain, the largest first.
    PrincipalStrain,
    /// Unit vectors along its principal axes, that of the largest first.
    PrincipalStrainDirections,
    /// Stored energy per reference volume of the elements at each node.
    StrainEnergyDensity,
    /// Internal variables of materials that have a name, by element.
    HistoryVariables,
    /// Number of the section of each element, 0 where it is of the body's own material; of
    /// bodies with sections.
    Section,
    /// Unit vectors along the families of fibres of each element, one array a family; of
    /// bodies with fibres.
    Fibres,
}

impl BodyField {
    /// Fields written by default.
    pub const USUAL: [Self; 7] = [
        Self::Displacement,
        Self::Velocity,
        Self::CauchyStress,
        Self::VonMises,
        Self::HistoryVariables,
        Self::Section,
        Self::Fibres,
    ];
}

/// A field of contact surfaces.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub enum ContactField {
    /// Distance to the other side.
    Gap,
    /// Pressure and traction.
    Traction,
    /// Pressure and traction averaged about each node.
    MeanTraction,
    /// Slip in the last increment.
    Slip,
    /// Slip in the last increment over its time.
    SlipRate,
    /// Length of the way slipped since the start.
    AccumulatedSlip,
    /// Depth that has worn off since the start, of pairs that wear.
    WornDepth,
    /// State of friction that depends on rate and state.
    FrictionState,
    /// Friction work per area since the start.
    FrictionWork,
    /// Normal.
    Normal,
    /// Texture and structural vector.
    Texture,
    /// Open, stick or slip.
    Status,
    /// Nodes with unknowns.
    Roles,
}

impl ContactField {
    /// Fields written by default: all except the slip rate and the state of friction; the depth that
    /// has worn off of pairs that wear.
    pub const USUAL: [Self; 11] = [
        Self::Gap,
        Self::Traction,
        Self::MeanTraction,
        Self::Slip,
        Self::AccumulatedSlip,
        Self::WornDepth,
        Self::FrictionWork,
        Self::Normal,
        Self::Texture,
        Self::Status,
        Self::Roles,
    ];
}

/// A place of a body that is watched.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Probe {
    /// Name of its columns.
    pub name: String,
    /// Name of the body.
    pub body: String,
    /// Place of the probe.
    pub place: ProbePlace,
}

/// Place of a probe.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub enum ProbePlace {
    /// A material point, by its place in the reference configuration.
    Point(Vec3),
    /// The mean over the nodes of a set.
    Nodes(String),
}

/// A plane cut through a body, whose force and moment are watched.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Section {
    /// Name of its columns.
    pub name: String,
    /// Name of the body.
    pub body: String,
    /// A point of the plane, in the reference configuration.
    pub point: Vec3,
    /// Normal of the plane there, of any length.
    pub normal: Vec3,
}
