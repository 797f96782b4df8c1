//! Work and wear at the nodes of contact surfaces since the start of a run.
//!
//! Over the increments with the slip `du`, pressure `p` and friction traction `tau`
//!
//! ```text
//! friction work per area sum -tau . du
//! wear depth             k sum p |du|        (Archard 1953, doi:10.1063/1.1721448)
//! ```
//!
//! with pressure and traction at the end of the increment. Open nodes do not slip. Contact knows
//! nothing of this wear depth, an estimate of the first order. Depths that open gaps are part of
//! the state, see `striae_contact::wear`, and so is the accumulated slip.

use serde::{Deserialize, Serialize};
use striae_contact::{side::Side, unknowns::Status};
use striae_solve::state::State;

/// Sums at a node: friction work per area, pressure times slip.
pub type Sums = [f64; 2];

/// Sums at the surface nodes of all pairs, by side.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Worn {
    /// By pair, side and node.
    pub pairs: Vec<[Vec<Sums>; 2]>,
}

impl Worn {
    /// Adds what happened in the increment that led to a state.
    pub fn add(&mut self, state: &State) {
        self.pairs.resize_with(state.pairs.len(), Default::default);
        for (sums, of_pair) in self.pairs.iter_mut().zip(&state.pairs) {
            for (sums, nodes) in sums.iter_mut().zip(&of_pair.nodes) {
                sums.resize(nodes.len(), [0.0; 2]);
                let nodes = sums.iter_mut().zip(nodes);
                for (sums, node) in nodes.filter(|(_, node)| node.status != Status::Open) {
                    let slip = node.slip.norm();
                    sums[0] -= node.tau.dot(&node.slip);
                    sums[1] += node.pressure * slip;
                }
            }
        }
    }

    /// Returns whether something of a pair has slipped under pressure.
    pub fn has_slipped(&self, pair: usize) -> bool {
        let sums = self.pairs.get(pair).into_iter().flatten().flatten();
        sums.into_iter().any(|[_, slip]| *slip > 0.0)
    }

    /// Sums at the nodes of a side, zero before the first increment.
    pub fn of(&self, pair: usize, side: Side, nodes: usize) -> Vec<Sums> {
        let known = self.pairs.get(pair).map(|sides| sides[side].clone());
        let mut sums = known.unwrap_or_default();
        sums.resize(nodes, [0.0; 2]);
        sums
    }
}
