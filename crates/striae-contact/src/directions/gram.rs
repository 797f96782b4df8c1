//! Elimination of columns, and the contest for what is left.

use std::{
    cmp::Reverse,
    collections::{BTreeSet, BinaryHeap},
};

use nalgebra::{DMatrix, DVector, Matrix2, SymmetricEigen, Vector2};
use striae_mesh::Vec3;

use super::{DETERMINED, remainder::Remainder};
use crate::{moved_pair::Column, slip_freedom::SlipFreedom};

/// Difference of eigenvalues below which the first of two nodes goes first, over them.
const EQUAL: f64 = 1e-9;
/// Couplings from contested columns to the last ones that count.
const REACH: usize = 2;
/// Coupling below which two columns are at right angles, over their lengths.
const APART: f64 = 1e-12;
/// Addition to the diagonal of what is eliminated first, over its largest entry, for pressures
/// that depend on each other.
const DEPENDENT: f64 = 1e-10;

/// A kept node in the contest.
pub(super) struct Node {
    pub(super) is_closed: bool,
    /// Directions that are kept.
    pub(super) kept: Vec<Vector2<f64>>,
    /// Directions that are contested, and their columns.
    pub(super) contested: Vec<(Vector2<f64>, u32)>,
    /// Products of the contested directions, along the tangents, after elimination of pressures
    /// alone.
    pub(super) beside_pressures: Matrix2<f64>,
}

impl Node {
    /// The directions that are kept.
    pub(super) fn freedom(&self) -> SlipFreedom {
        match self.kept.as_slice() {
            [] => SlipFreedom::Held,
            [direction] => SlipFreedom::Line([direction.x, direction.y]),
            _ => SlipFreedom::Plane,
        }
    }

    /// Returns whether pressures leave a direction along the tangents that was contested.
    pub(super) fn is_left(&self, direction: &Vector2<f64>) -> bool {
        direction.dot(&(self.beside_pressures * direction)) >= DETERMINED
    }

    /// Fills in what pressures leave, by the products of all contested columns.
    fn look(&mut self, products: &Remainder) {
        for (a, at_a) in &self.contested {
            for (b, at_b) in &self.contested {
                self.beside_pressures += a * b.transpose() * products.entry(*at_a, *at_b);
            }
        }
    }
}

/// Turn of a column in the contest.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Turn {
    /// Pressure of a closed node: eliminated before all others.
    Pressure,
    /// Friction that nothing disturbs: eliminated next.
    Undisturbed,
    /// Friction that is contested.
    Contested,
}

/// Sum of the columns of both tangents along a direction.
pub(super) fn combination(columns: &[Column; 2], by: &Vector2<f64>) -> Column {
    let mut sum = Column::new();
    for (column, by) in columns.iter().zip(by.iter()) {
        for (number, value) in column {
            *sum.entry(*number).or_insert_with(Vec3::zeros) += value * *by;
        }
    }
    sum
}

/// Columns and their products.
#[derive(Default)]
pub(super) struct Gram {
    pub(super) columns: Vec<Column>,
    turns: Vec<Turn>,
}

impl Gram {
    pub(super) fn push(&mut self, column: Column, turn: Turn) {
        self.columns.push(column);
        self.turns.push(turn);
    }

    /// Decides which contested directions are kept.
    pub(super) fn contest(&self, nodes: &mut [Node]) {
        let contested = nodes.iter().flat_map(|node| &node.contested);
        let contested: Vec<u32> = contested.map(|(_, column)| *column).collect();
        if contested.is_empty() {
            return;
        }
        let columns: Vec<&Column> = self.columns.iter().collect();
        let mut remainder = Remainder::new(&columns);
        let near = self.near(&contested, &remainder);
        let concerned: BTreeSet<u32> = near.iter().chain(&contested).copied().collect();
        remainder.restrict(&concerned);
        let diagonal = near.iter().map(|&at| remainder.entry(at, at));
        let shift = DEPENDENT * diagonal.fold(0.0, f64::max);
        near.iter().for_each(|&at| remainder.shift(at, shift));
        let pressures = near.partition_point(|&at| self.turns[at as usize] == Turn::Pressure);
        let (pressures, undisturbed) = near.split_at(pressures);
        let eliminate = |remainder: &mut Remainder, part: &[u32]| {
            for &at in part {
                remainder.eliminate(&[(at, 1.0)]);
                remainder.forget(at);
            }
        };
        eliminate(&mut remainder, pressures);
        nodes.iter_mut().for_each(|node| node.look(&remainder));
        eliminate(&mut remainder, undisturbed);
        for closed in [true, false] {
            let of_part = |node: &&mut Node| node.is_closed == closed && !node.contested.is_empty();
            let mut left: Vec<&mut Node> = nodes.iter_mut().filter(of_part).collect();
            let mut queue = Queue::new(&left, &remainder);
            while let Some((at, direction)) = queue.largest(&left, &remainder) {
                let node = &mut left[at];
                let columns = node.contested.iter().zip(direction.iter());
                let by_columns: Vec<(u32, f64)> =
                    columns.clone().map(|((_, at), by)| (*at, *by)).collect();
                remainder.eliminate(&by_columns);
                let kept = columns.map(|((along, _), by)| along * *by).sum();
                node.kept.push(kept);
                queue.push(at, largest(node, &remainder).0);
            }
        }
    }

    /// Pressures and then undisturbed friction that are at most [`REACH`] couplings away.
    fn near(&self, contested: &[u32], products: &Remainder) -> Vec<u32> {
        let mut near = BTreeSet::new();
        let mut rim: Vec<u32> = contested.to_vec();
        for _ in 0..REACH {
            let coupled = rim.iter().flat_map(|&at| products.row(at));
            let coupled = coupled.filter(|(_, product)| product.abs() > APART);
            let others = coupled.filter(|(at, _)| self.turns[*at as usize] != Turn::Contested);
            let found: BTreeSet<u32> = others.map(|(at, _)| *at).collect();
            rim = found.difference(&near).copied().collect();
            near.extend(rim.iter().copied());
        }
        let mut near: Vec<u32> = near.into_iter().collect();
        near.sort_by_key(|&at| (self.turns[at as usize], at));
        near
    }
}

/// The largest eigenvalue of the remainder of a node, and its eigenvector by its contested
/// directions.
fn largest(node: &Node, remainder: &Remainder) -> (f64, DVector<f64>) {
    let at = |i: usize| node.contested[i].1;
    let count = node.contested.len();
    let block = DMatrix::from_fn(count, count, |i, j| remainder.entry(at(i), at(j)));
    let eigen = SymmetricEigen::new(block);
    let (most, value) = eigen.eigenvalues.argmax();
    (value, eigen.eigenvectors.column(most).into())
}

/// Nodes by the bits of their largest eigenvalues, which are in the order of the values as none is
/// negative. Eigenvalues only fall, so that old ones are bounds.
struct Queue(BinaryHeap<(u64, Reverse<usize>)>);

impl Queue {
    fn new(nodes: &[&mut Node], remainder: &Remainder) -> Self {
        let mut queue = Self(BinaryHeap::with_capacity(nodes.len()));
        for (at, node) in nodes.iter().enumerate() {
            queue.push(at, largest(node, remainder).0);
        }
        queue
    }

    /// Queues a node up if its eigenvalue determines anything.
    fn push(&mut self, at: usize, value: f64) {
        if value >= DETERMINED {
            self.0.push((value.to_bits(), Reverse(at)));
        }
    }

    /// Takes the node with the largest eigenvalue, of equal ones the first, and its eigenvector.
    fn largest(
        &mut self,
        nodes: &[&mut Node],
        remainder: &Remainder,
    ) -> Option<(usize, DVector<f64>)> {
        let mut equals: Vec<(usize, f64)> = Vec::new();
        while let Some((bits, Reverse(at))) = self.0.pop() {
            let bound = f64::from_bits(bits);
            let most = equals.iter().map(|(_, value)| *value).fold(0.0, f64::max);
            if bound * (1.0 + EQUAL) < most {
                self.push(at, bound);
                break;
            }
            let value = largest(nodes[at], remainder).0;
            if value < bound {
                self.push(at, value);
            } else {
                equals.push((at, value));
            }
        }
        let first = equals.iter().map(|(at, _)| *at).min()?;
        for (at, value) in equals.into_iter().filter(|(at, _)| *at != first) {
            self.push(at, value);
        }
        Some((first, largest(nodes[first], remainder).1))
    }
}
