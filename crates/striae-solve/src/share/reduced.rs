//! Sums and largest values over all ranks, and over those that hold a node.
//!
//! The sum of elements at a node is partial until it is [summed over the
//! ranks](Share::sum_at_nodes) that hold the node. From there on they have identical bits of it,
//! and so of contact, ties and rigid bodies, which follow from it and from replicated data. In sums
//! over nodes each node counts on the rank that owns it, in sums over elements each element is on
//! one rank, and data that all ranks have count once. All functions are collective and leave values
//! unchanged if there is only one rank.

use striae_mesh::Vec3;

use super::{Share, exchange};

impl Share {
    /// Sum over all ranks.
    pub fn sum(&self, own: f64) -> f64 {
        let [sum] = self.sums([own]);
        sum
    }

    /// Sums over all ranks.
    pub fn sums<const N: usize>(&self, mut own: [f64; N]) -> [f64; N] {
        self.team().sum(&mut own);
        own
    }

    /// Sums of vectors over all ranks.
    pub fn sum_vectors(&self, vectors: &mut [Vec3]) {
        if self.is_alone() {
            return;
        }
        let mut values: Vec<f64> = vectors.iter().flat_map(|v| [v.x, v.y, v.z]).collect();
        self.team().sum(&mut values);
        for (vector, values) in vectors.iter_mut().zip(values.chunks_exact(3)) {
            *vector = Vec3::from_column_slice(values);
        }
    }

    /// The largest one of all ranks.
    pub fn largest(&self, mut own: f64) -> f64 {
        self.team().largest(std::slice::from_mut(&mut own));
        own
    }

    /// Returns whether a flag is set on any rank.
    pub fn any(&self, own: impl Into<bool>) -> bool {
        self.largest(f64::from(u8::from(own.into()))) > 0.0
    }

    /// Returns for each of several flags whether it is set on any rank.
    pub fn any_of(&self, own: impl Iterator<Item = bool>) -> Vec<bool> {
        let mut flags: Vec<f64> = own.map(|own| f64::from(u8::from(own))).collect();
        self.team().largest(&mut flags);
        flags.into_iter().map(|flag| flag > 0.0).collect()
    }

    /// Nodes at which something is so on a rank that holds them.
    pub(crate) fn any_at_nodes(&self, own: &[bool]) -> Vec<bool> {
        let flag = |own: &bool| Vec3::ith(0, f64::from(u8::from(*own)));
        let mut flags: Vec<Vec3> = own.iter().map(flag).collect();
        self.sum_at_nodes(&mut [&mut flags]);
        flags.iter().map(|flag| flag.x > 0.0).collect()
    }

    /// Sums over the ranks that hold each node what they have there, field by field, and gives
    /// all of them the same bits.
    pub fn sum_at_nodes(&self, fields: &mut [&mut [Vec3]]) {
        if let Some(holding) = self.holding() {
            exchange::sum(self.team(), holding, fields);
        }
    }
}
