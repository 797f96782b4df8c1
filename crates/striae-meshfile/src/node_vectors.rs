//! Vectors at nodes, by the numbers of the nodes.

use super::lines::{Lines, parsed};
use super::{MeshFileFault, Place};
use std::collections::BTreeMap;
use striae_mesh::Vec3;

/// Vectors at some nodes, by the numbers that files give to nodes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct NodeVectors(BTreeMap<u64, Vec3>);

impl NodeVectors {
    /// The vectors of the nodes with these numbers, in their order.
    ///
    /// # Errors
    /// [`MeshFileFault::NoVector`] for the first node that has none.
    pub fn of_nodes(
        &self,
        numbers: impl IntoIterator<Item = u64>,
    ) -> Result<Vec<Vec3>, MeshFileFault> {
        let vector = |number| {
            let vector = self.0.get(&number).copied();
            vector.ok_or(MeshFileFault::NoVector { number })
        };
        numbers.into_iter().map(vector).collect()
    }

    /// Adds the vector of a node that has none yet.
    pub(super) fn add(
        &mut self,
        place: Place,
        number: u64,
        vector: Vec3,
    ) -> Result<(), MeshFileFault> {
        if let Some(wrong) = vector.iter().find(|component| !component.is_finite()) {
            let found = format!("{wrong} at node {number}");
            return Err(MeshFileFault::at(place, "a finite component", found));
        }
        match self.0.insert(number, vector) {
            None => Ok(()),
            Some(_) => {
                let found = format!("node {number} for the second time");
                Err(MeshFileFault::at(place, "a new node number", found))
            }
        }
    }
}

/// A line `node,x,y,z`, and a node a line below it.
pub(super) fn list(text: &str) -> Result<NodeVectors, MeshFileFault> {
    const HEAD: &str = "node,x,y,z";
    let mut lines = Lines::new(text);
    let head = lines.expect(HEAD)?;
    if head.text.replace(' ', "") != HEAD {
        return Err(head.fault(HEAD));
    }
    let mut vectors = NodeVectors::default();
    while let Some(line) = lines.next() {
        let words: Vec<&str> = line.text.split(',').map(str::trim).collect();
        let [node, x, y, z] = words[..] else {
            return Err(line.fault("a node number and three components"));
        };
        let number = parsed(line.number, node, "a node number")?;
        let component = |word| parsed::<f64>(line.number, word, "a component");
        let vector = Vec3::new(component(x)?, component(y)?, component(z)?);
        vectors.add(Place::Line(line.number), number, vector)?;
    }
    Ok(vectors)
}
