//! Areas that belong to the nodes of a tie: what its forces are divided by to give tractions.
//!
//! On a facet that follows, with what it has in common with the other side, and the areas
//! `|A|` of the facet now and `|A_0|` at rest,
//!
//! ```text
//! a_k = |A|/|A_0| int N_k dA_0        for its corners and for the nodes opposite
//! ```
//!
//! As both the functions `N_k` of a side and the dual ones add up to one, forces of a constant
//! traction `t` on nodes are `a_k t` on either side.

use std::collections::BTreeMap;

use striae_contact::tie::FacetRows;
use striae_mesh::Vec3;

use super::Ties;
use crate::node::GlobalNode;

/// Areas of the nodes of a side of a tie, by component: what of it is tied in the component.
pub type NodalAreas = BTreeMap<GlobalNode, [f64; 3]>;

/// Common area of a dependent facet and the other side.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Patch {
    /// Its corners.
    corners: Vec<GlobalNode>,
    /// `int N_k dA_0` by node: of the facet, of the other side.
    areas: [Vec<(GlobalNode, f64)>; 2],
    /// Components in which it is tied.
    tied: [bool; 3],
}

impl Patch {
    /// Patch of the rows of a facet; `global` numbers the nodes of the facet's side and of the
    /// other one, `follows` tells whether a node is dependent in a component.
    pub(super) fn new(
        facet: &FacetRows,
        global: [&[GlobalNode]; 2],
        follows: impl Fn(GlobalNode, usize) -> bool,
    ) -> Self {
        let [own, other] = global;
        let corners = facet.corners.iter().map(|&corner| own[corner]);
        let corners: Vec<GlobalNode> = corners.collect();
        let weights = facet.weights.iter().copied();
        let opposite = facet.opposite.iter();
        let opposite = opposite.map(|(&node, row)| (other[node], row.iter().sum()));
        Self {
            tied: [0, 1, 2].map(|axis| corners.iter().any(|&node| follows(node, axis))),
            areas: [
                corners.iter().copied().zip(weights).collect(),
                opposite.collect(),
            ],
            corners,
        }
    }

    /// Copy with other node numbers.
    pub(super) fn renumbered(self, number: impl Fn(GlobalNode) -> GlobalNode) -> Self {
        let areas = self.areas.map(|of_side| {
            let areas = of_side.into_iter();
            areas.map(|(node, area)| (number(node), area)).collect()
        });
        Self {
            corners: self.corners.into_iter().map(number).collect(),
            areas,
            tied: self.tied,
        }
    }

    /// Area of the facet.
    fn area(&self, positions: &[Vec3]) -> f64 {
        let at = |corner: usize| positions[self.corners[corner]];
        let last = self.corners.len() - 1;
        0.5 * (at(2) - at(0)).cross(&(at(last) - at(1))).norm()
    }
}

impl Ties {
    /// Areas that belong to the nodes of a tie at the given positions, by side.
    pub fn areas(&self, tie: usize, reference: &[Vec3], positions: &[Vec3]) -> [NodalAreas; 2] {
        let joint = &self.joints[tie];
        let mut areas = [NodalAreas::new(), NodalAreas::new()];
        for patch in &joint.patches {
            let stretch = patch.area(positions) / patch.area(reference);
            for (side, of_side) in [joint.follows, joint.follows.opposite()]
                .iter()
                .zip(&patch.areas)
            {
                for (node, area) in of_side {
                    let sum = areas[*side].entry(*node).or_default();
                    for axis in (0..3).filter(|&axis| patch.tied[axis]) {
                        sum[axis] += stretch * area;
                    }
                }
            }
        }
        areas
    }
}
