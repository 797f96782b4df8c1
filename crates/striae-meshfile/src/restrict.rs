//! Parts of files: the elements of a set, and of all sets what is on them.
//!
//! Faces between two parts that share nodes are on the border of each part, so that they are in
//! the sets of facets of both.

use super::collected::{Collected, FileFace, missing};
use super::{MeshFileFault, Place};
use std::collections::{BTreeMap, HashSet};

impl Collected {
    /// Part of the mesh on the elements of a set; without a set, all of it.
    pub(super) fn of_part(self, part: Option<&str>) -> Result<Self, MeshFileFault> {
        match part {
            None => Ok(self),
            Some(name) if self.wholes(name) => Ok(self),
            Some(name) => self.restricted(name),
        }
    }

    /// Returns whether a name refers to all elements.
    fn wholes(&self, name: &str) -> bool {
        let is_set = self.element_sets.contains_key(name);
        !is_set && (name == "all" || self.whole.as_deref() == Some(name))
    }

    fn restricted(mut self, name: &str) -> Result<Self, MeshFileFault> {
        let Some(members) = self.element_sets.get(name) else {
            let known = self.element_sets.keys().chain(&self.whole);
            return Err(MeshFileFault::NoPart {
                name: name.to_owned(),
                known: known.cloned().collect(),
            });
        };
        let all = self.elements.iter().map(|element| element.number);
        let all: HashSet<u64> = all.collect();
        for members in self.element_sets.values() {
            if let Some((place, number)) = members.iter().find(|(_, of)| !all.contains(of)) {
                return Err(missing(*place, "element", &self.named(*number)));
            }
        }
        let chosen: HashSet<u64> = members.iter().map(|(_, number)| *number).collect();
        self.elements
            .retain(|element| chosen.contains(&element.number));
        let corners = self.elements.iter().flat_map(|element| &element.corners);
        let nodes: HashSet<u64> = corners.copied().collect();
        retain(&mut self.element_sets, |number| chosen.contains(number));
        // Nodes that the file lacks stay, to be told.
        let known: HashSet<u64> = self.nodes.keys().copied().collect();
        retain(&mut self.node_sets, |node| {
            nodes.contains(node) || !known.contains(node)
        });
        retain(&mut self.facet_sets, |face| match face {
            FileFace::Side(element, _) | FileFace::Free(element) => {
                chosen.contains(element) || !all.contains(element)
            }
            FileFace::Corners(corners) => corners.iter().all(|node| nodes.contains(node)),
            FileFace::Eight(corners, on) => {
                corners.iter().chain(on).all(|node| nodes.contains(node))
            }
        });
        Ok(self)
    }
}

/// Keeps some members of sets, and no set that loses all.
fn retain<T>(sets: &mut BTreeMap<String, Vec<(Place, T)>>, keep: impl Fn(&T) -> bool) {
    sets.retain(|_, members| {
        members.retain(|(_, member)| keep(member));
        !members.is_empty()
    });
}
