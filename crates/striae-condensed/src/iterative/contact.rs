//! The multipliers' part of the preconditioner, sparse on the contact surfaces.
//!
//! The Schur complement is `S = G_m - G_x A^-1 C` with `A = K + g^T s g`. With a simple
//! approximation `F` of `K^-1` alone it need not be formed: constraints have `g x = r_g` but for
//! their small entries of multipliers, so that `K x = -C m - g^T s r_g`,
//!
//! ```text
//! S m = r   =>   (G_m - G_x F C) m = r + G_x F g^T s r_g.
//! ```
//!
//! If `C = g^T`, this is `S^-1 = S_K^-1 - s`, `S_K` of `K` alone (Sherman, Morrison, Woodbury):
//! smooth tractions are met by `s`, which is exact. For rough ones `F` has the node-wise diagonal
//! `D` of `K` and motions `z` of [patches](super::patches), `F = D^-1 + sum z z^T / d`; with the
//! sizes `v` of these motions as unknowns
//!
//! ```text
//! [ G_m - G_x D^-1 C   G_x z ] [m]   [r + G_x D^-1 g^T s r_g]
//! [ z^T C              d     ] [v] = [-z^T g^T s r_g        ]
//! ```
//!
//! is factored. Where only constraints couple nodes, and without patches, all of this is
//! exact.

use super::{
    NONE,
    constraints::{Compliance, Constraint},
    patches::{Motion, Surface},
    scaled::Scaled,
    system::{RowSum, assembled},
};
use rayon::prelude::*;
use std::collections::HashMap;
use striae_sparse::{
    LinearSolver, MultifrontalLu, SolveError, Supervariable, sparse_elimination::Row,
};

/// Term added to the diagonal in the row of a constraint.
const SLIGHT: f64 = 1e-4;

/// Couplings with the bulk and factors of what approximates the Schur complement.
#[derive(Debug)]
pub(crate) struct Contact {
    /// By multiplier: entries `(3 node + component, value)` of `G_x`.
    rows: Vec<Row>,
    /// Rows of `C` with entries: `3 node + component` and `(multiplier, value)`.
    forces: Vec<(u32, Row)>,
    /// `s` of the constraints by multiplier, zero for all others.
    stiffness: Vec<f64>,
    /// `D^-1`.
    compliance: Compliance,
    /// Motions `z` of patches.
    motions: Vec<Row>,
    solver: MultifrontalLu,
    entries: usize,
}

impl Contact {
    /// Factors the approximate Schur complement.
    pub(crate) fn factor(
        scaled: &Scaled<'_>,
        constraints: &[Constraint],
        compliance: Compliance,
        surface: &Surface,
    ) -> Result<Self, SolveError> {
        let structure = &scaled.nodes.partition;
        let multipliers = &scaled.nodes.multipliers;
        let mut place = vec![NONE; structure.unknowns()];
        for (k, &u) in multipliers.iter().enumerate() {
            place[u as usize] = k as u32;
        }
        let forces = forces(scaled, &place);
        let mut stiffness = vec![0.0; multipliers.len()];
        for constraint in constraints {
            stiffness[place[constraint.unknown as usize] as usize] = constraint.stiffness;
        }
        let force = |at: u32| -> &[(u32, f64)] {
            let found = forces.binary_search_by_key(&at, |f| f.0);
            found.map_or(&[], |k| &forces[k].1)
        };
        let patches = Motion::all(scaled, surface);
        let unknowns = multipliers.len() + patches.iter().map(Vec::len).sum::<usize>();
        let moved = moved(&patches, multipliers.len());
        let split: Vec<(Row, Row)> = multipliers
            .par_iter()
            .enumerate()
            .with_min_len(64)
            .map_init(
                || RowSum::new(unknowns),
                |sum, (k, &u)| {
                    let (positions, own) = parts(scaled, &place, u as usize);
                    own.iter().for_each(|&(m, a)| sum.add(m, a));
                    for entries in positions.chunk_by(|a, b| a.0 / 3 == b.0 / 3) {
                        let node = entries[0].0 / 3;
                        let mut g = [0.0; 3];
                        entries.iter().for_each(|&(at, a)| g[at as usize % 3] = a);
                        for (component, yielded) in (0..).zip(compliance.of_node(node, &g)) {
                            let row = force(3 * node + component).iter();
                            row.for_each(|&(m, c)| sum.add(m, -yielded * c));
                        }
                    }
                    if stiffness[k] > 0.0 {
                        // Tractions may act on nothing but prescribed unknowns.
                        let is_positive = sum.get(k as u32) > 0.0;
                        sum.add(k as u32, if is_positive { SLIGHT } else { -SLIGHT });
                    }
                    for &(at, g) in &positions {
                        let motions = moved.get(&at).into_iter().flatten();
                        motions.for_each(|&(v, z)| sum.add(v, g * z));
                    }
                    (positions, sum.take())
                },
            )
            .collect();
        let (rows, mut matrix): (Vec<Row>, Vec<Row>) = split.into_iter().unzip();
        let mut sum = RowSum::new(unknowns);
        for motion in patches.iter().flatten() {
            for &(at, z) in &motion.vector {
                force(at).iter().for_each(|&(m, c)| sum.add(m, z * c));
            }
            sum.add(matrix.len() as u32, motion.stiffness);
            matrix.push(sum.take());
        }
        let sizes = patches.iter().map(Vec::len);
        let matrix = assembled(scaled, sizes, &matrix)?;
        let mut solver = MultifrontalLu::new();
        solver.analyse(matrix.structure())?;
        let entries = solver.factor(&matrix)?.factor_entries;
        let entries = entries + rows.iter().map(Vec::len).sum::<usize>();
        Ok(Self {
            rows,
            entries: entries + forces.iter().map(|f| f.1.len()).sum::<usize>(),
            forces,
            stiffness,
            compliance,
            motions: patches.into_iter().flatten().map(|m| m.vector).collect(),
            solver,
        })
    }

    /// `m := S^-1 (m - G_x x)`.
    pub(crate) fn solve(&self, x: &[f32], m: &mut [f64]) {
        m.par_iter_mut()
            .zip(&self.rows)
            .with_min_len(256)
            .for_each(|(m, row)| {
                let known = row.iter().map(|&(at, g)| g * f64::from(x[at as usize]));
                *m -= known.sum::<f64>();
            });
        let mut stiffened = self.stiffened(m, x.len());
        let mut v = m.to_vec();
        v.extend(self.motions.iter().map(|motion| {
            let work = motion.iter().map(|&(at, z)| z * stiffened[at as usize]);
            -work.sum::<f64>()
        }));
        self.compliance.apply(&mut stiffened);
        v.par_iter_mut()
            .zip(&self.rows)
            .with_min_len(256)
            .for_each(|(m, row)| {
                let moved = row.iter().map(|&(at, g)| g * stiffened[at as usize]);
                *m += moved.sum::<f64>();
            });
        self.solver.substitute(&mut v);
        m.copy_from_slice(&v[..m.len()]);
    }

    /// `g^T s m` by positions, with the constraints `g` of stiffness `s`.
    fn stiffened(&self, m: &[f64], positions: usize) -> Vec<f64> {
        let mut forces = vec![0.0; positions];
        let constraints = self.rows.iter().zip(&self.stiffness);
        for ((row, stiffness), m) in constraints.zip(m).filter(|((_, s), _)| **s > 0.0) {
            row.iter()
                .for_each(|&(at, g)| forces[at as usize] += stiffness * m * g);
        }
        forces
    }

    /// `b := b - C m`.
    pub(crate) fn subtract_forces(&self, m: &[f64], b: &mut [f32]) {
        for (at, row) in &self.forces {
            let force: f64 = row.iter().map(|&(k, c)| c * m[k as usize]).sum();
            b[*at as usize] -= force as f32;
        }
    }

    /// Entries that are kept.
    pub(crate) fn entries(&self) -> usize {
        self.entries
    }
}

/// Motions of patches by the positions that they move: numbers after those of multipliers.
fn moved(patches: &[Vec<Motion>], multipliers: usize) -> HashMap<u32, Vec<(u32, f64)>> {
    let mut moved: HashMap<u32, Vec<(u32, f64)>> = HashMap::new();
    for (v, motion) in (multipliers as u32..).zip(patches.iter().flatten()) {
        for &(at, z) in &motion.vector {
            moved.entry(at).or_default().push((v, z));
        }
    }
    moved
}

/// Rows of `C` with entries, by `3 node + component`.
fn forces(scaled: &Scaled<'_>, place: &[u32]) -> Vec<(u32, Row)> {
    let structure = &scaled.nodes.partition;
    let mut forces = Vec::new();
    for (node, &i) in scaled.nodes.supervariables.iter().enumerate() {
        if !structure.is_kept(Supervariable(i as usize)) {
            continue;
        }
        for (component, u) in structure.bulk_group(i as usize).enumerate() {
            let entries = scaled.row(u).filter(|&(v, a)| a != 0.0 && place[v] != NONE);
            let row: Row = entries.map(|(v, a)| (place[v], a)).collect();
            if !scaled.prescribed[u] && !row.is_empty() {
                forces.push(((3 * node + component) as u32, row));
            }
        }
    }
    forces
}

/// Entries of the row of a multiplier: by `3 node + component`, and by multiplier.
fn parts(scaled: &Scaled<'_>, place: &[u32], multiplier: usize) -> (Row, Row) {
    let (mut positions, mut own) = (Row::new(), Row::new());
    for (v, a) in scaled.row(multiplier).filter(|e| e.1 != 0.0) {
        match scaled.node(v) {
            (NONE, _) => own.push((place[v], a)),
            (node, component) => positions.push((3 * node + component as u32, a)),
        }
    }
    (positions, own)
}
