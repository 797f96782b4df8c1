//! The tables of a deck as written: every key, its form and its meaning.
//!
//! Values that could not be read are `None`; their faults have been noted. The JSON schema and the
//! reference show the first line of a table's documentation and the documentation of its keys.

mod actuation;
mod body;
mod cavity;
mod contact;
mod everything;
mod fibres;
mod material;
mod mesh;
mod sets;
mod settings;
mod spring;
mod step;
mod texture;

use super::{declare::table, read::At};
pub(crate) use {
    actuation::*, body::*, cavity::*, contact::*, everything::*, fibres::*, material::*, mesh::*,
    sets::*, settings::*, spring::*, step::*, texture::*,
};

use super::value::{NamedNumbers, OneOrMore, Prose};

table! {
    /// A whole simulation. All quantities are in one consistent system of units of your choice, such that numbers are at most 1e50 in magnitude, and at least 1e-50 where they must be greater than zero.
    Simulation {
        /// Title: the subject of the simulation in one line.
        required title: Prose,
        /// Named numbers. Any number of the deck may be a text such as `"= 2*E/L^2"`, an expression
        /// of them, with `+ - * / ^`, parentheses, `pi`, `sqrt`, `abs`, `exp`, `ln`, `log10`,
        /// `min`, `max`, `round`, `floor`, `ceil` and, in degrees, `sin`, `cos`, `tan`, `asin`,
        /// `acos`, `atan`. `--set NAME=VALUE` on the command line sets one, or another number of
        /// the deck by its path, `--set material.rubber.youngs_modulus=2e6`.
        optional parameters: NamedNumbers,
        /// Files whose contents are treated as part of this one, relative to it: their lists come
        /// first, and where both state a key, this file takes precedence. Paths within them are
        /// relative to the deck.
        optional include: OneOrMore,
        /// Bulk materials.
        optional material: Vec<At<Material>>,
        /// Deformable bodies.
        optional body: Vec<At<Body>>,
        /// Rigid surfaces.
        optional rigid: Vec<At<Rigid>>,
        /// Pairs of surfaces that may touch.
        optional pair: Vec<At<Pair>>,
        /// Contact of every surface with every surface, including itself. Default: only the
        /// surfaces named by a `pair`.
        optional contact: Contact,
        /// Surfaces of bodies that are glued together.
        optional tie: Vec<At<BodyTie>>,
        /// Springs and dashpots.
        optional spring: Vec<At<Spring>>,
        /// Cavities with a pressure inside.
        optional cavity: Vec<At<Cavity>>,
        /// Curves along which conditions change.
        optional curve: Vec<At<NamedCurve>>,
        /// Parts of the loading history, in the order in which they are run.
        optional step: Vec<At<Step>>,
        /// Output of the run.
        optional output: OutputSettings,
        /// Derivatives of the history by numbers of this deck. Such a run is one process, begins
        /// at rest and writes no checkpoints. Default: none.
        optional sensitivity: Sensitivity,
        /// Newton's method and the linear solver.
        optional solver: SolverSettings,
    }
}
