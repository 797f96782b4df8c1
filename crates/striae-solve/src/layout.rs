//! Global numbering of the unknowns.
//!
//! The supervariable of a node consists of its three position components and three traction
//! unknowns for every contact surface it is active on, so that the factorisation treats gap rows
//! and their multipliers together. The six coordinates of a rigid body that nodes are tied to or
//! that contact may move form another one, as does the pressure in a cavity; these are eliminated last. The unknowns of a share in the whole
//! system are described in `layout/shared.rs`.

mod growth;
mod shared;

use serde::{Deserialize, Serialize};
use striae_contact::{selection::Selection, side::Side, unknown::Unknown};
use striae_sparse::{Supervariable, Tier};
use striae_surface::node::SurfaceNode;

use crate::problem::Problem;
pub(crate) use growth::united;
use striae_model::node::GlobalNode;

/// Surface nodes with traction unknowns.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Extent {
    /// By pair and side.
    pub nodes: Vec<[Vec<bool>; 2]>,
}

/// Numbers of all unknowns.
#[derive(Clone, Debug)]
pub struct Layout {
    offsets: Vec<usize>,
    nodes: usize,
    /// First traction unknown by pair, side and surface node.
    tractions: Vec<[Vec<Option<usize>>; 2]>,
    /// Supervariable of every rigid body whose coordinates are unknowns.
    rigids: Vec<Option<usize>>,
    /// Supervariable of the first cavity; those of the others follow.
    cavities: usize,
    extent: Extent,
}

impl Extent {
    /// Union of this extent and the kept nodes of all pairs.
    pub fn with(&self, selections: &[Selection]) -> Self {
        let mut grown = self.clone();
        grown.nodes.resize_with(selections.len(), Default::default);
        for (of_pair, selection) in grown.nodes.iter_mut().zip(selections) {
            for (side, of_side) in Side::BOTH.into_iter().zip(of_pair.iter_mut()) {
                of_side.resize(selection.nodes(side), false);
            }
            for kept in selection.kept() {
                let (side, node) = kept.place();
                of_pair[side][node] = true;
            }
        }
        grown
    }

    /// Union of this extent and another one of the same problem.
    #[must_use]
    pub(crate) fn or(mut self, other: &Self) -> Self {
        self.nodes.resize_with(other.nodes.len(), Default::default);
        let sides = self.nodes.iter_mut().flatten();
        for (own, other) in sides.zip(other.nodes.iter().flatten()) {
            own.resize(other.len(), false);
            own.iter_mut()
                .zip(other)
                .for_each(|(own, other)| *own |= other);
        }
        self
    }
}

impl Layout {
    /// The layout with traction unknowns for `extent`.
    pub fn new(problem: &Problem, extent: Extent) -> Self {
        let nodes = problem.reference.len();
        let mut sizes = vec![3; nodes];
        let mut local = Vec::with_capacity(extent.nodes.len());
        for (pair, sides) in extent.nodes.iter().enumerate() {
            local.push(Side::BOTH.map(|side| {
                let active = sides[side].iter().enumerate();
                active
                    .map(|(node, active)| {
                        let node = problem.surface_node(pair, side, SurfaceNode::new(node))?;
                        active.then(|| {
                            sizes[node] += 3;
                            (node, sizes[node] - 3)
                        })
                    })
                    .collect::<Vec<_>>()
            }));
        }
        let rigids = (0..problem.tied.len()).map(|rigid| {
            problem.has_coordinates(rigid).then(|| {
                sizes.push(6);
                sizes.len() - 1
            })
        });
        let rigids = rigids.collect();
        let cavities = sizes.len();
        sizes.resize(cavities + problem.cavities.len(), 1);
        let mut offsets = vec![0];
        for size in &sizes {
            offsets.push(offsets[offsets.len() - 1] + size);
        }
        let number = |slot: Option<(GlobalNode, usize)>| slot.map(|(node, at)| offsets[node] + at);
        let tractions = local
            .into_iter()
            .map(|sides| sides.map(|side: Vec<_>| side.into_iter().map(number).collect()))
            .collect();
        Self {
            offsets,
            nodes,
            tractions,
            rigids,
            cavities,
            extent,
        }
    }

    /// Nodes with traction unknowns.
    pub fn extent(&self) -> &Extent {
        &self.extent
    }

    /// Offsets of the supervariables.
    pub fn offsets(&self) -> &[usize] {
        &self.offsets
    }

    /// Number of unknowns.
    pub fn unknowns(&self) -> usize {
        self.offsets[self.offsets.len() - 1]
    }

    /// Elimination tiers: rigid bodies last.
    pub fn tiers(&self) -> Vec<Tier> {
        let tier = |at: usize| Tier(u32::from(at >= self.nodes));
        (0..self.offsets.len() - 1).map(tier).collect()
    }

    /// Leading unknowns of every supervariable that elements couple: the positions.
    pub fn bulk(&self) -> Vec<usize> {
        let positions = |at: usize| if at < self.nodes { 3 } else { 0 };
        (0..self.offsets.len() - 1).map(positions).collect()
    }

    /// Reference position of every supervariable; those of rigid bodies have none.
    pub fn points(&self, problem: &Problem) -> Vec<[f64; 3]> {
        let mut points = vec![[0.0; 3]; self.offsets.len() - 1];
        for (point, position) in points.iter_mut().zip(&problem.reference) {
            *point = [position.x, position.y, position.z];
        }
        points
    }

    /// Supervariable of a global node.
    pub fn supervariable(&self, node: GlobalNode) -> Supervariable {
        Supervariable(node.0)
    }

    /// Supervariable of the positions of a global node: that of the rigid body it is tied to.
    pub fn owner(&self, problem: &Problem, node: GlobalNode) -> Supervariable {
        let rigid = problem.tie_of[node].and_then(|rigid| self.rigids[rigid]);
        Supervariable(rigid.unwrap_or(node.0))
    }

    /// Supervariables of the positions of a global node: those of the nodes that it follows.
    pub fn owners(&self, problem: &Problem, node: GlobalNode) -> Vec<Supervariable> {
        let behind = problem.ties.behind(&[node]).into_iter();
        let mut owners: Vec<Supervariable> = behind.map(|node| self.owner(problem, node)).collect();
        owners.sort_unstable();
        owners.dedup();
        owners
    }

    /// Supervariable of a rigid body whose coordinates are unknowns.
    pub fn body(&self, rigid: usize) -> Option<Supervariable> {
        self.rigids[rigid].map(Supervariable)
    }

    /// First unknown of a rigid body, if its coordinates are unknowns.
    pub fn rigid(&self, rigid: usize) -> Option<usize> {
        self.rigids[rigid].map(|supervariable| self.offsets[supervariable])
    }

    /// Supervariable of the pressure in a cavity.
    pub fn pressure(&self, cavity: usize) -> Supervariable {
        Supervariable(self.cavities + cavity)
    }

    /// Unknown that is the pressure in a cavity.
    pub fn cavity(&self, cavity: usize) -> usize {
        self.offsets[self.cavities + cavity]
    }

    /// Cavity of whose pressure an unknown is, if it is of one.
    pub fn cavity_of(&self, unknown: usize) -> Option<usize> {
        unknown.checked_sub(self.offsets[self.cavities])
    }

    /// Returns whether there are pressures of cavities.
    pub fn has_cavities(&self) -> bool {
        self.cavities + 1 < self.offsets.len()
    }

    /// Returns whether no rigid body has coordinates that are unknowns.
    pub fn moves_no_body(&self) -> bool {
        self.rigids.iter().all(Option::is_none)
    }

    /// Returns whether this rank owns a supervariable: that of a node belongs to the owner of the
    /// node, that of a rigid body to the first rank.
    pub fn is_own(&self, problem: &Problem, Supervariable(at): Supervariable) -> bool {
        match at < self.nodes {
            true => problem.share.owns(GlobalNode(at)),
            false => problem.share.owns_bodies(),
        }
    }

    /// First position unknown of a global node.
    pub fn position(&self, node: GlobalNode) -> usize {
        self.offsets[node]
    }

    /// First traction unknown of a surface node, if it has any.
    pub fn traction(&self, pair: usize, side: Side, node: SurfaceNode) -> Option<usize> {
        self.tractions[pair][side]
            .get(node.index())
            .copied()
            .flatten()
    }

    /// Global number of a pair-local unknown and its supervariable.
    pub fn global(
        &self,
        problem: &Problem,
        pair: usize,
        unknown: Unknown,
    ) -> Option<(usize, Supervariable)> {
        match unknown {
            Unknown::Position { side, node, axis } => {
                let node = problem.surface_node(pair, side, node)?;
                Some((self.offsets[node] + axis, self.owner(problem, node)))
            }
            Unknown::Traction {
                side,
                node,
                component,
            } => {
                let first = self.traction(pair, side, node)?;
                let node = problem.surface_node(pair, side, node)?;
                Some((first + component, Supervariable(node.0)))
            }
        }
    }
}
