//! Contact nodes that keep changing their status.

use striae_contact::{evaluation::Evaluation, selection::Selection, side::Side, unknowns::Status};
use striae_surface::node::SurfaceNode;

use crate::{outcome::CyclingNode, problem::Problem};

/// Iterations that are looked back at.
pub(super) const WINDOW: usize = 6;

/// Contact in every iteration.
#[derive(Default)]
pub(super) struct History {
    /// Status of all nodes, by pair and side.
    statuses: Vec<Vec<[Vec<Status>; 2]>>,
    /// [`Evaluation::topology`] by pair.
    topologies: Vec<Vec<u64>>,
}

impl History {
    pub(super) fn push(&mut self, contacts: &[Evaluation]) {
        let statuses = |evaluation: &Evaluation| {
            evaluation
                .nodes
                .each_ref()
                .map(|side| side.iter().map(|node| node.status).collect())
        };
        self.statuses.push(contacts.iter().map(statuses).collect());
        let topologies = contacts.iter().map(|evaluation| evaluation.topology);
        self.topologies.push(topologies.collect());
    }

    /// Returns whether the last correction led back to the polygons that contact had two
    /// corrections ago.
    pub(super) fn goes_back_and_forth(&self) -> bool {
        let last = &self.topologies[self.topologies.len().saturating_sub(WINDOW)..];
        match last {
            // A change that never occurred before is progress, not a cycle.
            [earlier @ .., before, now] => before != now && earlier.contains(now),
            _ => false,
        }
    }

    /// Kept nodes whose status changed within the last iterations.
    pub(super) fn cycling(&self, problem: &Problem, selections: &[Selection]) -> Vec<CyclingNode> {
        let last = &self.statuses[self.statuses.len().saturating_sub(WINDOW)..];
        let mut cycling = Vec::new();
        for (pair, selection) in selections.iter().enumerate() {
            for side in Side::BOTH {
                for node in SurfaceNode::all(selection.nodes(side)) {
                    let statuses: Vec<Status> = last
                        .iter()
                        .map(|contacts| contacts[pair][side][node])
                        .collect();
                    let changes = statuses.windows(2).any(|pair| pair[0] != pair[1]);
                    let kept = selection.is_kept(side, node);
                    if let Some(global) = problem.surface_node(pair, side, node)
                        && kept
                        && changes
                    {
                        let (body, node) = problem.named_node(global);
                        cycling.push(CyclingNode {
                            pair: problem.model.pairs[pair].name.clone(),
                            body: problem.model.bodies[body].name.clone(),
                            node,
                            history: statuses.iter().map(letter).collect(),
                        });
                    }
                }
            }
        }
        cycling
    }
}

fn letter(status: &Status) -> char {
    match status {
        Status::Open => 'o',
        Status::Stick => 's',
        Status::Slip => 'S',
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn polygons_go_back_and_forth_where_the_last_but_one_differ_and_earlier_ones_return() {
        let history = |topologies: &[u64]| History {
            topologies: topologies.iter().map(|&t| vec![7, t]).collect(),
            ..History::default()
        };
        let back_and_forth = |topologies: &[u64]| history(topologies).goes_back_and_forth();
        assert!(back_and_forth(&[1, 2, 1]));
        assert!(back_and_forth(&[1, 2, 3, 1]));
        assert!(!back_and_forth(&[1, 2, 1, 1]), "they rest");
        assert!(!back_and_forth(&[1, 2, 3]), "they are new");
        assert!(!back_and_forth(&[1, 2, 2, 2, 2, 2, 1]), "it is long ago");
        assert!(!back_and_forth(&[1]), "nothing was before");
    }
}
