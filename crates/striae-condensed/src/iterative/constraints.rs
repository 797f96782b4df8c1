//! Rows of the multipliers that constrain positions.
//!
//! In the scaled system the diagonal of the bulk is about one, so that the row `g`
//! of a multiplier yields by `sigma = |g|^2` to a unit force. Where the row's own
//! entries of multipliers are small beside what its positions do to it, it is a
//! constraint, and `s g^T g` with `s = STIFFENING / sigma` is added to the bulk: on
//! vectors that satisfy the constraint nothing changes, bodies held by contact alone
//! become definite.

use super::{NONE, scaled::Scaled};
use rayon::prelude::*;
use striae_sparse::{
    Supervariable,
    aggregation::blocks::{Blocks, invert},
};

/// Stiffness that is added in the direction of a constraint, over that of the bulk there.
const STIFFENING: f64 = 2.0;
/// Largest entry of a multiplier over the largest of positions in a constraint.
const SMALL: f64 = 0.1;

/// A row of the multipliers in which positions dominate.
#[derive(Debug)]
pub(crate) struct Constraint {
    /// The multiplier whose row it is.
    pub(crate) unknown: u32,
    /// Node and entries.
    pub(crate) entries: Vec<(u32, [f64; 3])>,
    /// Stiffness `s` that is added.
    pub(crate) stiffness: f64,
}

impl Constraint {
    /// All constraints among the rows of multipliers.
    pub(crate) fn all(scaled: &Scaled<'_>, multipliers: &[u32]) -> Vec<Self> {
        let found = multipliers.par_iter().with_min_len(64);
        found.filter_map(|&u| Self::of(scaled, u)).collect()
    }

    fn of(scaled: &Scaled<'_>, unknown: u32) -> Option<Self> {
        let mut entries: Vec<(u32, [f64; 3])> = Vec::new();
        let (mut others, mut largest) = (0.0_f64, 0.0_f64);
        for (v, a) in scaled.row(unknown as usize).filter(|e| e.1 != 0.0) {
            let (node, component) = scaled.node(v);
            if node == NONE {
                others = others.max(a.abs());
                continue;
            }
            largest = largest.max(a.abs());
            match entries.last_mut() {
                Some((last, values)) if *last == node => values[component] = a,
                _ => {
                    let mut values = [0.0; 3];
                    values[component] = a;
                    entries.push((node, values));
                }
            }
        }
        let sigma: f64 = entries.iter().flat_map(|e| e.1).map(|a| a * a).sum();
        let dominates = largest > 0.0 && others <= SMALL * largest;
        dominates.then(|| Self {
            unknown,
            entries,
            stiffness: STIFFENING / sigma,
        })
    }
}

impl Scaled<'_> {
    /// Symmetric part of the bulk with the stiffness of the constraints.
    pub(super) fn stiffened(&self, constraints: &[Constraint]) -> Blocks<3, 3, f64> {
        let count = self.nodes.supervariables.len();
        let mut incident = vec![Vec::new(); count];
        for (k, constraint) in constraints.iter().enumerate() {
            for (place, entry) in constraint.entries.iter().enumerate() {
                incident[entry.0 as usize].push((k, place));
            }
        }
        Blocks::from_rows(count, count, |node, sum| {
            self.bulk_row(node, |other, block| {
                let target = sum.block(other).iter_mut();
                target.zip(block).for_each(|(t, b)| *t += b);
            });
            for &(k, place) in &incident[node] {
                let Constraint {
                    entries, stiffness, ..
                } = &constraints[k];
                let own = entries[place].1;
                for (other, values) in entries {
                    let target = sum.block(*other as usize);
                    for r in 0..3 {
                        for c in 0..3 {
                            target[3 * r + c] += stiffness * own[r] * values[c];
                        }
                    }
                }
            }
        })
    }
}

/// Displacements of nodes with multipliers or constraints under forces on them: inverses of
/// the diagonal blocks of the bulk, by rising nodes.
#[derive(Debug)]
pub(crate) struct Compliance(Vec<(u32, [f64; 9])>);

impl Compliance {
    /// Constraints of the bulk without stiffening.
    pub(crate) fn of(scaled: &Scaled<'_>) -> Self {
        let nodes = &scaled.nodes;
        let mut blocks = Vec::new();
        for (node, &i) in nodes.supervariables.iter().enumerate() {
            if nodes.partition.is_kept(Supervariable(i as usize)) {
                let mut own = [0.0; 9];
                scaled.bulk_row(node, |other, block| {
                    if other == node {
                        own.iter_mut().zip(block).for_each(|(own, b)| *own += b);
                    }
                });
                let mut inverse = [0.0; 9];
                invert::<3>(&own, &mut inverse);
                blocks.push((node as u32, inverse));
            }
        }
        Self(blocks)
    }

    /// Displacement of a node under a force, zero for a node without a block.
    pub(crate) fn of_node(&self, node: u32, force: &[f64]) -> [f64; 3] {
        let found = self.0.binary_search_by_key(&node, |entry| entry.0);
        found.map_or([0.0; 3], |at| product(&self.0[at].1, force))
    }

    /// Displacements of all nodes instead of forces on them, which only nodes with a block may
    /// have.
    pub(crate) fn apply(&self, values: &mut [f64]) {
        for (node, block) in &self.0 {
            let own = &mut values[3 * *node as usize..][..3];
            let moved = product(block, own);
            own.copy_from_slice(&moved);
        }
    }
}

fn product(block: &[f64; 9], force: &[f64]) -> [f64; 3] {
    [0, 1, 2].map(|r| (0..3).map(|c| block[3 * r + c] * force[c]).sum())
}
