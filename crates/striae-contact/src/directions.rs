//! The directions in which friction of kept nodes is determined.
//!
//! Where displacements are prescribed on both sides, or several pairs hold one node, positions
//! are left that answer to fewer tractions than there are unknowns: a plane of symmetry, the
//! edge along which two planes meet. With the positions `J` that contact moves, `P_J` that
//! removes the prescribed components and `kappa_J` of [`crate::roles`], the unknowns of a kept
//! node `k` act by the columns
//!
//! ```text
//! pressure   f_Jk  = sqrt(kappa_J) P_J sum_segments (+-) D_kJ n                / sqrt(w_k l_k)
//! friction   f_Jka = sqrt(kappa_J) P_J sum_segments (+-) D_kJ R(n, n_k) t_a    / sqrt(w_k l_k)
//! D_kJ = integral phi_k N_J
//! ```
//!
//! and `S = f^T f` is the Gram matrix of all columns of all pairs, with pivots of the scale of
//! those of the roles. Pressures of closed nodes go first; then the directions that nothing
//! disturbs; what is left is *contested*. Of the contested nodes that one is taken next whose
//! 2x2 remainder after elimination has the largest eigenvalue, and the direction of that
//! eigenvector is kept, while the eigenvalue is at least [`DETERMINED`]. Axis by axis would
//! depend on the frame.
//!
//! In a direction that is not kept the row of friction is `z = 0`, and slip there does not
//! count. Directions are components along the nodal tangents and constant in an increment.
//!
//! Null vectors of a mass matrix fade by .27 from node to node: columns further than
//! [`REACH`] couplings from a contested one bear on nothing.

use std::collections::{BTreeMap, BTreeSet};

use nalgebra::{DMatrix, DVector, Matrix2, SymmetricEigen, Vector2};
use striae_mesh::Vec3;
use striae_surface::node::SurfaceNode;

use crate::{
    configuration::Configuration,
    frame::frame_of,
    pairing::{Corners, SIGNS, paired_facets, side_sign},
    segment::SegmentDerivatives,
    selection::Selection,
    side::Side,
    transported::Transported,
};

/// Eigenvalue from which a direction is determined, in the scale of pivots.
const DETERMINED: f64 = 1e-4;
/// Part of its free eigenvalue that a direction has where nothing disturbs it.
const UNDISTURBED: f64 = 1.0 - 1e-6;
/// Difference of eigenvalues below which the first of two nodes goes first, over them.
const EQUAL: f64 = 1e-9;
/// Gap up to which a node touches, over the size of its segments.
const TOUCHING: f64 = 1e-6;
/// Couplings from contested columns to the last ones that count.
const REACH: usize = 2;
/// Coupling below which two columns are at right angles, over their lengths.
const APART: f64 = 1e-12;
/// What is added to the diagonal of what is eliminated first, where pressures depend on each
/// other, over its largest entry.
const DEPENDENT: f64 = 1e-10;

/// In which directions friction of a kept node is determined.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum SlipFreedom {
    /// In all.
    #[default]
    Plane,
    /// Along a unit vector, by its components along the tangents, and back.
    Line([f64; 2]),
    /// In none.
    Held,
}

/// A position that contact moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mover {
    /// The same number for the same node in all pairs.
    pub number: u32,
    /// Which components are prescribed.
    pub prescribed: [bool; 3],
}

/// A pair as it takes part in the choice.
pub struct Party<'a> {
    /// Where everything is.
    pub configuration: &'a Configuration<'a>,
    /// Roles.
    pub selection: &'a Selection,
    /// The nodes of the deformable sides.
    pub movers: [Vec<Mover>; 2],
    /// Which kept nodes are known to be closed; those that touch are closed, too.
    pub closed: Vec<bool>,
    /// Whether there is friction.
    pub has_friction: bool,
}

/// The directions of all kept nodes of all pairs; none where nothing is prescribed and no node is
/// in two pairs, so that all are determined.
pub fn slip_freedoms(parties: &[Party]) -> Option<Vec<Vec<SlipFreedom>>> {
    let disturbed = disturbed(parties)?;
    let mut gram = Gram::default();
    let mut nodes = Vec::new();
    for party in parties {
        for actions in actions(party) {
            nodes.push(Node::new(
                &actions,
                party.has_friction,
                &disturbed,
                &mut gram,
            ));
        }
    }
    gram.contest(&mut nodes);
    let mut freedoms = nodes.iter().map(Node::freedom);
    let of_party = |party: &Party| freedoms.by_ref().take(party.closed.len()).collect();
    Some(parties.iter().map(of_party).collect())
}

/// Numbers of movers that displacements hold in part or that several pairs move, and whether
/// pairs do; none if there are none, or no friction.
fn disturbed(parties: &[Party]) -> Option<BTreeMap<u32, bool>> {
    let mut pair_of = BTreeMap::new();
    let mut disturbed = BTreeMap::new();
    for (at, party) in parties.iter().enumerate() {
        for &side in party.configuration.pair.deformable_sides() {
            for (node, mover) in party.movers[side].iter().enumerate() {
                if !party.selection.carries(side, SurfaceNode::new(node)) {
                    continue;
                }
                let shared = *pair_of.entry(mover.number).or_insert(at) != at;
                if shared || mover.prescribed.contains(&true) {
                    *disturbed.entry(mover.number).or_insert(false) |= shared;
                }
            }
        }
    }
    let has_friction = parties.iter().any(|party| party.has_friction);
    (has_friction && !disturbed.is_empty()).then_some(disturbed)
}

/// How an unknown moves nodes, by their numbers.
type Column = BTreeMap<u32, Vec3>;

/// What the unknowns of a kept node do: pressure, then friction along both tangents.
#[derive(Clone, Default)]
struct Actions {
    /// By number of the mover, with prescribed components.
    whole: BTreeMap<u32, [Vec3; 3]>,
    /// Which components of the movers are free.
    free: BTreeMap<u32, Vec3>,
    is_closed: bool,
}

impl Actions {
    /// The part of an action that moves anything.
    fn column(&self, component: usize) -> Column {
        let free = |(number, whole): (&u32, &[Vec3; 3])| {
            (*number, whole[component].component_mul(&self.free[number]))
        };
        self.whole.iter().map(free).collect()
    }
}

/// Actions of the kept nodes of a pair.
fn actions(party: &Party) -> Vec<Actions> {
    let (configuration, selection) = (party.configuration, party.selection);
    let kept = selection.kept();
    let normals: Vec<_> = kept
        .iter()
        .map(|kept| frame_of(configuration, kept.side, kept.node))
        .collect();
    let of_kept = |is_closed: &bool| Actions {
        is_closed: *is_closed,
        ..Actions::default()
    };
    let mut actions: Vec<Actions> = party.closed.iter().map(of_kept).collect();
    let none = |_: &[Corners]| SegmentDerivatives::None;
    for paired in paired_facets(configuration, selection.scope(), &none, |_| true) {
        let n = paired.segment.normal;
        let corners: Vec<_> = (0..8)
            .filter_map(|corner| Some((corner, paired.node(configuration, corner)?)))
            .collect();
        let share = 1.0 / configuration.pair.deformable_sides().len() as f64;
        let mut shares: BTreeMap<u32, [f64; 8]> = BTreeMap::new();
        for &(corner, (side, node)) in &corners {
            for &(k, weight) in selection.row(side, node) {
                let of_kept = shares.entry(k).or_default();
                for (sum, mass) in of_kept.iter_mut().zip(&paired.segment.mass[corner]) {
                    *sum += share * weight * mass;
                }
            }
        }
        let touches = paired.least_gap(configuration) <= TOUCHING * paired.segment.area.sqrt();
        for (k, shares) in shares {
            actions[k as usize].is_closed |= touches;
            let (kept, frame) = (kept[k as usize], &normals[k as usize]);
            let seen = n * side_sign(kept.side);
            let turned = |axis: usize| {
                let t = &frame.t[axis].value;
                Transported::new(t, &frame.n.value, &seen).value
            };
            let directions = [n, turned(0), turned(1)];
            let scale = selection.weight(k as usize) * selection.basis.flexibility[k as usize];
            for &(corner, (side, node)) in &corners {
                let mover = &party.movers[side][node];
                let kappa = kappa(configuration, side, node);
                let by = SIGNS[corner] * shares[corner] * (kappa / scale).sqrt();
                if scale == 0.0 || by == 0.0 {
                    continue;
                }
                let whole = actions[k as usize].whole.entry(mover.number).or_default();
                for (sum, direction) in whole.iter_mut().zip(&directions) {
                    *sum += direction * by;
                }
                let free = mover.prescribed.map(|held| f64::from(u8::from(!held)));
                actions[k as usize].free.insert(mover.number, free.into());
            }
        }
    }
    actions
}

/// `1/(E h)` at a node.
fn kappa(configuration: &Configuration, side: Side, node: SurfaceNode) -> f64 {
    (configuration.pair.sides[side].stiffness * configuration.size(side, node)).recip()
}

/// A kept node in the contest.
struct Node {
    is_closed: bool,
    /// Directions that are kept.
    kept: Vec<Vector2<f64>>,
    /// Directions that are contested, and their columns.
    contested: Vec<(Vector2<f64>, u32)>,
}

impl Node {
    fn new(
        actions: &Actions,
        has_friction: bool,
        disturbed: &BTreeMap<u32, bool>,
        gram: &mut Gram,
    ) -> Self {
        let mut node = Self {
            is_closed: actions.is_closed,
            kept: Vec::new(),
            contested: Vec::new(),
        };
        if node.is_closed {
            gram.push(actions.column(0), true);
        }
        let tangents = [actions.column(1), actions.column(2)];
        let disturbs = actions
            .whole
            .keys()
            .filter_map(|number| disturbed.get(number));
        let (mut is_disturbed, mut is_shared) = (false, false);
        for shared in disturbs {
            is_disturbed = true;
            is_shared |= shared;
        }
        if !has_friction || !is_disturbed {
            node.kept = vec![Vector2::x(), Vector2::y()];
            if node.is_closed && has_friction {
                tangents
                    .into_iter()
                    .for_each(|tangent| gram.push(tangent, true));
            }
            return node;
        }
        let undisturbed: f64 = actions
            .whole
            .values()
            .map(|whole| whole[1].norm_squared())
            .sum();
        let block = Matrix2::from_fn(|i, j| product(&tangents[i], &tangents[j]));
        let eigen = SymmetricEigen::new(block);
        for (value, vector) in eigen
            .eigenvalues
            .iter()
            .zip(eigen.eigenvectors.column_iter())
        {
            let direction = Vector2::new(vector[0], vector[1]);
            let column = || combination(&tangents, &direction);
            if *value >= UNDISTURBED * undisturbed && !is_shared {
                node.kept.push(direction);
                if node.is_closed {
                    gram.push(column(), true);
                }
            } else if *value >= DETERMINED {
                node.contested.push((direction, gram.columns.len() as u32));
                gram.push(column(), false);
            }
        }
        node
    }

    fn freedom(&self) -> SlipFreedom {
        match self.kept.as_slice() {
            [] => SlipFreedom::Held,
            [direction] => SlipFreedom::Line([direction.x, direction.y]),
            _ => SlipFreedom::Plane,
        }
    }
}

fn product(a: &Column, b: &Column) -> f64 {
    let common = a
        .iter()
        .filter_map(|(number, a)| Some(a.dot(b.get(number)?)));
    common.sum()
}

fn combination(columns: &[Column; 2], by: &Vector2<f64>) -> Column {
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
struct Gram {
    columns: Vec<Column>,
    /// Whether a column is eliminated before the contest.
    first: Vec<bool>,
}

impl Gram {
    fn push(&mut self, column: Column, first: bool) {
        self.columns.push(column);
        self.first.push(first);
    }

    /// Decides which contested directions are kept.
    fn contest(&self, nodes: &mut [Node]) {
        let contested: Vec<u32> = nodes
            .iter()
            .flat_map(|node| node.contested.iter().map(|(_, column)| *column))
            .collect();
        if contested.is_empty() {
            return;
        }
        let mut remainder = self.remainder(&contested);
        let place: BTreeMap<u32, usize> = contested.iter().copied().zip(0..).collect();
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

    /// Products of the contested columns after elimination of the first ones near them.
    fn remainder(&self, contested: &[u32]) -> DMatrix<f64> {
        let mut users: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
        for (at, column) in self
            .columns
            .iter()
            .enumerate()
            .filter(|(at, _)| self.first[*at])
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
        let near: Vec<u32> = near.into_iter().collect();
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
                own - solved.tr_mul(&solved)
            }
            Some(_) | None => own,
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
