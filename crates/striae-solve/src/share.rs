//! What of a problem a rank holds.
//!
//! The volume is divided: a rank holds its own elements and their nodes. Contact surfaces,
//! tied surfaces, rigid bodies and the nodes tied to them are held by all ranks. Nodes,
//! elements and unknowns have local numbers; a share says which of the whole they are.

use std::sync::Arc;

use crate::{node::GlobalNode, team::Team};

/// What of a problem a rank holds.
#[derive(Clone, Debug)]
pub struct Share {
    /// All ranks.
    pub team: Arc<dyn Team>,
    /// Rank that owns each local node, one of those that hold it.
    pub owners: Vec<u32>,
    /// Number of each local node in the whole problem.
    pub whole_nodes: Vec<usize>,
    /// Nodes of the whole problem.
    pub node_count: usize,
    /// Number in the whole mesh of each local element of each body.
    pub whole_elements: Vec<Vec<usize>>,
    /// Number in the whole mesh of each local node of each body.
    pub whole_mesh_nodes: Vec<Vec<usize>>,
}

impl Share {
    /// Whether this rank owns a node.
    pub fn owns(&self, node: GlobalNode) -> bool {
        self.owners[node.0] as usize == self.team.rank()
    }
}
