//! The iterative solver: GMRES on the whole system, bodies by smoothed aggregation.
//!
//! With bulk unknowns `x` and multipliers `m` the system is
//!
//! ```text
//! [ K    C  ] [x]   [r_x]
//! [ G_x  G_m] [m] = [r_m]
//! ```
//!
//! `K` is stiffened by the constraints among the rows of `G` ([`Constraint`]) to a
//! definite `A`, of which one V-cycle of a [`Hierarchy`] is taken as the inverse, and
//! `S = G_m - G_x A^-1 C` is approximated by a sparse matrix on the contact surfaces
//! ([`Contact`]). The preconditioner is the block factorisation with both:
//!
//! ```text
//! y = A^-1 r_x,   m = S^-1 (r_m - G_x y),   x = A^-1 (r_x - C m)
//! ```
//!
//! With exact inverses GMRES would end after two steps, as the stiffening only acts on what
//! violates a constraint. Rows with nothing but a diagonal (prescribed unknowns) are solved for
//! first. The contact equations are met as all others: the residual is that of the true system.
//! Everything is rebuilt for every matrix.

mod constraints;
mod contact;
mod patches;
mod replicated;
mod scaled;
mod system;

pub use replicated::{ContactFactors, Group, Stiffening};

use crate::{
    condensed::prescribed,
    entries::Kept,
    partition::Partition,
    report::{Analysis, Factored, Method},
    scaling,
    tangent::Tangent,
};
use constraints::{Compliance, Constraint};
use contact::Contact;
use patches::Surface;
use rayon::prelude::*;
use scaled::Scaled;
use striae_sparse::{
    Age, Cost, Equilibration, LinearOperator, SolveError, SolveReport, Structure,
    aggregation::Hierarchy,
    gmres::{self, Ends},
};

/// Not a node.
const NONE: u32 = u32::MAX;
/// Iterations of GMRES between restarts.
const CYCLE: usize = 120;
/// Cycles at most.
const CYCLES: usize = 5;
/// Reduction of the residual by one cycle; more is lost to single precision.
const GAIN: f64 = 1e-6;

/// Bodies of three unknowns a node, with contact.
#[derive(Debug)]
pub(crate) struct Iterative {
    nodes: Nodes,
    numeric: Option<Numeric>,
}

/// Supervariables with bulk unknowns.
#[derive(Debug)]
struct Nodes {
    partition: Partition,
    /// Supervariable of every node, and the other way round.
    supervariables: Vec<u32>,
    of: Vec<u32>,
    /// Connected part of the bulk every node is in.
    parts: Vec<u32>,
    /// Unknowns that are no bulk, rising.
    multipliers: Vec<u32>,
}

#[derive(Debug)]
struct Numeric {
    scaling: Equilibration,
    prescribed: Vec<bool>,
    hierarchy: Hierarchy,
    contact: Contact,
}

impl Iterative {
    /// Plans the solution; `None` where the bulk does not have three unknowns a node.
    pub(crate) fn analyse(partition: &Partition) -> Option<Self> {
        let mut nodes = Nodes::new(partition)?;
        for (part, members) in partition.bodies().iter().enumerate() {
            for &i in members {
                nodes.parts[nodes.of[i as usize] as usize] = part as u32;
            }
        }
        Some(Self {
            nodes,
            numeric: None,
        })
    }

    /// Predicted cost, by counts.
    pub(crate) fn analysis(structure: &Structure) -> Analysis {
        let entries = structure.entries();
        let cost = Cost {
            factor_entries: (FACTORS * entries as f64) as usize,
            flops: OPERATIONS * entries as f64,
            peak_bytes: size_of::<f64>()
                * ((PEAK * entries as f64) as usize + 2 * CYCLE * structure.unknowns()),
        };
        Analysis {
            cost,
            method: Method::Iterative,
        }
    }

    /// Makes the preconditioner of a matrix of the analysed structure.
    pub(crate) fn factor(&mut self, tangent: &Tangent) -> Result<Factored, SolveError> {
        self.numeric = None;
        if !self.nodes.partition.fits(tangent) {
            return Err(SolveError::NotAnalysed);
        }
        let partition = &self.nodes.partition;
        let kept = Kept::of(partition);
        let rows = kept.rows(tangent)?;
        let scaling = scaling::by_diagonal(partition, tangent, (&kept, &rows))?;
        let prescribed = prescribed(&self.nodes.partition, tangent);
        let scaled = Scaled {
            nodes: &self.nodes,
            tangent,
            scaling: &scaling,
            prescribed: &prescribed,
        };
        let constraints = Constraint::all(&scaled, &self.nodes.multipliers);
        let bulk = scaled.stiffened(&constraints);
        let compliance = Compliance::of(&scaled);
        let contact = Contact::factor(&scaled, &constraints, compliance, &Surface::of(&scaled))?;
        let hierarchy = Hierarchy::new(bulk, &scaled.near_kernel(), &self.nodes.parts);
        let indefinite = SolveError::NotPositiveDefinite {
            unknown: 0,
            pivot: 0.0,
        };
        let hierarchy = hierarchy.ok_or(indefinite)?;
        let report = Factored {
            factor_entries: hierarchy.entries() / 2 + contact.entries(),
            method: Method::Iterative,
            ..Factored::default()
        };
        self.numeric = Some(Numeric {
            scaling,
            prescribed,
            hierarchy,
            contact,
        });
        Ok(report)
    }

    /// Forgets the preconditioner.
    pub(crate) fn forget(&mut self) {
        self.numeric = None;
    }

    /// Solves to a reduction of the scaled residual; `None` when that takes too many iterations.
    pub(crate) fn solve(
        &self,
        tangent: &Tangent,
        rhs: &[f64],
        x: &mut [f64],
        reduction: f64,
    ) -> Result<Option<SolveReport>, SolveError> {
        let numeric = self.numeric.as_ref().ok_or(SolveError::NotFactored)?;
        let scaling = &numeric.scaling;
        let multiply = |v: &[f64], image: &mut [f64]| {
            let mut v = v.to_vec();
            scaling.scale_columns(&mut v);
            tangent.multiply(&v, image);
            scaling.scale_rows(image);
        };
        let precondition = |v: &mut [f64]| self.precondition(numeric, v);
        x.fill(0.0);
        for (u, _) in numeric.prescribed.iter().enumerate().filter(|p| *p.1) {
            x[u] = rhs[u] / tangent.diagonal(u);
        }
        let mut residual = tangent.residual(x, rhs, &scaling.columns);
        scaling.scale_rows(&mut residual.values);
        let size = gmres::norm(&residual.values);
        let (mut iterations, mut present) = (0, size);
        for _ in 0..CYCLES {
            if present <= reduction * size {
                break;
            }
            let ends = Ends {
                iterations: CYCLE,
                reduction: (0.9 * reduction * size / present).max(GAIN),
            };
            let correction = gmres::solve(&multiply, &precondition, &residual.values, ends);
            iterations += correction.iterations;
            for (u, d) in correction.solution.iter().enumerate() {
                x[u] += d * scaling.columns[u];
            }
            residual = tangent.residual(x, rhs, &scaling.columns);
            scaling.scale_rows(&mut residual.values);
            let before = present;
            present = gmres::norm(&residual.values);
            if present.is_nan() || present >= 0.5 * before {
                break;
            }
        }
        let is_small = present <= reduction * size;
        Ok(is_small.then_some(SolveReport {
            backward_error: residual.backward_error,
            refinements: 0,
            krylov_iterations: iterations,
            age: Age::Fresh,
        }))
    }

    fn precondition(&self, numeric: &Numeric, v: &mut [f64]) {
        let Numeric {
            hierarchy, contact, ..
        } = numeric;
        let mut b = self.nodes.gather(v);
        let mut x = vec![0.0; b.len()];
        let mut multipliers: Vec<f64> = self
            .nodes
            .multipliers
            .iter()
            .map(|&u| v[u as usize])
            .collect();
        if !multipliers.is_empty() {
            hierarchy.apply(&b, &mut x);
            contact.solve(&x, &mut multipliers);
            contact.subtract_forces(&multipliers, &mut b);
        }
        hierarchy.apply(&b, &mut x);
        self.nodes.scatter(&x, &numeric.prescribed, v);
        for (&u, m) in self.nodes.multipliers.iter().zip(&multipliers) {
            v[u as usize] = *m;
        }
    }
}

impl Nodes {
    /// Nodes of a partition, assigned to no part yet; `None` if the bulk does not have three
    /// unknowns a node.
    fn new(partition: &Partition) -> Option<Self> {
        let mut nodes = Self {
            partition: partition.clone(),
            supervariables: Vec::new(),
            of: vec![NONE; partition.supervariables()],
            parts: Vec::new(),
            multipliers: Vec::new(),
        };
        for i in 0..partition.supervariables() {
            let others = partition.multiplier_group(i);
            nodes.multipliers.extend(others.map(|u| u as u32));
            match partition.bulk_group(i).len() {
                0 => {}
                3 => {
                    nodes.of[i] = nodes.supervariables.len() as u32;
                    nodes.supervariables.push(i as u32);
                }
                _ => return None,
            }
        }
        nodes.parts = vec![NONE; nodes.supervariables.len()];
        Some(nodes)
    }

    /// Bulk unknowns by node.
    fn gather(&self, v: &[f64]) -> Vec<f32> {
        let mut b = vec![0.0; 3 * self.supervariables.len()];
        b.par_chunks_exact_mut(3)
            .zip(&self.supervariables)
            .with_min_len(1024)
            .for_each(|(b, &i)| {
                let own = &v[self.partition.bulk_group(i as usize)];
                b.iter_mut().zip(own).for_each(|(b, &v)| *b = v as f32);
            });
        b
    }

    /// The other way round, but for prescribed unknowns.
    fn scatter(&self, x: &[f32], prescribed: &[bool], v: &mut [f64]) {
        for (x, &i) in x.chunks_exact(3).zip(&self.supervariables) {
            for (u, &x) in self.partition.bulk_group(i as usize).zip(x) {
                if !prescribed[u] {
                    v[u] = f64::from(x);
                }
            }
        }
    }
}

/// Entries that are kept over those of the matrix.
const FACTORS: f64 = 1.0;
/// Entries at the peak over those of the matrix, with it.
const PEAK: f64 = 4.0;
/// Operations of a solution over the entries of the matrix.
const OPERATIONS: f64 = 500.0;
