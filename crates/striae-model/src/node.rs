//! Numbers of nodes in a problem.

use std::ops::{Index, IndexMut, Range};

use serde::{Deserialize, Serialize};

/// A node of the whole problem: nodes of one body after the other, then mass points. Lists
/// with an entry for every one of them are indexed by it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[repr(transparent)]
pub struct GlobalNode(pub usize);

impl GlobalNode {
    /// Place of a component in lists of three entries for every node.
    pub fn component(self, axis: usize) -> usize {
        3 * self.0 + axis
    }

    /// Places of all its components in such lists.
    pub fn components(self) -> Range<usize> {
        3 * self.0..3 * self.0 + 3
    }
}

impl<T> Index<GlobalNode> for [T] {
    type Output = T;

    fn index(&self, node: GlobalNode) -> &T {
        &self[node.0]
    }
}

impl<T> IndexMut<GlobalNode> for [T] {
    fn index_mut(&mut self, node: GlobalNode) -> &mut T {
        &mut self[node.0]
    }
}

impl<T> Index<GlobalNode> for Vec<T> {
    type Output = T;

    fn index(&self, node: GlobalNode) -> &T {
        &self[node.0]
    }
}

impl<T> IndexMut<GlobalNode> for Vec<T> {
    fn index_mut(&mut self, node: GlobalNode) -> &mut T {
        &mut self[node.0]
    }
}
