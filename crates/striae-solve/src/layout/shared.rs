//! Numbers of the unknowns of a share in the system of all ranks.
//!
//! The unknowns that a rank owns stand together, one rank after the other: supervariable by
//! supervariable those of its nodes, in the order of the whole problem, and at the end of those
//! of rank 0 the coordinates of rigid bodies. All ranks know who owns which node that they hold
//! and which nodes bear traction, so that they need not ask each other.

use striae_condensed::Numbering;

use super::Layout;
use crate::{problem::Problem, share::Holding};
use striae_model::node::GlobalNode;

/// Positions of a node.
const POSITIONS: usize = 3;

impl Layout {
    /// Numbers in the whole system of the unknowns of the layout.
    pub fn numbering(&self, problem: &Problem) -> Numbering {
        let count = self.unknowns();
        match problem.share.holding() {
            None => Numbering {
                count,
                own: 0..count,
                whole: (0..count).collect(),
            },
            Some(holding) => self.of_share(holding, problem.share.team().rank()),
        }
    }

    fn of_share(&self, holding: &Holding, rank: usize) -> Numbering {
        let ranks = holding.owned.len();
        let tractions = self.tractions_by_rank(holding);
        let of_bodies = self.offsets[self.offsets.len() - 1] - self.offsets[self.nodes];
        let mut starts = vec![0];
        for (of_rank, (nodes, tractions)) in holding.owned.iter().zip(&tractions).enumerate() {
            let tractions = tractions.last().map_or(0, |(_, sum)| *sum);
            let others = if of_rank == 0 { of_bodies } else { 0 };
            starts.push(starts[of_rank] + POSITIONS * nodes + tractions + others);
        }
        let mut whole = vec![0; self.unknowns()];
        for node in 0..self.nodes {
            let (owner, place) = (holding.owners[node] as usize, holding.places[node]);
            let of_owner = &tractions[owner];
            let before = of_owner.partition_point(|(other, _)| *other < place);
            let before = before.checked_sub(1).map_or(0, |last| of_owner[last].1);
            let first = starts[owner] + POSITIONS * place as usize + before;
            let unknowns = self.offsets[node]..self.offsets[node + 1];
            let numbers = whole[unknowns].iter_mut();
            numbers.zip(first..).for_each(|(own, number)| *own = number);
        }
        let bodies = whole[self.offsets[self.nodes]..].iter_mut();
        let first = starts[1] - of_bodies;
        bodies.zip(first..).for_each(|(own, number)| *own = number);
        Numbering {
            count: starts[ranks],
            own: starts[rank]..starts[rank + 1],
            whole,
        }
    }

    /// Places of nodes that bear traction among those of their owner, and how many traction
    /// unknowns there are up to each with it; by owner. All ranks hold such nodes.
    fn tractions_by_rank(&self, holding: &Holding) -> Vec<Vec<(u32, usize)>> {
        let mut all: Vec<Vec<(u32, usize)>> = vec![Vec::new(); holding.owned.len()];
        for &GlobalNode(node) in &holding.replicated {
            let own = self.offsets[node + 1] - self.offsets[node] - POSITIONS;
            if own > 0 {
                let of_owner = &mut all[holding.owners[node] as usize];
                let before = of_owner.last().map_or(0, |(_, sum)| *sum);
                of_owner.push((holding.places[node], before + own));
            }
        }
        all
    }
}
