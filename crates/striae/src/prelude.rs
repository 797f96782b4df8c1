//! Items that most programs need: `use striae::prelude::*;`.

pub use crate::{
    Converged, Error, Finished, Interrupt, Next, Observer, PairSide, Results, Simulation,
};
pub use striae_contact::unknowns::{NodeResult, Status};
pub use striae_law::{
    bulk::{Hyperelastic, Isochoric, LameConstants, Material, OgdenTerm, Volumetric},
    friction::{
        Decay, Evolution, Friction, Logarithm, PressureDependence, RateAndState, RateDependence,
        SlipDependence, SlipRule, StateDependence,
    },
};
pub use striae_mesh::{Mesh, NodeId, Region, Vec3, generate::Block};
pub use striae_model::{
    ActuationKind, Component, Curve, Freedom, Initial, LoadExtent, LoadKind, Model, Validate, body,
    circumferential, composite, everything, itself, model, pair, plane, rigid, section, step,
    surface, tie, tied, uniform,
};
pub use striae_output::{BodyField, ContactField, FieldOutput, Output, Probe, ProbePlace, Section};
pub use striae_solve::outcome::Ending;
pub use striae_surface::texture::Paint;
