//! Pressures of several pairs that hold the same positions.
//!
//! Every pair chooses its kept nodes alone ([`crate::roles`]). Where two pairs end beside each other
//! on one body, both keep the nodes of the border, and together they have more pressures than there
//! are positions to answer to them: faces of a block that stand on one rigid plane in two pairs, a
//! strip of a facet that belongs to the next pair. With the actions `f_k` of the pressures of all
//! pairs on what positions are free ([`crate::moved_pair`]),
//!
//! ```text
//! S_kl = f_k . f_l,   d_k = S_kk - S_kn S_nn^-1 S_nk,   n: kept nodes of all pairs that couple with k
//! ```
//!
//! Nodes whose pressures act on positions on which pressures of other pairs act, too, are kept by the
//! largest pivot next, while
//!
//! ```text
//! d_k >= THETA_0 min(1, 4 S_kk)
//! ```
//!
//! `1/4` is the pivot of an interior node: one on the only sliver of a patch goes where others do what
//! it does, not where it is small. Nodes that touch come first, so that faces that are only near
//! each other take nothing from what is pressed. Those kept in the last increment have no advantage,
//! other than in the choice of a pair: a pair that is entered could keep none where one that is left
//! had all of them. A node that this rule would drop in its pair alone stays, as its own pair has
//! decided on it. Pressures are vectors, so walls at right angles take nothing from each other. Nor
//! do those of different pairs that push a body against each other: as no pressure is negative,
//! neither can do what the other one does, and `S_kl` is zero where it would be negative.
//!
//! Null vectors of a mass matrix fade by .27 from node to node: nodes further than two couplings
//! from a shared one have no effect.

use std::collections::{BTreeMap, BTreeSet};

use striae_mesh::Vec3;
use striae_surface::node::SurfaceNode;

use crate::{
    common_mass::{SparseRow, SparseSum},
    contest::{Candidate, Contest, from_the_middle},
    moved_pair::{Column, MovedPair},
    pair::Enforcement,
    pivots::Pivots,
    roles::{INTERIOR, THETA_0},
    selection::Kept,
    traction_basis::KeptNode,
};

/// Couplings from a shared node to the last that count.
const REACH: usize = 2;

/// Kept nodes that remain by pair; `None` for a pair that loses none.
pub fn independent(pairs: &[MovedPair]) -> Vec<Option<Kept>> {
    if !share(pairs) {
        return vec![None; pairs.len()];
    }
    let nodes = nodes(pairs);
    let columns = Columns::new(nodes.iter().map(|node| &node.column));
    let contested: BTreeSet<u32> = columns.of_several(|k| nodes[k as usize].pair).collect();
    if contested.is_empty() {
        return vec![None; pairs.len()];
    }
    let near = columns.near(&contested);
    let mut products = columns.products(&near);
    for (k, row) in products.iter_mut().enumerate() {
        let pair_of = |k: usize| nodes[k].pair;
        row.retain(|&(l, product)| product > 0.0 || pair_of(l as usize) == pair_of(k));
    }
    let chosen = |among: &BTreeSet<u32>, products: Vec<SparseRow>| -> BTreeSet<u32> {
        let mut pivots = Pivots::new(products);
        let sizes: Vec<f64> = (0..nodes.len() as u32).map(|k| pivots.bound(k)).collect();
        let mut kept = BTreeSet::new();
        for touches in [true, false] {
            let is_due = |&k: &u32| nodes[k as usize].touches == touches;
            near.difference(&contested)
                .copied()
                .filter(is_due)
                .for_each(|k| pivots.keep(k));
            let due: Vec<u32> = among.iter().copied().filter(is_due).collect();
            let won = contest(&nodes, &due, &sizes).greedy(&mut pivots);
            kept.extend(won.iter().map(|&(k, _)| k));
        }
        kept
    };
    let alone = chosen(&contested, within_pairs(&nodes, &products));
    let kept = chosen(&alone, products);
    let mut remaining = vec![None; pairs.len()];
    for &k in alone.difference(&kept) {
        let Node { pair, kept, .. } = nodes[k as usize];
        let of_pair = remaining[pair].get_or_insert_with(|| pairs[pair].selection.kept_nodes());
        of_pair[kept.side][kept.node] = false;
    }
    remaining
}

/// A kept node.
struct Node {
    pair: usize,
    kept: KeptNode,
    /// Position and weight.
    place: (Vec3, f64),
    /// A segment of it touches.
    touches: bool,
    column: Column,
}

/// Kept nodes of the pairs that share the same nodes of bodies with others.
fn nodes(pairs: &[MovedPair]) -> Vec<Node> {
    let mut nodes = Vec::new();
    for (pair, of) in pairs.iter().enumerate().filter(|(_, of)| competes(of)) {
        let MovedPair {
            configuration,
            selection,
            ..
        } = of;
        let kept = selection.kept().iter().enumerate().zip(of.actions());
        nodes.extend(kept.map(|((k, kept), actions)| {
            let (side, node) = kept.place();
            Node {
                pair,
                kept: *kept,
                place: (configuration.side(side).x[node], selection.weight(k)),
                touches: actions.touches,
                column: actions.column(0),
            }
        }));
    }
    nodes
}

/// Returns whether the pressures of a pair are unknowns of a common field.
fn competes(pair: &MovedPair) -> bool {
    pair.configuration.pair.enforcement == Enforcement::Weighted
}

/// Returns whether several pairs carry traction at a position, which is cheaper to find than actions.
fn share(pairs: &[MovedPair]) -> bool {
    let mut held_by = BTreeMap::new();
    for (pair, of) in pairs.iter().enumerate().filter(|(_, of)| competes(of)) {
        for &side in of.configuration.pair.deformable_sides() {
            for (node, mover) in of.movers[side].iter().enumerate() {
                let carries = of.selection.carries(side, SurfaceNode::new(node));
                if carries
                    && !mover.is_rigid()
                    && *held_by.entry(mover.number).or_insert(pair) != pair
                {
                    return true;
                }
            }
        }
    }
    false
}

/// Products of unknowns of the same pair.
fn within_pairs(nodes: &[Node], products: &[SparseRow]) -> Vec<SparseRow> {
    let own = |(k, row): (usize, &SparseRow)| {
        let same = |&&(l, _): &&(u32, f64)| nodes[l as usize].pair == nodes[k].pair;
        row.iter().filter(same).copied().collect()
    };
    products.iter().enumerate().map(own).collect()
}

/// Actions of the pressures.
struct Columns<'a> {
    of: Vec<&'a Column>,
    /// Unknowns and their forces by number of the position.
    on: BTreeMap<u32, Vec<(u32, Vec3)>>,
}

impl<'a> Columns<'a> {
    fn new(columns: impl Iterator<Item = &'a Column>) -> Self {
        let of: Vec<&Column> = columns.collect();
        let mut on: BTreeMap<u32, Vec<(u32, Vec3)>> = BTreeMap::new();
        for (k, column) in (0..).zip(&of) {
            for (&number, force) in *column {
                on.entry(number).or_default().push((k, *force));
            }
        }
        Self { of, on }
    }

    /// Unknowns that act on a position on which those of another pair act.
    fn of_several(&self, pair_of: impl Fn(u32) -> usize) -> impl Iterator<Item = u32> {
        let several = self.on.values().filter(move |on| {
            let first = pair_of(on[0].0);
            on.iter().any(|&(k, _)| pair_of(k) != first)
        });
        several.flatten().map(|&(k, _)| k)
    }

    /// Given unknowns and those up to [`REACH`] couplings away.
    fn near(&self, given: &BTreeSet<u32>) -> BTreeSet<u32> {
        let mut near = given.clone();
        let mut rim = given.clone();
        for _ in 0..REACH {
            let of_rim = rim.iter().flat_map(|&k| self.of[k as usize].keys());
            let coupled = of_rim.flat_map(|number| self.on[number].iter().map(|&(k, _)| k));
            rim = coupled.filter(|k| !near.contains(k)).collect();
            near.extend(&rim);
        }
        near
    }

    /// Rows of `S` among given unknowns; others have none.
    fn products(&self, among: &BTreeSet<u32>) -> Vec<SparseRow> {
        let mut sum = SparseSum::new(self.of.len());
        let row = |k: u32| {
            if !among.contains(&k) {
                return SparseRow::new();
            }
            for (number, own) in self.of[k as usize] {
                for (l, force) in self.on[number].iter().filter(|(l, _)| among.contains(l)) {
                    sum.add(*l, own.dot(force));
                }
            }
            sum.take()
        };
        (0..self.of.len() as u32).map(row).collect()
    }
}

/// Contest of some nodes, with the `S_kk` of all.
fn contest(nodes: &[Node], among: &[u32], sizes: &[f64]) -> Contest {
    let of = |at: usize| &nodes[among[at] as usize];
    let places: Vec<_> = (0..among.len()).map(|at| of(at).place).collect();
    let order = from_the_middle(&places, |at| (of(at).pair, of(at).kept.place()));
    let candidate = |at: usize| Candidate {
        node: among[at],
        factor: 1.0,
        least: THETA_0 * (sizes[among[at] as usize] / INTERIOR).min(1.0),
    };
    Contest::new(order.into_iter().map(candidate).collect())
}
