//! The tables of a deck as written: every key, its form and its meaning.
//!
//! A value that could not be read is `None`; its faults have been noted.
//! The first line of a table's documentation and the documentation of its keys
//! are what the JSON schema and the reference show.

mod body;
mod contact;
mod fibres;
mod material;
mod mesh;
mod sets;
mod settings;
mod step;
mod texture;

use super::{declare::table, read::At};
pub(crate) use {
    body::*, contact::*, fibres::*, material::*, mesh::*, sets::*, settings::*, step::*, texture::*,
};

use super::value::Text;

table! {
    /// A whole simulation. All quantities are in one consistent system of units of your choice.
    Simulation {
        /// One line that says what is simulated.
        required title: Text,
        /// Bulk materials.
        optional material: Vec<At<Material>>,
        /// Deformable bodies.
        optional body: Vec<At<Body>>,
        /// Rigid surfaces.
        optional rigid: Vec<At<Rigid>>,
        /// Pairs of surfaces that may touch.
        optional pair: Vec<At<Pair>>,
        /// Surfaces of bodies that are glued.
        optional tie: Vec<At<BodyTie>>,
        /// Curves along which conditions change.
        optional curve: Vec<At<NamedCurve>>,
        /// Parts of the loading history, in the order in which they are run.
        optional step: Vec<At<Step>>,
        /// What is written.
        optional output: OutputSettings,
        /// Newton's method and the linear solver.
        optional solver: SolverSettings,
    }
}
