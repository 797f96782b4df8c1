//! Couplings of all but contact: the pattern of the bodies.

use striae_condensed::Growth;
use striae_sparse::Supervariable;

use crate::{layout::Layout, problem::Problem};
use striae_model::node::GlobalNode;

/// Supervariables that are coupled by all but contact.
pub(super) struct Pattern {
    /// Cliques of the bulk.
    pub(super) cliques: Vec<Vec<Supervariable>>,
    /// Cliques with rigid bodies and pressures in cavities, which are no bulk.
    pub(super) tied: Growth,
}

impl Pattern {
    /// Couplings of elements, springs and cavities; collective.
    pub(super) fn new(problem: &Problem, layout: &Layout) -> Self {
        let mut pattern = Self {
            cliques: Vec::new(),
            tied: Growth::default(),
        };
        for (body, model) in problem.model.bodies.iter().enumerate() {
            for corners in model.mesh.elements() {
                pattern.couple(problem, layout, &problem.nodes(body, corners));
            }
        }
        for link in &problem.links {
            let ends: Vec<GlobalNode> = std::iter::once(link.a).chain(link.second()).collect();
            pattern.couple(problem, layout, &ends);
        }
        for (cavity, surface) in problem.cavities.iter().enumerate() {
            for corners in &surface.faces {
                let mut clique = owners(problem, layout, &problem.ties.behind(corners));
                clique.push(layout.pressure(cavity));
                pattern.tied.extend([clique]);
            }
        }
        let each = (0..layout.offsets().len() - 1).map(|at| vec![Supervariable(at)]);
        pattern.cliques.extend(each);
        let elsewhere = tied_elsewhere(problem, &pattern.tied);
        pattern.tied.extend(elsewhere);
        pattern
    }

    /// Couples nodes. At tied nodes the others are coupled with the rigid body, which is no bulk.
    fn couple(&mut self, problem: &Problem, layout: &Layout, nodes: &[GlobalNode]) {
        let nodes = problem.ties.behind(nodes);
        let is_free = |node: &&GlobalNode| problem.tie_of[**node].is_none();
        let free = nodes.iter().filter(is_free);
        let free: Vec<Supervariable> = free.map(|&node| layout.supervariable(node)).collect();
        if free.len() < nodes.len() {
            self.tied.extend([owners(problem, layout, &nodes)]);
        }
        self.cliques.push(free);
    }
}

/// Supervariables of the positions of nodes.
fn owners(problem: &Problem, layout: &Layout, nodes: &[GlobalNode]) -> Vec<Supervariable> {
    let owners = nodes.iter().map(|&node| layout.owner(problem, node));
    let mut owners: Vec<Supervariable> = owners.collect();
    owners.sort_unstable();
    owners.dedup();
    owners
}

/// Nodes that elements of other ranks couple with a rigid body, each on its own: a node is kept
/// by all ranks that hold it. Collective.
fn tied_elsewhere(problem: &Problem, tied: &Growth) -> Vec<Vec<Supervariable>> {
    let share = &problem.share;
    let is_tied = problem.tied.iter().any(|nodes| !nodes.is_empty());
    if share.is_alone() || !is_tied {
        return Vec::new();
    }
    let mut own = vec![false; problem.reference.len()];
    for Supervariable(at) in tied.clone().into_iter().flatten() {
        if let Some(own) = own.get_mut(at) {
            *own = true;
        }
    }
    let all = share.any_at_nodes(&own).into_iter().enumerate();
    let tied = all.filter(|(_, is_tied)| *is_tied);
    tied.map(|(at, _)| vec![Supervariable(at)]).collect()
}
