//! Model of a simulation: its data, what follows from them alone, builders by name, and validation.
//!
//! ```text
//! model("title").body(..).pair(..).step(..)   names of bodies, sets and surfaces
//!     .build()  -> Model or Faults             ids and members; gaps closed where asked for
//! Model::faults() -> [Fault { path, kind }]    every fault there is, `pairs[0].friction: ...`
//! ```
//!
//! Conditions in force ([`plan`]), pairs at rest ([`pair_geometry`], [`initial`](mod@initial)),
//! [ties](mod@tie) and loads on faces ([`load`]) follow from a model before anything is solved.
//! Neither a file format nor a solver is known here. A deck is read by `striae-deck`, which maps the paths of faults
//! back to lines and columns.

pub mod actuation;
pub mod axes;
mod build;
pub mod cavity;
mod check;
mod curve;
mod fault;
mod fit;
pub mod formula;
pub mod function;
mod general;
pub mod initial;
pub mod load;
mod model;
mod motions;
mod names;
pub mod node;
pub mod painting;
pub mod pair_geometry;
mod path;
pub mod plan;
mod sections;
pub mod solid;
pub mod tie;

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
pub use model::*;
pub use motions::RigidMotions;
pub use names::nearest;
pub use path::{Path, Segment};
