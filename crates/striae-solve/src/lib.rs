//! Elements, loads, the problem and its state, Newton's method and step control.

pub mod assembly;
pub mod composition;
mod contact_mass;
mod curve;
pub mod drive;
pub mod dynamics;
pub mod freedom;
pub mod initial;
pub mod interference;
pub mod layout;
pub mod load;
pub mod model;
pub mod newton;
pub mod norms;
pub mod outcome;
pub mod painting;
pub mod plan;
pub mod problem;
pub mod repetition;
pub mod report;
pub mod resolved;
pub mod rigid;
pub mod section;
pub mod solid;
pub mod stabilisation;
pub mod state;
pub mod warning;
