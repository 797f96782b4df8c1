//! Multifrontal factorisation over the whole assembly tree.
//!
//! Small subtrees are factored in sequence with one stack of contributions;
//! above them children are factored in parallel. Contributions are added in
//! the order of the children, so threads do not change the result.

use crate::{
    real::Real,
    tree::{AssemblyTree, Front},
};
use rayon::prelude::*;
use std::sync::Mutex;

/// A subtree below this share of the whole work is factored in sequence.
const SEQUENTIAL_SHARE: f64 = 1.0 / 48.0;
/// Work below which a subtree is factored in sequence in any case.
const SEQUENTIAL_FLOPS: f64 = 2e7;

/// Work of a factorisation at one front.
pub(crate) trait Kernel: Sync {
    /// Data kept of a front besides its values.
    type Factor: Clone + Default + Send;
    /// Numbers that it works with.
    type Value: Real;

    /// The plan.
    fn tree(&self) -> &AssemblyTree;

    /// Entries of the factors of a front, as planned.
    fn entries(&self, front: &Front) -> usize;

    /// Assembles and factors front `f`; the contribution, without delayed
    /// pivots, goes to `rest`, which is zero.
    fn factor(
        &self,
        f: usize,
        children: &[Child<'_, Self::Value>],
        planned: &mut [Self::Value],
        rest: &mut [Self::Value],
    ) -> (Self::Factor, Contribution);

    /// Completes a contribution with delayed pivots.
    fn with_delayed(
        &self,
        factor: &Self::Factor,
        planned: &[Self::Value],
        rest: &[Self::Value],
        contribution: &mut [Self::Value],
    );
}

/// Contribution of a front to its parent; the values are stored separately.
#[derive(Clone, Debug, Default)]
pub(crate) struct Contribution {
    /// Number of rows and columns: delayed pivots, then the border.
    pub(crate) size: usize,
    /// Unknowns of the delayed rows.
    pub(crate) delayed_rows: Vec<u32>,
    /// Unknowns of the delayed columns.
    pub(crate) delayed_columns: Vec<u32>,
}

impl Contribution {
    /// Pivots left to the parent.
    pub(crate) fn delayed(&self) -> usize {
        self.delayed_rows.len()
    }
}

/// A child's contribution ready for assembly.
pub(crate) struct Child<'a, T = f64> {
    pub(crate) front: &'a Front,
    pub(crate) contribution: &'a Contribution,
    pub(crate) values: &'a [T],
}

/// Factors of a matrix; storage is kept for the next factorisation.
#[derive(Debug, Default)]
pub(crate) struct Numeric<F, T = f64> {
    pub(crate) fronts: Vec<F>,
    /// Planned storage of all fronts, one after the other.
    pub(crate) values: Vec<T>,
    pool: Pool<T>,
}

/// Buffers for contributions, so that large ones are not asked of the system again and again.
#[derive(Debug, Default)]
struct Pool<T>(Mutex<Vec<Vec<T>>>);

/// Contribution of a subtree in a buffer of its own.
struct Delivered<T> {
    contribution: Contribution,
    values: Vec<T>,
}

impl<F: Clone + Default + Send, T: Real> Numeric<F, T> {
    /// Factors a system, over the storage of earlier factorisations.
    pub(crate) fn factor(&mut self, kernel: &impl Kernel<Factor = F, Value = T>) {
        let tree = kernel.tree();
        let entries = tree.fronts.iter().map(|front| kernel.entries(front)).sum();
        self.values.resize(entries, T::default());
        self.fronts.clear();
        self.fronts.resize(tree.fronts.len(), F::default());
        let small = (tree.flops() * SEQUENTIAL_SHARE).max(SEQUENTIAL_FLOPS);
        let run = Run {
            kernel,
            pool: &self.pool,
            small,
        };
        let (_, subtrees) = run.split(&tree.roots, &mut self.values, &mut self.fronts);
        subtrees.into_par_iter().for_each(|subtree| {
            let delivered = run.subtree(subtree);
            run.pool.give(delivered.values);
        });
    }
}

struct Run<'a, K: Kernel> {
    kernel: &'a K,
    pool: &'a Pool<K::Value>,
    small: f64,
}

/// A subtree and the storage of its fronts.
struct Subtree<'a, K: Kernel> {
    root: usize,
    values: &'a mut [K::Value],
    fronts: &'a mut [K::Factor],
}

impl<K: Kernel> Run<'_, K> {
    /// Storage of the subtrees with the given roots, in front of what is left of it.
    fn split<'b>(
        &self,
        roots: &[u32],
        mut values: &'b mut [K::Value],
        mut fronts: &'b mut [K::Factor],
    ) -> (Subtree<'b, K>, Vec<Subtree<'b, K>>) {
        let tree = self.kernel.tree();
        let mut subtrees = Vec::with_capacity(roots.len());
        for &root in roots {
            let range = tree.subtree(root as usize);
            let entries = tree.fronts[range.clone()]
                .iter()
                .map(|front| self.kernel.entries(front))
                .sum();
            let (own, rest) = values.split_at_mut(entries);
            values = rest;
            let (own_fronts, rest) = fronts.split_at_mut(range.len());
            fronts = rest;
            subtrees.push(Subtree {
                root: root as usize,
                values: own,
                fronts: own_fronts,
            });
        }
        (
            Subtree {
                root: usize::MAX,
                values,
                fronts,
            },
            subtrees,
        )
    }

    /// Factors a subtree.
    fn subtree(&self, subtree: Subtree<'_, K>) -> Delivered<K::Value> {
        let tree = self.kernel.tree();
        let front = &tree.fronts[subtree.root];
        if front.subtree_flops <= self.small || front.children.is_empty() {
            return self.sequential(subtree);
        }
        let root = subtree.root;
        let (own, below) = self.split(&front.children, subtree.values, subtree.fronts);
        let delivered: Vec<Delivered<K::Value>> = below
            .into_par_iter()
            .map(|child| self.subtree(child))
            .collect();
        let children: Vec<Child<'_, K::Value>> = front
            .children
            .iter()
            .zip(&delivered)
            .map(|(&c, delivered)| Child {
                front: &tree.fronts[c as usize],
                contribution: &delivered.contribution,
                values: &delivered.values,
            })
            .collect();
        let mut rest = self.pool.take(front.rest() * front.rest());
        let (factor, contribution) = self.kernel.factor(root, &children, own.values, &mut rest);
        drop(children);
        delivered
            .into_iter()
            .for_each(|child| self.pool.give(child.values));
        if contribution.delayed() > 0 {
            let mut all = self.pool.take(contribution.size * contribution.size);
            self.kernel
                .with_delayed(&factor, own.values, &rest, &mut all);
            self.pool.give(std::mem::replace(&mut rest, all));
        }
        own.fronts[0] = factor;
        Delivered {
            contribution,
            values: rest,
        }
    }

    /// Factors a subtree front by front, contributions on a stack.
    fn sequential(&self, subtree: Subtree<'_, K>) -> Delivered<K::Value> {
        let tree = self.kernel.tree();
        let mut stack = self.pool.take_empty(tree.fronts[subtree.root].stack);
        let mut waiting: Vec<(usize, Contribution)> = Vec::new();
        let mut storage = subtree.values;
        for (f, slot) in tree.subtree(subtree.root).zip(subtree.fronts) {
            let front = &tree.fronts[f];
            let (planned, others) = storage.split_at_mut(self.kernel.entries(front));
            storage = others;
            let first = waiting.len() - front.children.len();
            let top = stack.len();
            stack.resize(top + front.rest() * front.rest(), K::Value::default());
            let (old, rest) = stack.split_at_mut(top);
            let waiting_here = front.children.iter().zip(&waiting[first..]);
            let children: Vec<Child<'_, K::Value>> = waiting_here
                .map(|(&c, (offset, contribution))| Child {
                    front: &tree.fronts[c as usize],
                    contribution,
                    values: &old[*offset..][..contribution.size * contribution.size],
                })
                .collect();
            let (factor, contribution) = self.kernel.factor(f, &children, planned, rest);
            let mut begin = top;
            if contribution.delayed() > 0 {
                begin = stack.len();
                stack.resize(
                    begin + contribution.size * contribution.size,
                    K::Value::default(),
                );
                let (old, all) = stack.split_at_mut(begin);
                self.kernel.with_delayed(&factor, planned, &old[top..], all);
            }
            let base = waiting.get(first).map_or(top, |&(offset, _)| offset);
            let end = stack.len();
            stack.copy_within(begin..end, base);
            stack.truncate(base + end - begin);
            waiting.truncate(first);
            waiting.push((base, contribution));
            *slot = factor;
        }
        let contribution = waiting
            .pop()
            .map(|(_, contribution)| contribution)
            .unwrap_or_default();
        let mut values = self.pool.take_empty(stack.len());
        values.extend_from_slice(&stack);
        self.pool.give(stack);
        Delivered {
            contribution,
            values,
        }
    }
}

impl<T: Real> Pool<T> {
    /// A buffer of zeros.
    fn take(&self, length: usize) -> Vec<T> {
        let mut buffer = self.take_empty(length);
        buffer.resize(length, T::default());
        buffer
    }

    /// An empty buffer with some capacity: the smallest that fits, or a new one.
    fn take_empty(&self, capacity: usize) -> Vec<T> {
        let Ok(mut free) = self.0.lock() else {
            return Vec::with_capacity(capacity);
        };
        // Sorted by rising capacity; a much too large one is worth more elsewhere.
        let found = free.partition_point(|buffer| buffer.capacity() < capacity);
        match free.get(found) {
            Some(buffer) if buffer.capacity() / 4 <= capacity => return free.remove(found),
            _ if found > 0 => drop(free.remove(found - 1)),
            _ => {}
        }
        Vec::with_capacity(capacity)
    }

    /// Takes a buffer back.
    fn give(&self, mut buffer: Vec<T>) {
        buffer.clear();
        if let Ok(mut free) = self.0.lock() {
            let place = free.partition_point(|other| other.capacity() < buffer.capacity());
            free.insert(place, buffer);
        }
    }
}
