//! The fronts of a [`SchurCholesky`](super::SchurCholesky).

use crate::{
    matrix::SparseMatrix,
    numeric::{Child, Contribution, Kernel, Numeric},
    real::Real,
    structure::Structure,
    symmetric,
    tree::{AssemblyTree, ELSEWHERE, Front},
};
use std::marker::PhantomData;

/// First pivot of a front that is not positive.
#[derive(Clone, Copy, Debug)]
pub(super) struct Failure {
    pub(super) unknown: usize,
    pub(super) pivot: f64,
}
/// Inputs of a factorisation.
#[derive(Clone, Copy)]
pub(super) struct Plan<'a> {
    pub(super) tree: &'a AssemblyTree,
    pub(super) matrix: &'a SparseMatrix,
    pub(super) scales: &'a [f64],
    /// Fronts that are eliminated.
    pub(super) interior: usize,
    /// Unknowns of the Schur complement.
    pub(super) kept: usize,
}

impl Plan<'_> {
    /// The first bad pivot, if there is one.
    pub(super) fn factor<T: Real>(
        self,
        numeric: &mut Numeric<Option<Failure>, T>,
    ) -> Option<Failure> {
        numeric.factor(&System {
            plan: self,
            numbers: PhantomData,
        });
        let begin = numeric.values.len() - self.kept * self.kept;
        mirror_lower(&mut numeric.values[begin..], self.kept);
        numeric.fronts.iter().flatten().next().copied()
    }
}

/// Data shared by all fronts of a factorisation.
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
pub(super) fn entries(front: &Front) -> usize {
    front.size * front.pivots
}

/// Copies the lower triangle to the upper one, block by block.
pub fn mirror_lower<T: Copy>(values: &mut [T], n: usize) {
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
