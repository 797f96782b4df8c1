//! `[[material]]`.

use super::{super::declare::table, Fibres};
use crate::{
    law::Stated,
    read::At,
    value::{Positive, Text},
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
        include law: Stated<striae_law::bulk::Material>,
    }
}
