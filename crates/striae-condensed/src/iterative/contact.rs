//! The multipliers' part of the preconditioner, sparse on the contact surfaces.
//!
//! The Schur complement is `S = G_m - G_x A^-1 C` with `A = K + g^T s g`. With a node-wise
//! diagonal `D` in the place of `K` alone it need not be made: constraints have
//! `g x = r_g` but for their small entries of multipliers, so that `K x = -C m - g^T s r_g`,
//!
//! ```text
//! S m = r   =>   (G_m - G_x D^-1 C) m = r + G_x D^-1 g^T s r_g,
//! ```
//!
//! where only the matrix on the left is factored. Where `C = g^T` this is
//! `S^-1 = S_K^-1 - s`, `S_K` of `K` alone (Sherman, Morrison, Woodbury): smooth tractions
//! are met by `s`, which is exact, and for rough ones `D` is of the size of `K`. Where only
//! constraints couple nodes, all of this is exact.

use super::{
    NONE,
    constraints::{Compliance, Constraint},
    scaled::Scaled,
};
use rayon::prelude::*;
use striae_sparse::{
    LinearSolver, MultifrontalLu, SolveError, SparseMatrix, Structure, Supervariable, Tier,
    sparse_elimination::Row,
};

/// What is added to the diagonal in the row of a constraint.
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
    solver: MultifrontalLu,
    entries: usize,
}

impl Contact {
    /// Factors the approximate Schur complement.
    pub(crate) fn factor(
        scaled: &Scaled<'_>,
        constraints: &[Constraint],
        compliance: Compliance,
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
        let split: Vec<(Row, Row)> = multipliers
            .par_iter()
            .enumerate()
            .with_min_len(64)
            .map_init(
                || RowSum::new(multipliers.len()),
                |sum, (k, &u)| {
                    let (positions, own) = parts(scaled, &place, u as usize);
                    own.iter().for_each(|&(m, a)| sum.add(m, a));
                    for entries in positions.chunk_by(|a, b| a.0 / 3 == b.0 / 3) {
                        let node = entries[0].0 / 3;
                        let mut g = [0.0; 3];
                        entries.iter().for_each(|&(at, a)| g[at as usize % 3] = a);
                        for (component, moved) in (0..).zip(compliance.of_node(node, &g)) {
                            let row = force(3 * node + component).iter();
                            row.for_each(|&(m, c)| sum.add(m, -moved * c));
                        }
                    }
                    if stiffness[k] > 0.0 {
                        // Tractions may act on nothing but prescribed unknowns.
                        let is_positive = sum.get(k as u32) > 0.0;
                        sum.add(k as u32, if is_positive { SLIGHT } else { -SLIGHT });
                    }
                    (positions, sum.take())
                },
            )
            .collect();
        let (rows, own): (Vec<Row>, Vec<Row>) = split.into_iter().unzip();
        let matrix = assembled(scaled, &own)?;
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
        self.add_stiffened(m, x.len());
        self.solver.substitute(m);
    }

    /// `m := m + G_x D^-1 g^T s m`, with the constraints `g` of stiffness `s`.
    fn add_stiffened(&self, m: &mut [f64], positions: usize) {
        let mut moved = vec![0.0; positions];
        let constraints = self.rows.iter().zip(&self.stiffness);
        for ((row, stiffness), m) in constraints.zip(&*m).filter(|((_, s), _)| **s > 0.0) {
            row.iter()
                .for_each(|&(at, g)| moved[at as usize] += stiffness * m * g);
        }
        self.compliance.apply(&mut moved);
        m.par_iter_mut()
            .zip(&self.rows)
            .with_min_len(256)
            .for_each(|(m, row)| {
                let moved = row.iter().map(|&(at, g)| g * moved[at as usize]);
                *m += moved.sum::<f64>();
            });
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

/// A row over all multipliers that is being added up.
struct RowSum {
    values: Vec<f64>,
    is_there: Vec<bool>,
    columns: Vec<u32>,
}

impl RowSum {
    fn new(multipliers: usize) -> Self {
        Self {
            values: vec![0.0; multipliers],
            is_there: vec![false; multipliers],
            columns: Vec::new(),
        }
    }

    fn add(&mut self, multiplier: u32, value: f64) {
        let at = multiplier as usize;
        if !self.is_there[at] {
            self.is_there[at] = true;
            self.columns.push(multiplier);
        }
        self.values[at] += value;
    }

    fn get(&self, multiplier: u32) -> f64 {
        self.values[multiplier as usize]
    }

    /// The row in rising order; the sum is empty again.
    fn take(&mut self) -> Row {
        self.columns.sort_unstable();
        let row = self.columns.drain(..).map(|multiplier| {
            let at = multiplier as usize;
            self.is_there[at] = false;
            (multiplier, std::mem::take(&mut self.values[at]))
        });
        row.collect()
    }
}

/// A matrix of the multipliers by sorted rows, grouped as in the whole system.
fn assembled(scaled: &Scaled<'_>, rows: &[Row]) -> Result<SparseMatrix, SolveError> {
    let partition = &scaled.nodes.partition;
    let (mut offsets, mut tiers, mut owners) = (vec![0], Vec::<Tier>::new(), Vec::new());
    let mut before = None;
    for (k, &u) in scaled.nodes.multipliers.iter().enumerate() {
        let owner = partition.owner(u as usize);
        if before != Some(owner) {
            tiers.push(partition.tier(owner));
            offsets.push(k);
        }
        before = Some(owner);
        owners.push(tiers.len() - 1);
        offsets[tiers.len()] = k + 1;
    }
    let mut pairs: Vec<[Supervariable; 2]> = Vec::new();
    for (i, range) in offsets.windows(2).map(|ends| ends[0]..ends[1]).enumerate() {
        let near = rows[range]
            .iter()
            .flatten()
            .map(|&(m, _)| owners[m as usize]);
        let mut near: Vec<usize> = near.filter(|&j| j != i).collect();
        near.sort_unstable();
        near.dedup();
        pairs.extend(near.into_iter().map(|j| [i, j].map(Supervariable)));
    }
    let structure = Structure::from_cliques(offsets, &pairs)
        .and_then(|structure| structure.with_tiers(tiers))
        .map_err(|_| SolveError::NotAnalysed)?;
    let mut matrix = SparseMatrix::zero(&structure);
    for (k, row) in rows.iter().enumerate() {
        let i = owners[k];
        let start = structure.row(i, k - structure.group(i).start).start;
        for entries in row.chunk_by(|a, b| owners[a.0 as usize] == owners[b.0 as usize]) {
            let j = owners[entries[0].0 as usize];
            let edge = structure.edge(i, j).ok_or(SolveError::NotAnalysed)?;
            let first = start + structure.column(edge);
            for &(m, a) in entries {
                matrix.values_mut()[first + m as usize - structure.group(j).start] = a;
            }
        }
    }
    Ok(matrix)
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
