//! Description of a simulation: the parts of a model, builders by name, and validation.
//!
//! ```text
//! model("title").body(..).pair(..).step(..)   names of bodies, sets and surfaces
//!     .build()  -> Model or Faults             ids and members; gaps closed where asked for
//! Model::faults() -> [Fault { path, kind }]    every fault there is, `pairs[0].friction: ...`
//! ```
//!
//! No file format is known here. A deck is read by `striae-deck`, which maps the paths of faults
//! back to lines and columns.

mod build;
mod check;
mod fault;
mod fit;
mod general;
mod motions;
mod names;
mod path;

pub use build::{
    BodyBuilder, CavityBuilder, Component, Components, ModelBuilder, PairBuilder, RigidBuilder,
    SectionBuilder, SideBuilder, SpringBuilder, SpringEndBuilder, StepBuilder, TieBuilder, axial,
    body, cavity, circumferential, composite, equal_increments, extended, itself, model, nodal,
    nodes_of, painted, pair, plane, point_of, radial, reference_of, rigid, rigid_solid,
    rigid_surface, section, shared_force, solver, spring, spring_along, spring_to_point, step,
    surface, tie, tied, turned, uniform, usual_curve,
};
pub use check::{
    Draft, DraftBody, DraftPair, DraftStep, Known, Named, Validate, misshapen, whole_faults,
};
pub use fault::{Fault, FaultKind, Faults};
pub use fit::fitted;
pub use general::{Everything, FEATURE_ANGLE, Lowered, Origin, everything};
pub use motions::RigidMotions;
pub use names::nearest;
pub use path::{Path, Segment};
pub use striae_solve::model::*;
