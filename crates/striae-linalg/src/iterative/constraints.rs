//! Rows of the multipliers that constrain positions.
//!
//! In the scaled system the diagonal of the bulk is about one, so that the row `g`
//! of a multiplier yields by `sigma = |g|^2` to a unit force. Where the row's own
//! entries of multipliers are small beside what its positions do to it, it is a
//! constraint, and `s g^T g` with `s = STIFFENING / sigma` is added to the bulk: on
//! vectors that satisfy the constraint nothing changes, bodies held by contact alone
//! become definite, and `g A^-1 g^T` is near `1/s` whatever the mesh.

use super::{NONE, Scaled};
use rayon::prelude::*;

/// Stiffness that is added in the direction of a constraint, over that of the bulk there.
const STIFFENING: f64 = 6.0;
/// Part of the bulk's compliance that counts beside that of the added stiffness.
const COMPLIANCE: f64 = 0.5;
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

    /// The node with the largest entries.
    pub(crate) fn foremost(&self) -> (u32, [f64; 3]) {
        let square = |e: &(u32, [f64; 3])| e.1.iter().map(|a| a * a).sum::<f64>();
        let mut best = self.entries[0];
        for entry in &self.entries {
            if square(entry) > square(&best) {
                best = *entry;
            }
        }
        best
    }

    /// About `g A^-1 g^T` with the stiffened bulk `A`.
    pub(crate) fn compliance(&self) -> f64 {
        STIFFENING / self.stiffness / (STIFFENING + COMPLIANCE)
    }
}
