//! Prescribed displacements of the nodes of ties, and what they leave to each side.

use striae_contact::side::Side;

use super::{TieFault, rows::Sides};
use crate::{model::Model, node::GlobalNode};

/// Share of the tied area that is round-off.
const ROUND_OFF: f64 = 1e-6;

/// Restraint of each component of each node.
pub(super) struct Bound {
    /// By component, three a node.
    prescribed: Vec<bool>,
}

impl Bound {
    pub(super) fn new(model: &Model, first_node: &[usize]) -> Self {
        let mut prescribed = vec![false; 3 * first_node[model.bodies.len()]];
        for condition in model.steps.iter().flat_map(|step| &step.displacements) {
            for node in &condition.nodes {
                let first = 3 * (first_node[condition.body.0] + node.index());
                if !condition.axes.are_global() {
                    prescribed[first..first + 3].fill(true);
                }
                for axis in (0..3).filter(|&axis| condition.components[axis].is_some()) {
                    prescribed[first + axis] = true;
                }
            }
        }
        for (body, nodes) in model.rigid_surfaces.iter().flat_map(|rigid| &rigid.ties) {
            for node in nodes {
                let first = 3 * (first_node[body.0] + node.index());
                prescribed[first..first + 3].fill(true);
            }
        }
        Self { prescribed }
    }

    pub(super) fn component(&self, node: GlobalNode, axis: usize) -> bool {
        self.prescribed[node.component(axis)]
    }

    pub(super) fn wholly(&self, node: GlobalNode) -> bool {
        (0..3).all(|axis| self.component(node, axis))
    }
}

impl Sides {
    /// Makes the other side the one that follows where fewer of the tied areas are lost then;
    /// returns a fault where some still are.
    pub(super) fn turn(&mut self, tie: &str, bound: &Bound) -> Option<TieFault> {
        let other = self.follows.opposite();
        let [own, opposite] = [self.follows, other].map(|side| self.lost(side, bound));
        let none_follows = self.candidates(self.follows, bound).is_empty();
        let (axis, share) = if none_follows || worst(&own).1 > worst(&opposite).1 {
            self.follows = other;
            worst(&opposite)
        } else {
            worst(&own)
        };
        (share > ROUND_OFF).then(|| TieFault::Prescribed {
            tie: tie.to_owned(),
            axis: ["x", "y", "z"][axis],
            share,
        })
    }

    /// Shares of the tied area, by component, that a side could not tie: no corner of its facets
    /// may follow, while nodes opposite are not prescribed.
    fn lost(&self, side: Side, bound: &Bound) -> [f64; 3] {
        let share = |axis: usize| {
            let facets = self.facets[side].iter().filter(|facet| {
                let mut corners = facet.corners.iter();
                corners.all(|&corner| bound.component(self.own(side, corner), axis))
            });
            let free = facets
                .flat_map(|facet| &facet.opposite)
                .filter(|(node, _)| {
                    let opposite = self.own(side.opposite(), **node);
                    !bound.component(opposite, axis)
                });
            let area: f64 = free.map(|(_, row)| row.iter().sum::<f64>()).sum();
            area / self.joined.area()
        };
        [0, 1, 2].map(share)
    }
}

/// Component with the largest share, and the share.
fn worst(shares: &[f64; 3]) -> (usize, f64) {
    let first = (0, shares[0]);
    let others = shares.iter().copied().enumerate();
    others.fold(
        first,
        |most, other| {
            if other.1 > most.1 { other } else { most }
        },
    )
}
