//! State of contact between increments.

use serde::{Deserialize, Serialize};
use striae_mesh::Vec3;

use super::contact::Contact;
use crate::{pair_state::PairState, placement::Placement};

/// Contact at the end of an increment: where everything is, and the tractions. It can be stored.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct State {
    /// Positions of all nodes.
    pub(super) positions: Vec<Vec3>,
    /// Placements of the rigid sides, by pair; at rest for deformable ones.
    pub(super) placements: Vec<Placement>,
    /// State of every pair.
    pub(super) pairs: Vec<PairState>,
    /// Sum of the durations of the increments, as far as they have one.
    pub(super) time: f64,
    /// Checksum of the surfaces that it is a state of.
    pub(super) checksum: u32,
}

impl Contact {
    /// Contact that has not begun, in the reference configuration.
    pub fn untouched(&self) -> State {
        let members = self.members().iter();
        State {
            positions: self.reference().to_vec(),
            placements: vec![Placement::at_rest(); self.pair_count()],
            pairs: members.map(|of| PairState::untouched(&of.pair)).collect(),
            time: 0.0,
            checksum: self.checksum(),
        }
    }
}

impl State {
    /// Positions of all nodes.
    pub fn positions(&self) -> &[Vec3] {
        &self.positions
    }

    /// State of every pair.
    pub fn pairs(&self) -> &[PairState] {
        &self.pairs
    }

    /// Placements of the rigid sides, by pair.
    pub fn placements(&self) -> &[Placement] {
        &self.placements
    }

    /// Returns whether it is a state of these surfaces.
    pub(super) fn fits(&self, contact: &Contact) -> bool {
        let pairs = contact.members().iter();
        self.checksum == contact.checksum()
            && self.positions.len() == contact.node_count()
            && self.placements.len() == contact.pair_count()
            && self.pairs.len() == contact.pair_count()
            && self.pairs.iter().zip(pairs).all(|(state, member)| {
                let counts = member.pair.carriers();
                let tractions = &state.tractions;
                let lengths = [
                    state.kept.each_ref().map(Vec::len),
                    state.carried.each_ref().map(Vec::len),
                    state.nodes.each_ref().map(Vec::len),
                    tractions.nodes.each_ref().map(Vec::len),
                    tractions.accumulated.each_ref().map(Vec::len),
                    tractions.states.each_ref().map(Vec::len),
                ];
                lengths.iter().all(|found| *found == counts)
            })
    }
}
