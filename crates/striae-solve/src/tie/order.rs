//! Nodes that follow nodes that follow: their order, and what they come to follow.

use std::collections::{BTreeMap, BTreeSet};

use super::{Follower, TieFault};
use crate::model::Model;

/// The followers, none before those that it follows, with their weights.
pub(super) fn resolved(
    model: &Model,
    mut rows: Vec<Follower>,
) -> Result<Vec<Follower>, Vec<TieFault>> {
    rows.sort_by_key(|follower| follower.node);
    let of_node: BTreeMap<usize, usize> = rows
        .iter()
        .enumerate()
        .map(|(at, follower)| (follower.node, at))
        .collect();
    let order = ordered(model, &rows, &of_node).map_err(|fault| vec![fault])?;
    let mut found: Vec<Follower> = Vec::with_capacity(rows.len());
    let mut places = BTreeMap::new();
    for at in order {
        let mut follower = rows[at].clone();
        for axis in 0..3 {
            let row = follower.row[axis].as_ref();
            follower.weights[axis] = row.map(|row| resolved_row(row, axis, &found, &places));
        }
        places.insert(follower.node, found.len());
        found.push(follower);
    }
    Ok(found)
}

/// A row in terms of nodes that do not follow in that component.
fn resolved_row(
    row: &[(usize, f64)],
    axis: usize,
    found: &[Follower],
    places: &BTreeMap<usize, usize>,
) -> Vec<(usize, f64)> {
    let mut sums: BTreeMap<usize, f64> = BTreeMap::new();
    for &(node, weight) in row {
        let followed = places.get(&node).map(|&at| &found[at].weights[axis]);
        match followed {
            Some(Some(followed)) => {
                for &(other, share) in followed {
                    *sums.entry(other).or_insert(0.0) += weight * share;
                }
            }
            Some(None) | None => *sums.entry(node).or_insert(0.0) += weight,
        }
    }
    sums.into_iter().collect()
}

/// Positions of the followers in such an order.
fn ordered(
    model: &Model,
    rows: &[Follower],
    of_node: &BTreeMap<usize, usize>,
) -> Result<Vec<usize>, TieFault> {
    let followed: Vec<BTreeSet<usize>> = rows
        .iter()
        .map(|follower| {
            let nodes = follower.row.iter().flatten().flatten();
            nodes
                .filter_map(|(node, _)| of_node.get(node).copied())
                .collect()
        })
        .collect();
    let (mut order, mut done) = (Vec::with_capacity(rows.len()), vec![false; rows.len()]);
    let mut left: Vec<usize> = (0..rows.len()).collect();
    while !left.is_empty() {
        let (ready, waiting): (Vec<usize>, Vec<usize>) = left
            .into_iter()
            .partition(|&at| followed[at].iter().all(|&other| done[other]));
        if ready.is_empty() {
            let ties: BTreeSet<usize> = waiting.iter().map(|&at| rows[at].tie).collect();
            let ties = ties.iter().map(|&tie| model.ties[tie].name.clone());
            return Err(TieFault::Circle {
                ties: ties.collect(),
            });
        }
        ready.iter().for_each(|&at| done[at] = true);
        order.extend(ready);
        left = waiting;
    }
    Ok(order)
}
