//! Substitution with the factors of a [`SchurCholesky`](crate::SchurCholesky) over its tree.
//!
//! Vectors are in the order of elimination, in which a subtree owns a range.
//! Upwards a front hands its parent what it takes off the right-hand side on its
//! border, and children are added in their order; downwards it gets the solution
//! there. Small subtrees are run through in sequence with a stack, those above
//! them in parallel: threads do not change a bit. What is zero costs nothing on
//! the way up.

use crate::{
    real::Real,
    tree::AssemblyTree,
    triangular::{Block, Diagonal, solve_lower, solve_lower_transposed},
};
use rayon::prelude::*;

/// Entries of a subtree below which it is run through in sequence.
const SEQUENTIAL: usize = 1 << 17;

/// Positions of all values.
#[derive(Debug)]
pub(crate) struct Descent {
    fronts: Vec<Step>,
    roots: Vec<u32>,
    /// Fronts that are eliminated.
    interior: usize,
    /// Place of each unknown of all borders in the front of the parent.
    places: Vec<u32>,
}

/// One front.
#[derive(Debug)]
struct Step {
    pivots: usize,
    size: usize,
    /// First position of its subtree, and its own.
    first: usize,
    begin: usize,
    /// Place of its values, and of the first in its subtree.
    values: usize,
    values_first: usize,
    /// Place of its border in the list of all.
    border: usize,
    first_front: usize,
    children: Vec<u32>,
}

impl Descent {
    /// Plan for a tree of which the first `interior` fronts are eliminated.
    pub(crate) fn new(tree: &AssemblyTree, interior: usize) -> Self {
        let mut fronts: Vec<Step> = Vec::with_capacity(tree.fronts.len());
        let mut places = Vec::new();
        let (mut begin, mut values) = (0, 0);
        for (f, front) in tree.fronts.iter().enumerate() {
            let first = tree.subtree(f).start;
            let below = fronts.get(first);
            fronts.push(Step {
                pivots: front.pivots,
                size: front.size,
                first: below.map_or(begin, |step| step.begin),
                begin,
                values,
                values_first: below.map_or(values, |step| step.values),
                border: places.len(),
                first_front: first,
                children: front.children.clone(),
            });
            begin += front.pivots;
            values += front.pivots * front.size;
            places.extend(front.places().map(|place| place as u32));
        }
        Self {
            fronts,
            roots: tree.roots.clone(),
            interior,
            places,
        }
    }

    /// `y_i := L^-1 y_i` in the interior, `y_k := y_k - B y_i` on what is kept.
    pub(crate) fn upwards<T: Real>(&self, values: &[T], y: &mut [T]) {
        let pass = Pass { plan: self, values };
        let (_, subtrees) = self.split(&self.roots, 0, y);
        subtrees.into_par_iter().for_each(|(f, y)| {
            pass.upwards(f, y);
        });
    }

    /// `y_i := L^-T (y_i - B^T y_k)` in the interior.
    pub(crate) fn downwards<T: Real>(&self, values: &[T], y: &mut [T]) {
        let pass = Pass { plan: self, values };
        let (_, subtrees) = self.split(&self.roots, 0, y);
        subtrees
            .into_par_iter()
            .for_each(|(f, y)| pass.downwards(f, y, &[]));
    }

    /// Ranges of the subtrees with the given roots, behind what is left of a vector.
    fn split<'a, T>(&self, roots: &[u32], first: usize, mut y: &'a mut [T]) -> Ranges<'a, T> {
        let mut subtrees = Vec::with_capacity(roots.len());
        let mut done = first;
        for &root in roots {
            let step = &self.fronts[root as usize];
            let end = step.begin + step.pivots;
            let (own, rest) = y.split_at_mut(end - done);
            (y, done) = (rest, end);
            subtrees.push((root as usize, own));
        }
        (y, subtrees)
    }

    /// Places of the border of a front in its parent's.
    fn places(&self, step: &Step) -> &[u32] {
        &self.places[step.border..][..step.size - step.pivots]
    }
}

/// Remaining part of a vector, and roots of subtrees with their ranges in it.
type Ranges<'a, T> = (&'a mut [T], Vec<(usize, &'a mut [T])>);

/// One way up or down.
#[derive(Clone, Copy)]
struct Pass<'a, T> {
    plan: &'a Descent,
    values: &'a [T],
}

impl<T: Real> Pass<'_, T> {
    /// Contribution of a subtree to its border; empty if it is zero.
    fn upwards(self, f: usize, y: &mut [T]) -> Vec<T> {
        let step = &self.plan.fronts[f];
        if y.iter().all(|&y| y == T::default()) {
            return Vec::new();
        }
        if self.is_small(step) {
            return self.upwards_in_sequence(f, y);
        }
        let (own, below) = self.plan.split(&step.children, step.first, y);
        let delivered: Vec<Vec<T>> = below
            .into_par_iter()
            .map(|(child, y)| self.upwards(child, y))
            .collect();
        let mut local = own.to_vec();
        local.resize(step.size, T::default());
        for (&child, contribution) in step.children.iter().zip(&delivered) {
            self.add(child, contribution, &mut local);
        }
        self.solve_lower(f, &mut local);
        own.copy_from_slice(&local[..step.pivots]);
        local.drain(..step.pivots);
        local
    }

    fn upwards_in_sequence(self, f: usize, y: &mut [T]) -> Vec<T> {
        let fronts = &self.plan.fronts;
        let mut stack: Vec<T> = Vec::new();
        // Begin and length of the contributions that wait.
        let mut waiting: Vec<(usize, usize)> = Vec::new();
        let mut rest = y;
        for g in fronts[f].first_front..=f {
            let step = &fronts[g];
            let (own, others) = rest.split_at_mut(step.pivots);
            rest = others;
            let first = waiting.len() - step.children.len();
            let here = &waiting[first..];
            let top = stack.len();
            let base = here.first().map_or(top, |&(begin, _)| begin);
            let mut length = 0;
            if here.iter().any(|&(_, length)| length > 0) || own.iter().any(|&y| y != T::default())
            {
                stack.extend_from_slice(own);
                stack.resize(top + step.size, T::default());
                let (old, local) = stack.split_at_mut(top);
                for (&child, &(begin, length)) in step.children.iter().zip(here) {
                    self.add(child, &old[begin..begin + length], local);
                }
                self.solve_lower(g, local);
                own.copy_from_slice(&local[..step.pivots]);
                length = step.size - step.pivots;
                stack.copy_within(top + step.pivots.., base);
            }
            stack.truncate(base + length);
            waiting.truncate(first);
            waiting.push((base, length));
        }
        stack
    }

    /// Solves in a subtree, whose border has been solved for.
    fn downwards(self, f: usize, y: &mut [T], border: &[T]) {
        let step = &self.plan.fronts[f];
        if self.is_small(step) {
            return self.downwards_in_sequence(f, y, border);
        }
        let (own, below) = self.plan.split(&step.children, step.first, y);
        let mut local = own.to_vec();
        local.extend_from_slice(border);
        self.solve_lower_transposed(f, &mut local);
        own.copy_from_slice(&local[..step.pivots]);
        below.into_par_iter().for_each(|(child, y)| {
            let places = self.plan.places(&self.plan.fronts[child]).iter();
            let border: Vec<T> = places.map(|&place| local[place as usize]).collect();
            self.downwards(child, y, &border);
        });
    }

    fn downwards_in_sequence(self, f: usize, y: &mut [T], border: &[T]) {
        let fronts = &self.plan.fronts;
        let mut stack = border.to_vec();
        let mut local: Vec<T> = Vec::new();
        let mut rest = y;
        for g in (fronts[f].first_front..=f).rev() {
            let step = &fronts[g];
            let (others, own) = rest.split_at_mut(rest.len() - step.pivots);
            rest = others;
            let begin = stack.len() - (step.size - step.pivots);
            local.clear();
            local.extend_from_slice(own);
            local.extend_from_slice(&stack[begin..]);
            stack.truncate(begin);
            self.solve_lower_transposed(g, &mut local);
            own.copy_from_slice(&local[..step.pivots]);
            for &child in &step.children {
                let places = self.plan.places(&fronts[child as usize]).iter();
                stack.extend(places.map(|&place| local[place as usize]));
            }
        }
    }

    fn is_small(self, step: &Step) -> bool {
        step.children.is_empty()
            || step.values + step.pivots * step.size < step.values_first + SEQUENTIAL
    }

    /// Adds what a child takes off; nothing where it is empty.
    fn add(self, child: u32, contribution: &[T], local: &mut [T]) {
        let places = self.plan.places(&self.plan.fronts[child as usize]);
        for (&place, value) in places.iter().zip(contribution) {
            local[place as usize] += *value;
        }
    }

    fn solve_lower(self, f: usize, local: &mut [T]) {
        let step = &self.plan.fronts[f];
        if f < self.plan.interior {
            solve_lower(self.block(step), Diagonal::Stored, local, step.pivots);
        }
    }

    fn solve_lower_transposed(self, f: usize, local: &mut [T]) {
        let step = &self.plan.fronts[f];
        if f < self.plan.interior {
            solve_lower_transposed(self.block(step), Diagonal::Stored, local, step.pivots);
        }
    }

    fn block(&self, step: &Step) -> Block<'_, T> {
        let values = &self.values[step.values..][..step.pivots * step.size];
        Block::new(values, step.size)
    }
}
