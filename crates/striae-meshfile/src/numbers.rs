//! Numbers that a file gives to the nodes and elements of a mesh.

use striae_mesh::{ElementId, NodeId};

/// Number of bits of the numbers of a part of an Abaqus file with several instances; the bits above
/// hold the index of the instance.
pub(super) const NUMBER_BITS: u32 = 40;

/// The file's own numbers of what is read.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Numbers {
    pub(super) nodes: Vec<u64>,
    /// Parts of a divided element have its number.
    pub(super) elements: Vec<u64>,
    /// Instances of an Abaqus file that has several.
    pub(super) instances: Vec<String>,
}

impl Numbers {
    /// Number of a node in the file: `instance.number` if it has several instances.
    pub fn node(&self, node: NodeId) -> String {
        named(&self.instances, self.nodes[node.index()])
    }

    /// Number of an element in the file, or of the element that it was divided from.
    pub fn element(&self, element: ElementId) -> String {
        named(&self.instances, self.elements[element.index()])
    }
}

/// A number, with the name of its instance if there are several.
pub(super) fn named(instances: &[String], number: u64) -> String {
    match instances.get((number >> NUMBER_BITS) as usize) {
        Some(instance) => format!("{instance}.{}", number & ((1 << NUMBER_BITS) - 1)),
        None => number.to_string(),
    }
}
