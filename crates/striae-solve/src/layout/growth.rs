//! Growth of the pattern of contact, the same on all ranks.

use std::collections::BTreeSet;

use striae_condensed::Growth;
use striae_sparse::Supervariable;

use super::Layout;
use crate::problem::Problem;
use striae_model::node::GlobalNode;

/// By what the patterns of all ranks have grown together, in this rank's numbers; collective.
///
/// Each rank adds contact rows of its own nodes to a pattern of its own elements. What one
/// has no place for may have one on others, which grow along: so they keep the same
/// supervariables, and all know that the pattern is a new one.
pub(crate) fn united(problem: &Problem, layout: &Layout, growth: Growth) -> Growth {
    let share = &problem.share;
    if share.is_alone() || !share.any(!growth.is_empty()) {
        return growth;
    }
    let places = Places::new(problem, layout);
    let mut bytes = Vec::new();
    for clique in growth {
        bytes.extend((clique.len() as u64).to_le_bytes());
        for supervariable in clique {
            bytes.extend((places.whole(supervariable) as u64).to_le_bytes());
        }
    }
    let mut cliques = BTreeSet::new();
    for bytes in share.team().gather(&bytes) {
        let mut numbers = bytes.chunks_exact(8).map(|bytes| {
            let bytes = bytes.try_into().expect("chunks have this size");
            u64::from_le_bytes(bytes) as usize
        });
        while let Some(count) = numbers.next() {
            cliques.insert(numbers.by_ref().take(count).collect::<Vec<usize>>());
        }
    }
    let local = |clique: Vec<usize>| {
        let clique = clique.into_iter().filter_map(|at| places.local(at));
        clique.collect::<Vec<Supervariable>>()
    };
    cliques.into_iter().map(local).collect()
}

/// Supervariables of a rank and of the whole: nodes, then rigid bodies.
struct Places<'a> {
    problem: &'a Problem,
    layout: &'a Layout,
    nodes: usize,
    /// Number of nodes of the whole problem.
    whole_nodes: usize,
}

impl<'a> Places<'a> {
    fn new(problem: &'a Problem, layout: &'a Layout) -> Self {
        Self {
            problem,
            layout,
            nodes: problem.reference.len(),
            whole_nodes: problem.share.whole_node_count(problem.reference.len()),
        }
    }

    fn whole(&self, Supervariable(at): Supervariable) -> usize {
        let share = &self.problem.share;
        if at < self.nodes {
            return share.whole_node(GlobalNode(at)).0;
        }
        let is_it = |rigid: &usize| self.layout.body(*rigid) == Some(Supervariable(at));
        let rigid = (0..self.problem.tied.len()).find(is_it);
        self.whole_nodes + rigid.expect("what is no node is a rigid body")
    }

    fn local(&self, whole: usize) -> Option<Supervariable> {
        match whole.checked_sub(self.whole_nodes) {
            Some(rigid) => self.layout.body(rigid),
            None => {
                let local = self.problem.share.local_node(GlobalNode(whole));
                local.map(|node| self.layout.supervariable(node))
            }
        }
    }
}
