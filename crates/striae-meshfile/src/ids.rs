//! Ids by the numbers of a file.

use super::numbers;
use std::collections::{BTreeMap, HashMap};
use striae_mesh::{ElementId, NodeId};

/// New ids of the nodes and elements of a file by their numbers.
pub(super) struct Ids {
    pub(super) nodes: BTreeMap<u64, NodeId>,
    /// An element, or all parts of one that is divided.
    pub(super) elements: HashMap<u64, Vec<ElementId>>,
    /// The instances whose numbers are raised.
    pub(super) instances: Vec<String>,
}

impl Ids {
    /// A number as the file writes it.
    pub(super) fn named(&self, number: u64) -> String {
        numbers::named(&self.instances, number)
    }
}
