//! Friction that follows that of neighbours.
//!
//! If displacements hold the nodes of the finer side along a unit vector `c`, the positions of the
//! coarser side alone respond to friction along it, and tractions outnumber them, as they do where
//! faces of several pairs share nodes. The law and the slip of every node are known all the same.
//! Among the many distributions of friction that have the same effect, a compliance of the kind of the
//! [ramp](crate::ramp) selects the smoothest one. With the positions `J` that respond along `c` and the
//! nodes `l` that keep it,
//!
//! ```text
//! M_kl = sum_J D_kJ (D_lJ/sum_l' D_l'J) / sum_J D_kJ,   R_k = e_k - M_k
//! E += sum over following k of C_F l_k w_k R_k^T R_k
//! ```
//!
//! Without such nodes `R_k = e_k`. `E` vanishes on constant friction.

use std::collections::BTreeMap;

use striae_mesh::Vec3;

use crate::{
    moved_pair::{Actions, MovedPair},
    traction_basis::Weak,
};

/// `C_F`.
const COMPLIANCE: f64 = 0.1;

/// Nodes whose friction follows that of others.
pub(super) struct Following<'a> {
    moved: &'a MovedPair<'a>,
    actions: &'a [Actions],
    /// The nodes, with the direction that they lack.
    nodes: BTreeMap<usize, Vec3>,
}

impl<'a> Following<'a> {
    /// Starts without any.
    pub(super) fn new(moved: &'a MovedPair<'a>, actions: &'a [Actions]) -> Self {
        Self {
            moved,
            actions,
            nodes: BTreeMap::new(),
        }
    }

    /// Adds a node that lacks the direction of a unit vector.
    pub(super) fn add(&mut self, k: usize, c: Vec3) {
        self.nodes.insert(k, c);
    }

    /// Their rows.
    pub(super) fn rows(self) -> Vec<Weak> {
        if self.nodes.is_empty() {
            return Vec::new();
        }
        let mut on_mover: BTreeMap<u32, Vec<(usize, f64)>> = BTreeMap::new();
        for (l, actions) in self.actions.iter().enumerate() {
            if !self.nodes.contains_key(&l) {
                for (number, mass) in actions.masses() {
                    on_mover.entry(number).or_default().push((l, mass));
                }
            }
        }
        let nodes = self.nodes.iter();
        nodes
            .map(|(&k, c)| self.row(k, self.neighbours(k, c, &on_mover)))
            .collect()
    }

    /// `M_k`.
    fn neighbours(
        &self,
        k: usize,
        c: &Vec3,
        on_mover: &BTreeMap<u32, Vec<(usize, f64)>>,
    ) -> BTreeMap<usize, f64> {
        let mut shares: BTreeMap<usize, f64> = BTreeMap::new();
        for (number, mass) in self.actions[k].responding(*c) {
            let others = on_mover.get(&number).map_or(&[][..], Vec::as_slice);
            let sum: f64 = others.iter().map(|(_, other)| other).sum();
            for (l, other) in others {
                *shares.entry(*l).or_default() += mass * other / sum;
            }
        }
        let sum: f64 = shares.values().sum();
        shares.values_mut().for_each(|share| *share /= sum);
        shares
    }

    fn row(&self, k: usize, neighbours: BTreeMap<usize, f64>) -> Weak {
        let basis = &self.moved.selection.basis;
        let mut row: Vec<(u32, f64)> = neighbours
            .into_iter()
            .map(|(l, share)| (l as u32, -share))
            .collect();
        row.push((k as u32, 1.0));
        row.sort_by_key(|&(l, _)| l);
        let side = |l: u32| basis.kept[l as usize].side;
        // Friction of nodes that face each other has opposite signs.
        let facing = |&(l, share): &(u32, f64)| match side(l) == side(k as u32) {
            true => (l, share),
            false => (l, -share),
        };
        Weak {
            kept: k as u32,
            coefficient: COMPLIANCE * basis.flexibility[k] * basis.weights[k],
            friction_row: row.iter().map(facing).collect(),
            row,
        }
    }
}
