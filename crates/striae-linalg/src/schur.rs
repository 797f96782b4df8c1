//! Partial Cholesky factorisation of a symmetric matrix: an interior is
//! eliminated, a set of supervariables is kept.
//!
//! With `i` the interior and `k` what is kept,
//! `S = A_kk - A_ki A_ii^-1 A_ik`, `g = b_k - A_ki A_ii^-1 b_i`, and once
//! `x_k` is known, `x_i = A_ii^-1 (b_i - A_ik x_k)`. Only `A_ii` needs to be
//! positive definite. Multifrontal, on the fronts' lower triangles; the kept
//! unknowns form the last front, which is assembled but not factored. The
//! result does not depend on the number of threads.

use crate::{
    error::SolveError,
    matrix::SparseMatrix,
    numeric::{Child, Contribution, Kernel, Numeric},
    ordering,
    solver::{Analysis, Method},
    structure::{Structure, Supervariable, Tier},
    symmetric,
    tree::{AssemblyTree, ELSEWHERE, Front},
};
use faer::{
    Accum, Par,
    linalg::{matmul::matmul, triangular_solve as triangular},
    mat::{MatMut, MatRef},
    prelude::*,
};

/// Cholesky factorisation of the interior of a symmetric matrix.
#[derive(Debug)]
pub struct SchurCholesky {
    structure: Structure,
    tree: AssemblyTree,
    /// Unknowns of every front.
    unknowns: Vec<Vec<u32>>,
    /// Unknowns of the Schur complement.
    kept: Vec<usize>,
    scales: Vec<f64>,
    numeric: Numeric<Option<Failure>>,
}

/// First pivot of a front that is not positive.
#[derive(Clone, Copy, Debug)]
struct Failure {
    unknown: usize,
    pivot: f64,
}

impl SchurCholesky {
    /// Plans the elimination of all but the `kept` supervariables.
    pub fn analyse(structure: &Structure, kept: &[Supervariable]) -> Result<Self, SolveError> {
        let mut tiers = vec![Tier(0); structure.supervariables()];
        kept.iter().for_each(|s| tiers[s.0] = Tier(1));
        let is_kept = |&i: &u32| tiers[i as usize] == Tier(1);
        let kept: Vec<u32> = (0..tiers.len() as u32).filter(is_kept).collect();
        let mut order = ordering::order(structure, &tiers)?;
        order.truncate(tiers.len() - kept.len());
        order.extend(&kept);
        let tree = AssemblyTree::new(structure, &tiers, &order, kept.len());
        let unknowns = kept
            .iter()
            .flat_map(|&i| structure.group(i as usize))
            .collect();
        let of_front = |front: &Front| self::unknowns(structure, front);
        Ok(Self {
            unknowns: tree.fronts.iter().map(of_front).collect(),
            structure: structure.clone(),
            tree,
            kept: unknowns,
            scales: Vec::new(),
            numeric: Numeric::default(),
        })
    }

    /// Predicted cost of [`factor`](Self::factor).
    pub fn analysis(&self) -> Analysis {
        let factor_entries = self.tree.fronts.iter().map(entries).sum();
        let interior = self.tree.fronts.iter().take(self.interior());
        let flops = interior
            .map(|f| 0.5 * crate::tree::elimination_flops(f.pivots, f.size))
            .sum();
        let peak_bytes = size_of::<f64>() * (factor_entries + self.tree.stack());
        Analysis {
            factor_entries,
            flops,
            peak_bytes,
            method: Method::Condensed,
        }
    }

    /// Unknowns of the rows and columns of the Schur complement, rising.
    pub fn kept_unknowns(&self) -> &[usize] {
        &self.kept
    }

    /// Eliminates the interior; returns the Schur complement, both triangles.
    ///
    /// Of the matrix only one of each pair of mirrored entries is used.
    pub fn factor(&mut self, matrix: &SparseMatrix) -> Result<MatRef<'_, f64>, SolveError> {
        self.scales.clear();
        if !self.structure.same_as(matrix.structure()) {
            return Err(SolveError::NotAnalysed);
        }
        let scales = self.unit_diagonal(matrix)?;
        self.numeric.factor(&System {
            tree: &self.tree,
            matrix,
            scales: &scales,
            interior: self.interior(),
        });
        if let Some(failure) = self.numeric.fronts.iter().flatten().next() {
            return Err(SolveError::NotPositiveDefinite {
                unknown: failure.unknown,
                pivot: failure.pivot,
            });
        }
        self.scales = scales;
        let n = self.kept.len();
        let begin = self.numeric.values.len() - n * n;
        mirror_lower(&mut self.numeric.values[begin..], n);
        Ok(self.complement())
    }

    /// The Schur complement of the last factorisation.
    pub fn complement(&self) -> MatRef<'_, f64> {
        let n = self.kept.len();
        let begin = self.numeric.values.len().saturating_sub(n * n);
        MatRef::from_column_major_slice(&self.numeric.values[begin..], n, n)
    }

    /// Eliminates the interior from a right-hand side; the kept unknowns hold
    /// `b_k - A_ki A_ii^-1 b_i`, the others what [`expand`](Self::expand) needs.
    pub fn condense(&self, rhs: &[f64]) -> Result<Vec<f64>, SolveError> {
        self.forward(rhs)
    }

    /// All unknowns, from a condensed right-hand side with the solution at the kept ones.
    pub fn expand(&self, condensed: Vec<f64>) -> Result<Vec<f64>, SolveError> {
        check_length(&condensed, self.structure.unknowns())?;
        let mut x = condensed;
        let mut end: usize = self
            .tree
            .fronts
            .iter()
            .take(self.interior())
            .map(entries)
            .sum();
        for (f, front) in self.tree.fronts[..self.interior()].iter().enumerate().rev() {
            let values = &self.numeric.values[end - entries(front)..end];
            end -= entries(front);
            let lower = MatRef::from_column_major_slice(values, front.size, front.pivots);
            let places = &self.unknowns[f];
            let mut local: Vec<f64> = places.iter().map(|&u| x[u as usize]).collect();
            let (pivots, rest) = local.split_at_mut(front.pivots);
            let (diagonal, below) = lower.split_at_row(front.pivots);
            let (mut pivots, rest) = (column(pivots), column(rest));
            matmul(
                pivots.rb_mut(),
                Accum::Add,
                below.transpose(),
                rest.rb(),
                -1.0,
                Par::Seq,
            );
            triangular::solve_upper_triangular_in_place(diagonal.transpose(), pivots, Par::Seq);
            places[..front.pivots]
                .iter()
                .zip(&local)
                .for_each(|(&u, value)| x[u as usize] = *value);
        }
        x.iter_mut().zip(&self.scales).for_each(|(x, s)| *x *= s);
        Ok(x)
    }

    /// `L^-1 R b` on the interior, condensed right-hand side on the kept unknowns.
    fn forward(&self, rhs: &[f64]) -> Result<Vec<f64>, SolveError> {
        check_length(rhs, self.structure.unknowns())?;
        if self.scales.len() != rhs.len() {
            return Err(SolveError::NotFactored);
        }
        let mut y: Vec<f64> = rhs.iter().zip(&self.scales).map(|(b, s)| b * s).collect();
        let mut begin = 0;
        for (f, front) in self.tree.fronts[..self.interior()].iter().enumerate() {
            let values = &self.numeric.values[begin..begin + entries(front)];
            begin += entries(front);
            let lower = MatRef::from_column_major_slice(values, front.size, front.pivots);
            let places = &self.unknowns[f];
            let mut local: Vec<f64> = places.iter().map(|&u| y[u as usize]).collect();
            let (pivots, rest) = local.split_at_mut(front.pivots);
            let (diagonal, below) = lower.split_at_row(front.pivots);
            let (mut pivots, rest) = (column(pivots), column(rest));
            triangular::solve_lower_triangular_in_place(diagonal, pivots.rb_mut(), Par::Seq);
            matmul(rest, Accum::Add, below, pivots.rb(), -1.0, Par::Seq);
            places
                .iter()
                .zip(&local)
                .for_each(|(&u, value)| y[u as usize] = *value);
        }
        Ok(y)
    }

    /// Number of fronts that are eliminated.
    fn interior(&self) -> usize {
        let root = self.tree.fronts.last().filter(|_| !self.kept.is_empty());
        self.tree.fronts.len() - root.map_or(0, |_| 1)
    }

    /// Powers of two that bring the diagonal of the interior near one.
    fn unit_diagonal(&self, matrix: &SparseMatrix) -> Result<Vec<f64>, SolveError> {
        let mut scales = vec![1.0; self.structure.unknowns()];
        let fronts = self.tree.fronts[..self.interior()].iter();
        for (front, unknowns) in fronts.zip(&self.unknowns) {
            for &unknown in &unknowns[..front.pivots] {
                let unknown = unknown as usize;
                let pivot = matrix.get(unknown, unknown).unwrap_or(0.0);
                if pivot.is_nan() || pivot <= 0.0 {
                    return Err(SolveError::NotPositiveDefinite { unknown, pivot });
                }
                scales[unknown] = (-(0.5 * pivot.log2()).round()).exp2();
            }
        }
        Ok(scales)
    }
}

/// What all fronts of a factorisation share.
struct System<'a> {
    tree: &'a AssemblyTree,
    matrix: &'a SparseMatrix,
    scales: &'a [f64],
    interior: usize,
}

impl Kernel for System<'_> {
    type Factor = Option<Failure>;

    fn tree(&self) -> &AssemblyTree {
        self.tree
    }

    fn entries(&self, front: &Front) -> usize {
        entries(front)
    }

    fn factor(
        &self,
        f: usize,
        children: &[Child<'_>],
        left: &mut [f64],
        rest: &mut [f64],
    ) -> (Option<Failure>, Contribution) {
        let front = &self.tree.fronts[f];
        left.fill(0.0);
        self.assemble(front, left);
        for child in children {
            extend_add(front, child, left, rest);
        }
        let contribution = Contribution {
            size: front.rest(),
            ..Contribution::default()
        };
        if f >= self.interior {
            return (None, contribution);
        }
        let failure = symmetric::eliminate(left, rest, front.size).map(|(position, pivot)| {
            let unknown = unknowns(self.matrix.structure(), front)[position] as usize;
            Failure { unknown, pivot }
        });
        (failure, contribution)
    }

    fn with_delayed(&self, _: &Option<Failure>, _: &[f64], _: &[f64], _: &mut [f64]) {}
}

impl System<'_> {
    /// Adds the entries of the matrix in the columns of the members, lower triangle.
    fn assemble(&self, front: &Front, left: &mut [f64]) {
        let structure = self.matrix.structure();
        let mut start = 0;
        for &i in &front.members {
            let group = structure.group(i as usize);
            for edge in structure.edges(i as usize) {
                let place = self.tree.local[edge];
                if place == ELSEWHERE || (place as usize) < start {
                    continue;
                }
                let others = structure.group(structure.target(edge));
                for (a, unknown) in group.clone().enumerate() {
                    let row = structure.row(i as usize, a).start + structure.column(edge);
                    let values = &self.matrix.values()[row..][..others.len()];
                    let column = &mut left[(start + a) * front.size..][..front.size];
                    for (b, other) in others.clone().enumerate() {
                        if place as usize + b >= start + a {
                            let scale = self.scales[unknown] * self.scales[other];
                            column[place as usize + b] += scale * values[b];
                        }
                    }
                }
            }
            start += group.len();
        }
    }
}

/// Adds the lower triangle of a child's contribution.
fn extend_add(front: &Front, child: &Child<'_>, left: &mut [f64], rest: &mut [f64]) {
    let places: Vec<usize> = child.front.places().collect();
    let width = front.rest();
    for (k, source) in child.values.chunks_exact(places.len().max(1)).enumerate() {
        let place = places[k];
        let (target, origin) = match place.checked_sub(front.pivots) {
            None => (&mut left[place * front.size..][..front.size], 0),
            Some(j) => (&mut rest[j * width..][..width], front.pivots),
        };
        for (&row, value) in places[k..].iter().zip(&source[k..]) {
            target[row - origin] += value;
        }
    }
}

/// Unknowns of a front in order.
fn unknowns(structure: &Structure, front: &Front) -> Vec<u32> {
    let groups = front.members.iter().chain(&front.border);
    let unknowns = groups.flat_map(|&i| structure.group(i as usize));
    unknowns.map(|u| u as u32).collect()
}

/// Entries of the factor in a front, with the unused upper triangle of the pivots.
fn entries(front: &Front) -> usize {
    front.size * front.pivots
}

fn column(v: &mut [f64]) -> MatMut<'_, f64> {
    let rows = v.len();
    MatMut::from_column_major_slice_mut(v, rows, 1)
}

/// Copies the lower triangle to the upper one, block by block.
fn mirror_lower(values: &mut [f64], n: usize) {
    const BLOCK: usize = 32;
    for left in (0..n).step_by(BLOCK) {
        for top in (left..n).step_by(BLOCK) {
            for j in left..(left + BLOCK).min(n) {
                for i in top.max(j + 1)..(top + BLOCK).min(n) {
                    values[i * n + j] = values[j * n + i];
                }
            }
        }
    }
}

fn check_length(v: &[f64], expected: usize) -> Result<(), SolveError> {
    if v.len() == expected {
        Ok(())
    } else {
        Err(SolveError::Length {
            found: v.len(),
            expected,
        })
    }
}
