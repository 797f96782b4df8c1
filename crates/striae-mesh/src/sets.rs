//! Named sets of nodes, faces or elements.

use serde::Serialize;
use std::collections::BTreeMap;

/// Named sets, each sorted and without repeats.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Sets<T>(BTreeMap<String, Vec<T>>);

impl<T> Default for Sets<T> {
    fn default() -> Self {
        Self(BTreeMap::new())
    }
}

impl<T: Ord + Copy> Sets<T> {
    /// Adds a set, replacing one of the same name.
    pub fn insert(&mut self, name: impl Into<String>, members: impl IntoIterator<Item = T>) {
        let mut members: Vec<T> = members.into_iter().collect();
        members.sort_unstable();
        members.dedup();
        self.0.insert(name.into(), members);
    }

    /// The members of a set, `None` where no set has that name.
    pub fn get(&self, name: &str) -> Option<&[T]> {
        self.0.get(name).map(Vec::as_slice)
    }

    /// The names of all sets in alphabetical order.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.0.keys().map(String::as_str)
    }

    /// Names and members in alphabetical order.
    pub fn iter(&self) -> impl Iterator<Item = (&str, &[T])> {
        self.0
            .iter()
            .map(|(name, members)| (name.as_str(), members.as_slice()))
    }
}
