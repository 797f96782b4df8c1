//! Numbers of the nodes of a surface.

use std::{
    fmt,
    ops::{Index, IndexMut},
};

use serde::{Deserialize, Serialize};

/// A node of one surface. Lists with an entry for every node of the surface are indexed by it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub struct SurfaceNode(pub u32);

impl SurfaceNode {
    /// The node at position `index`.
    pub fn new(index: usize) -> Self {
        Self(u32::try_from(index).expect("more than 2^32 nodes on a surface"))
    }

    /// Its position in lists of nodes.
    pub fn index(self) -> usize {
        self.0 as usize
    }

    /// The nodes of a surface that has so many.
    pub fn all(count: usize) -> impl DoubleEndedIterator<Item = Self> + ExactSizeIterator + Clone {
        (0..count).map(Self::new)
    }
}

impl fmt::Display for SurfaceNode {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "surface node {}", self.0)
    }
}

impl<T> Index<SurfaceNode> for [T] {
    type Output = T;

    fn index(&self, node: SurfaceNode) -> &T {
        &self[node.index()]
    }
}

impl<T> IndexMut<SurfaceNode> for [T] {
    fn index_mut(&mut self, node: SurfaceNode) -> &mut T {
        &mut self[node.index()]
    }
}

impl<T> Index<SurfaceNode> for Vec<T> {
    type Output = T;

    fn index(&self, node: SurfaceNode) -> &T {
        &self[node.index()]
    }
}

impl<T> IndexMut<SurfaceNode> for Vec<T> {
    fn index_mut(&mut self, node: SurfaceNode) -> &mut T {
        &mut self[node.index()]
    }
}
