//! Contact nodes that keep changing their status.

use striae_contact::{evaluation::Evaluation, selection::Selection, unknowns::Status};

use crate::{outcome::CyclingNode, problem::Problem};

/// Status of all nodes in every iteration.
#[derive(Default)]
pub(super) struct History(Vec<Vec<[Vec<Status>; 2]>>);

impl History {
    pub(super) fn push(&mut self, contacts: &[Evaluation]) {
        let statuses = |evaluation: &Evaluation| {
            evaluation
                .nodes
                .each_ref()
                .map(|side| side.iter().map(|node| node.status).collect())
        };
        self.0.push(contacts.iter().map(statuses).collect());
    }

    /// Kept nodes whose status changed within the last iterations.
    pub(super) fn cycling(&self, problem: &Problem, selections: &[Selection]) -> Vec<CyclingNode> {
        const WINDOW: usize = 6;
        let last = &self.0[self.0.len().saturating_sub(WINDOW)..];
        let mut cycling = Vec::new();
        for (pair, selection) in selections.iter().enumerate() {
            for side in 0..2 {
                for node in 0..selection.nodes(side) {
                    let statuses: Vec<Status> = last
                        .iter()
                        .map(|contacts| contacts[pair][side][node])
                        .collect();
                    let changes = statuses.windows(2).any(|pair| pair[0] != pair[1]);
                    let kept = selection.is_kept(side, node as u32);
                    if let Some(global) = problem.carrier(pair, side, node as u32)
                        && kept
                        && changes
                    {
                        let (body, node) = problem.body_node(global);
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
