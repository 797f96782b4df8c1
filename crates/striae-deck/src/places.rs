//! Named parts of a deck, and where they are written.

use std::collections::BTreeMap;

use crate::faults::Location;

/// Kinds of parts that have names.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Part {
    /// A body.
    Body,
    /// A rigid body.
    Rigid,
    /// A contact pair.
    Pair,
    /// A tie.
    Tie,
    /// Springs.
    Spring,
    /// A cavity.
    Cavity,
    /// A step.
    Step,
}

/// Locations of the named parts of a deck.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Places(BTreeMap<(Part, String), Location>);

impl Places {
    pub(crate) fn new(all: impl Iterator<Item = (Part, String, Location)>) -> Self {
        Self(all.map(|(part, name, at)| ((part, name), at)).collect())
    }

    /// Location of a part of that name, the first kind first.
    pub fn of(&self, kinds: &[Part], name: &str) -> Option<&Location> {
        let mut kinds = kinds.iter();
        kinds.find_map(|part| self.0.get(&(*part, name.to_owned())))
    }
}
