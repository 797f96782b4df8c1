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
    descent::Descent,
    error::SolveError,
    matrix::SparseMatrix,
    numeric::{Child, Contribution, Kernel, Numeric},
    ordering,
    real::{Precision, Real},
    solver::{Analysis, Method},
    structure::{Structure, Supervariable, Tier},
    symmetric,
    tree::{AssemblyTree, ELSEWHERE, Front},
};
use faer::Mat;
use std::marker::PhantomData;

/// Cholesky factorisation of the interior of a symmetric matrix.
#[derive(Debug)]
pub struct SchurCholesky {
    structure: Structure,
    tree: AssemblyTree,
    descent: Descent,
    /// Unknowns in the order of elimination.
    order: Vec<u32>,
    /// Unknowns of the Schur complement.
    kept: Vec<usize>,
    scales: Vec<f64>,
    factors: Factors,
}

/// Factors of one precision or the other.
#[derive(Debug)]
enum Factors {
    Single(Numeric<Option<Failure>, f32>),
    Double(Numeric<Option<Failure>, f64>),
}

/// A dense matrix, column by column.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Values<'a> {
    Single(&'a [f32]),
    Double(&'a [f64]),
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
        let unknowns = |list: &[u32]| -> Vec<u32> {
            let groups = list.iter().map(|&i| structure.group(i as usize));
            groups.flatten().map(|u| u as u32).collect()
        };
        let interior = tree.fronts.len() - usize::from(!kept.is_empty());
        let fronts = tree.fronts.iter();
        Ok(Self {
            descent: Descent::new(&tree, interior),
            order: fronts.flat_map(|front| unknowns(&front.members)).collect(),
            structure: structure.clone(),
            tree,
            kept: unknowns(&kept).into_iter().map(|u| u as usize).collect(),
            scales: Vec::new(),
            factors: Factors::of(Precision::Double),
        })
    }

    /// Predicted cost of [`factor`](Self::factor).
    pub fn analysis(&self, precision: Precision) -> Analysis {
        let factor_entries = self.tree.fronts.iter().map(entries).sum();
        let interior = self.tree.fronts.iter().take(self.interior());
        let flops = interior
            .map(|f| 0.5 * crate::tree::elimination_flops(f.pivots, f.size))
            .sum();
        let peak_bytes = precision.bytes() * (factor_entries + self.tree.stack());
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

    /// Eliminates the interior.
    ///
    /// Of the matrix only one of each pair of mirrored entries is used.
    pub fn factor(
        &mut self,
        matrix: &SparseMatrix,
        precision: Precision,
    ) -> Result<(), SolveError> {
        self.scales.clear();
        if !self.structure.same_as(matrix.structure()) {
            return Err(SolveError::NotAnalysed);
        }
        let scales = self.unit_diagonal(matrix)?;
        if self.factors.precision() != precision {
            self.factors = Factors::of(precision);
        }
        let plan = Plan {
            tree: &self.tree,
            matrix,
            scales: &scales,
            interior: self.interior(),
            kept: self.kept.len(),
        };
        let failure = match &mut self.factors {
            Factors::Single(numeric) => plan.factor(numeric),
            Factors::Double(numeric) => plan.factor(numeric),
        };
        if let Some(failure) = failure {
            return Err(SolveError::NotPositiveDefinite {
                unknown: failure.unknown,
                pivot: failure.pivot,
            });
        }
        self.scales = scales;
        Ok(())
    }

    /// The Schur complement of the last factorisation, both triangles.
    pub fn complement(&self) -> Mat<f64> {
        let n = self.kept.len();
        Mat::from_fn(n, n, |i, j| match self.complement_values() {
            Values::Single(values) => values[j * n + i].double(),
            Values::Double(values) => values[j * n + i],
        })
    }

    /// The same column by column.
    pub(crate) fn complement_values(&self) -> Values<'_> {
        let begin = |values: usize| values.saturating_sub(self.kept.len().pow(2));
        match &self.factors {
            Factors::Single(numeric) => {
                Values::Single(&numeric.values[begin(numeric.values.len())..])
            }
            Factors::Double(numeric) => {
                Values::Double(&numeric.values[begin(numeric.values.len())..])
            }
        }
    }

    /// Eliminates the interior from a right-hand side; the kept unknowns hold
    /// `b_k - A_ki A_ii^-1 b_i`, the others what [`expand`](Self::expand) needs.
    pub fn condense(&self, rhs: &[f64]) -> Result<Vec<f64>, SolveError> {
        check_length(rhs, self.structure.unknowns())?;
        if self.scales.len() != rhs.len() {
            return Err(SolveError::NotFactored);
        }
        Ok(match &self.factors {
            Factors::Single(numeric) => self.condensed(&numeric.values, rhs),
            Factors::Double(numeric) => self.condensed(&numeric.values, rhs),
        })
    }

    /// What the interior takes off the kept unknowns joins them in double precision.
    fn condensed<T: Real>(&self, values: &[T], rhs: &[f64]) -> Vec<f64> {
        let interior = self.order.len() - self.kept.len();
        let scaled = |&u: &u32| T::of(rhs[u as usize] * self.scales[u as usize]);
        let mut y: Vec<T> = self.order[..interior].iter().map(scaled).collect();
        y.resize(self.order.len(), T::default());
        self.descent.upwards(values, &mut y);
        let mut condensed = vec![0.0; rhs.len()];
        for (&u, y) in self.order.iter().zip(&y) {
            condensed[u as usize] = y.double();
        }
        for &u in &self.kept {
            condensed[u] += rhs[u];
        }
        condensed
    }

    /// All unknowns, from a condensed right-hand side with the solution at the kept ones.
    pub fn expand(&self, condensed: Vec<f64>) -> Result<Vec<f64>, SolveError> {
        check_length(&condensed, self.structure.unknowns())?;
        Ok(match &self.factors {
            Factors::Single(numeric) => self.expanded(&numeric.values, condensed),
            Factors::Double(numeric) => self.expanded(&numeric.values, condensed),
        })
    }

    /// What is kept stays as it is, to the last bit.
    fn expanded<T: Real>(&self, values: &[T], condensed: Vec<f64>) -> Vec<f64> {
        let unknowns = self.order.iter().map(|&u| u as usize);
        let mut y: Vec<T> = unknowns.map(|u| T::of(condensed[u])).collect();
        self.descent.downwards(values, &mut y);
        let mut x = condensed;
        let interior = self.order.len() - self.kept.len();
        for (&u, y) in self.order[..interior].iter().zip(y) {
            x[u as usize] = y.double() * self.scales[u as usize];
        }
        x
    }

    /// Number of fronts that are eliminated.
    fn interior(&self) -> usize {
        let root = self.tree.fronts.last().filter(|_| !self.kept.is_empty());
        self.tree.fronts.len() - root.map_or(0, |_| 1)
    }

    /// Powers of two that bring the diagonal of the interior near one.
    fn unit_diagonal(&self, matrix: &SparseMatrix) -> Result<Vec<f64>, SolveError> {
        let mut scales = vec![1.0; self.structure.unknowns()];
        for &unknown in &self.order[..self.order.len() - self.kept.len()] {
            let unknown = unknown as usize;
            let pivot = matrix.get(unknown, unknown).unwrap_or(0.0);
            if pivot.is_nan() || pivot <= 0.0 {
                return Err(SolveError::NotPositiveDefinite { unknown, pivot });
            }
            scales[unknown] = (-(0.5 * pivot.log2()).round()).exp2();
        }
        Ok(scales)
    }
}

impl Factors {
    /// None yet.
    fn of(precision: Precision) -> Self {
        match precision {
            Precision::Single => Self::Single(Numeric::default()),
            Precision::Double => Self::Double(Numeric::default()),
        }
    }

    fn precision(&self) -> Precision {
        match self {
            Self::Single(_) => Precision::Single,
            Self::Double(_) => Precision::Double,
        }
    }
}

/// What a factorisation goes by.
#[derive(Clone, Copy)]
struct Plan<'a> {
    tree: &'a AssemblyTree,
    matrix: &'a SparseMatrix,
    scales: &'a [f64],
    /// Fronts that are eliminated.
    interior: usize,
    /// Unknowns of the Schur complement.
    kept: usize,
}

impl Plan<'_> {
    /// The first bad pivot, if there is one.
    fn factor<T: Real>(self, numeric: &mut Numeric<Option<Failure>, T>) -> Option<Failure> {
        numeric.factor(&System {
            plan: self,
            numbers: PhantomData,
        });
        let begin = numeric.values.len() - self.kept * self.kept;
        mirror_lower(&mut numeric.values[begin..], self.kept);
        numeric.fronts.iter().flatten().next().copied()
    }
}

/// What all fronts of a factorisation share.
struct System<'a, T> {
    plan: Plan<'a>,
    numbers: PhantomData<T>,
}

impl<T: Real> Kernel for System<'_, T> {
    type Factor = Option<Failure>;
    type Value = T;

    fn tree(&self) -> &AssemblyTree {
        self.plan.tree
    }

    fn entries(&self, front: &Front) -> usize {
        entries(front)
    }

    fn factor(
        &self,
        f: usize,
        children: &[Child<'_, T>],
        left: &mut [T],
        rest: &mut [T],
    ) -> (Option<Failure>, Contribution) {
        let front = &self.plan.tree.fronts[f];
        left.fill(T::default());
        self.assemble(front, left);
        for child in children {
            extend_add(front, child, left, rest);
        }
        let contribution = Contribution {
            size: front.rest(),
            ..Contribution::default()
        };
        if f >= self.plan.interior {
            return (None, contribution);
        }
        let failure = symmetric::eliminate(left, rest, front.size).map(|(position, pivot)| {
            let unknown = unknowns(self.plan.matrix.structure(), front)[position] as usize;
            Failure { unknown, pivot }
        });
        (failure, contribution)
    }

    fn with_delayed(&self, _: &Option<Failure>, _: &[T], _: &[T], _: &mut [T]) {}
}

impl<T: Real> System<'_, T> {
    /// Adds the entries of the matrix in the columns of the members, lower triangle.
    fn assemble(&self, front: &Front, left: &mut [T]) {
        let Plan {
            tree,
            matrix,
            scales,
            ..
        } = self.plan;
        let structure = matrix.structure();
        let mut start = 0;
        for &i in &front.members {
            let group = structure.group(i as usize);
            for edge in structure.edges(i as usize) {
                let place = tree.local[edge];
                if place == ELSEWHERE || (place as usize) < start {
                    continue;
                }
                let others = structure.group(structure.target(edge));
                for (a, unknown) in group.clone().enumerate() {
                    let row = structure.row(i as usize, a).start + structure.column(edge);
                    let values = &matrix.values()[row..][..others.len()];
                    let column = &mut left[(start + a) * front.size..][..front.size];
                    for (b, other) in others.clone().enumerate() {
                        if place as usize + b >= start + a {
                            let scale = scales[unknown] * scales[other];
                            column[place as usize + b] += T::of(scale * values[b]);
                        }
                    }
                }
            }
            start += group.len();
        }
    }
}

/// Adds the lower triangle of a child's contribution.
fn extend_add<T: Real>(front: &Front, child: &Child<'_, T>, left: &mut [T], rest: &mut [T]) {
    let size = child.front.rest();
    let runs = runs(child.front);
    let width = front.rest();
    for (run, &(place, begin, end)) in runs.iter().enumerate() {
        for k in begin..end {
            let source = &child.values[k * size..][..size];
            let column = place + k - begin;
            let (target, origin) = match column.checked_sub(front.pivots) {
                None => (&mut left[column * front.size..][..front.size], 0),
                Some(j) => (&mut rest[j * width..][..width], front.pivots),
            };
            let others = runs[run + 1..].iter().copied();
            for (row, begin, end) in std::iter::once((column, k, end)).chain(others) {
                let target = &mut target[row - origin..][..end - begin];
                let added = target.iter_mut().zip(&source[begin..end]);
                added.for_each(|(target, value)| *target += *value);
            }
        }
    }
}

/// Consecutive places in the parent's front: the first, and where they begin and end on the border.
fn runs(child: &Front) -> Vec<(usize, usize, usize)> {
    let mut runs: Vec<(usize, usize, usize)> = Vec::new();
    let mut begin = 0;
    for (&place, &end) in child.relative.iter().zip(&child.ends) {
        let (place, end) = (place as usize, end as usize);
        match runs.last_mut() {
            Some(run) if run.0 + begin - run.1 == place => run.2 = end,
            _ => runs.push((place, begin, end)),
        }
        begin = end;
    }
    runs
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

/// Copies the lower triangle to the upper one, block by block.
fn mirror_lower<T: Copy>(values: &mut [T], n: usize) {
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
