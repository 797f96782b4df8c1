//! States of a factor of friction at the surface nodes of a pair.

use serde::{Deserialize, Serialize};

pub use striae_law::friction::LARGEST_STATE;

use crate::side::Side;

/// States of a factor at the surface nodes of a pair.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FactorStates {
    /// Name of the law.
    pub law: String,
    /// Numbers a node.
    pub count: usize,
    /// States of the nodes, one after the other, by side.
    pub values: [Vec<f64>; 2],
}

impl FactorStates {
    /// A number of the states of all nodes of a side.
    pub fn of(&self, side: Side, at: usize) -> Vec<f64> {
        let values = self.values[side].iter();
        values.skip(at).step_by(self.count).copied().collect()
    }
}
