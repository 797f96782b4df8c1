//! Elimination of columns, and the contest for what is left.

use std::collections::{BTreeMap, BTreeSet};

use nalgebra::{DMatrix, DVector, Matrix2, SymmetricEigen, Vector2};
use striae_mesh::Vec3;

use super::DETERMINED;
use crate::{
    moved_pair::{Column, product},
    slip_freedom::SlipFreedom,
};

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
    fn look(&mut self, products: &DMatrix<f64>, place: &BTreeMap<u32, usize>) {
        for (a, at_a) in &self.contested {
            for (b, at_b) in &self.contested {
                let product = products[(place[at_a], place[at_b])];
                self.beside_pressures += a * b.transpose() * product;
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
        let contested: Vec<u32> = nodes
            .iter()
            .flat_map(|node| node.contested.iter().map(|(_, column)| *column))
            .collect();
        if contested.is_empty() {
            return;
        }
        let [beside_pressures, mut remainder] = self.remainders(&contested);
        let place: BTreeMap<u32, usize> = contested.iter().copied().zip(0..).collect();
        nodes
            .iter_mut()
            .for_each(|node| node.look(&beside_pressures, &place));
        for closed in [true, false] {
            let of_part = |node: &&mut Node| node.is_closed == closed && !node.contested.is_empty();
            let mut left: Vec<&mut Node> = nodes.iter_mut().filter(of_part).collect();
            while let Some((at, direction)) = largest(&left, &remainder, &place) {
                let node = &mut left[at];
                eliminate(&mut remainder, node, &direction, &place);
                let kept = node
                    .contested
                    .iter()
                    .zip(direction.iter())
                    .map(|((along, _), by)| along * *by)
                    .sum();
                node.kept.push(kept);
            }
        }
    }

    /// Products of the contested columns after elimination of the pressures near them, and of
    /// undisturbed friction, too.
    fn remainders(&self, contested: &[u32]) -> [DMatrix<f64>; 2] {
        let mut users: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
        for (at, column) in self
            .columns
            .iter()
            .enumerate()
            .filter(|(at, _)| self.turns[*at] != Turn::Contested)
        {
            for number in column.keys() {
                users.entry(*number).or_default().push(at as u32);
            }
        }
        let mut near = BTreeSet::new();
        let mut rim: Vec<u32> = contested.to_vec();
        for _ in 0..REACH {
            let mut found = BTreeSet::new();
            for &at in &rim {
                let of = |number: &u32| users.get(number).into_iter().flatten().copied();
                let candidates: BTreeSet<u32> =
                    self.columns[at as usize].keys().flat_map(of).collect();
                found.extend(candidates.into_iter().filter(|&other| {
                    !near.contains(&other) && self.product(at, other).abs() > APART
                }));
            }
            near.extend(found.iter().copied());
            rim = found.into_iter().collect();
        }
        let mut near: Vec<u32> = near.into_iter().collect();
        near.sort_by_key(|&at| (self.turns[at as usize], at));
        let pressures = near.partition_point(|&at| self.turns[at as usize] == Turn::Pressure);
        let between = |rows: &[u32], columns: &[u32]| {
            DMatrix::from_fn(rows.len(), columns.len(), |i, j| {
                self.product(rows[i], columns[j])
            })
        };
        let own = between(contested, contested);
        let mut eliminated = between(&near, &near);
        let shift = DEPENDENT * eliminated.diagonal().iter().copied().fold(0.0, f64::max);
        (0..near.len()).for_each(|at| eliminated[(at, at)] += shift);
        match eliminated.cholesky() {
            Some(factor) if !near.is_empty() => {
                let solved = factor
                    .l_dirty()
                    .solve_lower_triangular(&between(&near, contested))
                    .unwrap_or_else(|| DMatrix::zeros(near.len(), contested.len()));
                let of_pressures = solved.rows_range(..pressures);
                let others = solved.rows_range(pressures..);
                let beside_pressures = own - of_pressures.tr_mul(&of_pressures);
                let remainder = &beside_pressures - others.tr_mul(&others);
                [beside_pressures, remainder]
            }
            Some(_) | None => [own.clone(), own],
        }
    }

    fn product(&self, a: u32, b: u32) -> f64 {
        product(&self.columns[a as usize], &self.columns[b as usize])
    }
}

/// The node with the largest eigenvalue of its remainder, if that determines anything, and the
/// eigenvector by its contested directions.
fn largest(
    nodes: &[&mut Node],
    remainder: &DMatrix<f64>,
    place: &BTreeMap<u32, usize>,
) -> Option<(usize, DVector<f64>)> {
    let mut best: Option<(f64, usize, DVector<f64>)> = None;
    for (at, node) in nodes.iter().enumerate() {
        let rows: Vec<usize> = node
            .contested
            .iter()
            .map(|(_, column)| place[column])
            .collect();
        let block = DMatrix::from_fn(rows.len(), rows.len(), |i, j| remainder[(rows[i], rows[j])]);
        let eigen = SymmetricEigen::new(block);
        let (most, value) = eigen.eigenvalues.argmax();
        let threshold = best
            .as_ref()
            .map_or(DETERMINED, |best| best.0 * (1.0 + EQUAL));
        if value >= threshold {
            best = Some((value, at, eigen.eigenvectors.column(most).into()));
        }
    }
    best.map(|(_, at, direction)| (at, direction))
}

/// Takes a direction of a node out of the remainder.
fn eliminate(
    remainder: &mut DMatrix<f64>,
    node: &Node,
    direction: &DVector<f64>,
    place: &BTreeMap<u32, usize>,
) {
    let mut column = DVector::zeros(remainder.nrows());
    for ((_, at), by) in node.contested.iter().zip(direction.iter()) {
        column += remainder.column(place[at]) * *by;
    }
    let rows = node.contested.iter().zip(direction.iter());
    let pivot: f64 = rows.map(|((_, at), by)| by * column[place[at]]).sum();
    remainder.ger(-1.0 / pivot, &column, &column, 1.0);
}
