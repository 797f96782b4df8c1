//! Nodes that follow nodes that follow: their order, and what they come to follow.

use std::collections::{BTreeMap, BTreeSet};

use super::{Follower, TieFault};
use crate::model::Model;

/// Followers with their weights, by node, and by component an order of them in which none
/// comes before those that it follows.
pub(super) fn resolved(
    model: &Model,
    mut followers: Vec<Follower>,
) -> Result<(Vec<Follower>, [Vec<usize>; 3]), Vec<TieFault>> {
    followers.sort_by_key(|follower| follower.node);
    let of_node: BTreeMap<usize, usize> = followers
        .iter()
        .enumerate()
        .map(|(at, follower)| (follower.node, at))
        .collect();
    let mut orders = [const { Vec::new() }; 3];
    for (axis, order) in orders.iter_mut().enumerate() {
        *order = ordered(model, &followers, &of_node, axis).map_err(|fault| vec![fault])?;
        for &at in &*order {
            let row = followers[at].row[axis].as_deref().unwrap_or_default();
            let weights = resolved_row(row, |node| {
                let at = of_node.get(&node)?;
                followers[*at].weights[axis].as_deref()
            });
            followers[at].weights[axis] = Some(weights);
        }
    }
    Ok((followers, orders))
}

/// A row in terms of nodes that do not follow, with what those follow that do.
fn resolved_row<'a>(
    row: &[(usize, f64)],
    followed: impl Fn(usize) -> Option<&'a [(usize, f64)]>,
) -> Vec<(usize, f64)> {
    let mut sums: BTreeMap<usize, f64> = BTreeMap::new();
    for &(node, weight) in row {
        let itself = [(node, 1.0)];
        for &(other, share) in followed(node).unwrap_or(&itself) {
            *sums.entry(other).or_insert(0.0) += weight * share;
        }
    }
    sums.into_iter().collect()
}

/// Positions of those that follow in a component, in such an order.
fn ordered(
    model: &Model,
    followers: &[Follower],
    of_node: &BTreeMap<usize, usize>,
    axis: usize,
) -> Result<Vec<usize>, TieFault> {
    let follows = |at: &usize| followers[*at].row[axis].is_some();
    let waits_for = |at: usize| {
        let row = followers[at].row[axis].iter().flatten();
        let known = row.filter_map(|(node, _)| of_node.get(node).copied());
        known.filter(follows).collect::<Vec<usize>>()
    };
    let mut left: Vec<(usize, Vec<usize>)> = (0..followers.len())
        .filter(follows)
        .map(|at| (at, waits_for(at)))
        .collect();
    let (mut order, mut done) = (Vec::new(), vec![false; followers.len()]);
    while !left.is_empty() {
        let (ready, waiting): (Vec<_>, Vec<_>) = left
            .into_iter()
            .partition(|(_, others)| others.iter().all(|&other| done[other]));
        if ready.is_empty() {
            let ties: BTreeSet<usize> = waiting.iter().map(|(at, _)| followers[*at].tie).collect();
            let ties = ties.iter().map(|&tie| model.ties[tie].name.clone());
            return Err(TieFault::Circle {
                ties: ties.collect(),
            });
        }
        for (at, _) in ready {
            done[at] = true;
            order.push(at);
        }
        left = waiting;
    }
    Ok(order)
}
