//! Order of nodes that depend on dependent nodes, and their resolved dependence.
//!
//! Rows of nodes that follow each other in a circle, as at a seam under which the facets of
//! a third body reach from one neighbour to the other, are solved together,
//!
//! ```text
//! x_s = W_ss x_s + W_sm x_m,   x_s = (I - W_ss)^-1 W_sm x_m,   f_m = W_sm^t t,   t = (I - W_ss)^-t f_s
//! ```

use std::collections::BTreeMap;

use nalgebra::{DMatrix, DVector};

use super::{Follower, TieFault};
use crate::{model::Model, node::GlobalNode};

/// Largest entry of `(I - W_ss)^-1`; beyond, rows all but say the same.
const LARGEST: f64 = 1e3;

/// Followers whose rows are solved together in one component; most are alone.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Group {
    /// Their positions.
    pub(super) members: Vec<usize>,
    /// `(I - W_ss)^-1`; `None` for the identity.
    inverse: Option<DMatrix<f64>>,
}

impl Group {
    /// Multipliers of the rows, `t`, from the forces on the members.
    pub(super) fn taken(&self, forces: Vec<f64>) -> Vec<f64> {
        match &self.inverse {
            Some(inverse) => {
                let taken = inverse.tr_mul(&DVector::from_vec(forces));
                taken.iter().copied().collect()
            }
            None => forces,
        }
    }
}

/// Followers with their weights, by node, and by component their groups, none before those
/// that it follows.
type Resolved = (Vec<Follower>, [Vec<Group>; 3]);

/// Inverse of a group, and nodes that each of its members depends on.
type Solved = (Option<DMatrix<f64>>, Vec<Vec<(GlobalNode, f64)>>);

/// Resolves the dependence of followers on each other.
pub(super) fn resolved(
    model: &Model,
    mut followers: Vec<Follower>,
) -> Result<Resolved, Vec<TieFault>> {
    followers.sort_by_key(|follower| follower.node);
    let of_node: BTreeMap<GlobalNode, usize> = followers
        .iter()
        .enumerate()
        .map(|(at, follower)| (follower.node, at))
        .collect();
    let mut orders = [const { Vec::new() }; 3];
    for (axis, order) in orders.iter_mut().enumerate() {
        for members in components(&followed(&followers, &of_node, axis)) {
            if followers[members[0]].row[axis].is_none() {
                continue;
            }
            let Some((inverse, weights)) = solved(&followers, &of_node, &members, axis) else {
                return Err(vec![circle(model, &followers, &members)]);
            };
            for (&at, weights) in members.iter().zip(weights) {
                followers[at].weights[axis] = Some(weights);
            }
            order.push(Group { members, inverse });
        }
    }
    Ok((followers, orders))
}

fn circle(model: &Model, followers: &[Follower], members: &[usize]) -> TieFault {
    let mut ties: Vec<usize> = members.iter().map(|&at| followers[at].tie).collect();
    ties.sort_unstable();
    ties.dedup();
    let names = ties.iter().map(|&tie| model.ties[tie].name.clone());
    TieFault::Circle {
        ties: names.collect(),
    }
}

/// Followers that each one follows in a component.
fn followed(
    followers: &[Follower],
    of_node: &BTreeMap<GlobalNode, usize>,
    axis: usize,
) -> Vec<Vec<usize>> {
    let follows = |at: &usize| followers[*at].row[axis].is_some();
    let of_one = |follower: &Follower| {
        let row = follower.row[axis].iter().flatten();
        let known = row.filter_map(|(node, _)| of_node.get(node).copied());
        known.filter(follows).collect()
    };
    followers.iter().map(of_one).collect()
}

/// Nodes that each member of a group depends on, with the inverse; `None` if their rows contradict
/// or repeat each other.
fn solved(
    followers: &[Follower],
    of_node: &BTreeMap<GlobalNode, usize>,
    members: &[usize],
    axis: usize,
) -> Option<Solved> {
    let count = members.len();
    let mut within = DMatrix::<f64>::identity(count, count);
    let mut outside: Vec<BTreeMap<GlobalNode, f64>> = vec![BTreeMap::new(); count];
    for (row, &at) in members.iter().enumerate() {
        for &(node, weight) in followers[at].row[axis].iter().flatten() {
            let other = of_node.get(&node).copied();
            let member = other.and_then(|other| members.iter().position(|own| *own == other));
            if let Some(column) = member {
                within[(row, column)] -= weight;
                continue;
            }
            let itself = [(node, 1.0)];
            let resolved = other.and_then(|other| followers[other].weights[axis].as_deref());
            for &(node, share) in resolved.unwrap_or(&itself) {
                *outside[row].entry(node).or_insert(0.0) += weight * share;
            }
        }
    }
    if count == 1 && within[(0, 0)] == 1.0 {
        let weights = outside.into_iter().map(|row| row.into_iter().collect());
        return Some((None, weights.collect()));
    }
    let inverse = within.try_inverse()?;
    // Entries that are no numbers are not below the bound.
    if !inverse.iter().all(|entry| entry.abs() < LARGEST) {
        return None;
    }
    let weights = (0..count).map(|row| {
        let mut sums: BTreeMap<GlobalNode, f64> = BTreeMap::new();
        for (column, entries) in outside.iter().enumerate() {
            for (&node, weight) in entries {
                *sums.entry(node).or_insert(0.0) += inverse[(row, column)] * weight;
            }
        }
        sums.into_iter().collect()
    });
    let weights = weights.collect();
    Some((Some(inverse), weights))
}

/// Sets of places that can be reached from each other, none before those that it leads to.
/// Source: Sharir (1981), "A strong-connectivity algorithm and its applications in data flow
/// analysis", doi:10.1016/0898-1221(81)90008-0.
fn components(edges: &[Vec<usize>]) -> Vec<Vec<usize>> {
    let count = edges.len();
    let mut back: Vec<Vec<usize>> = vec![Vec::new(); count];
    for (from, ends) in edges.iter().enumerate() {
        ends.iter().for_each(|&to| back[to].push(from));
    }
    let mut seen = vec![false; count];
    let mut finished = Vec::with_capacity(count);
    for start in 0..count {
        finished.extend(reached(start, edges, &mut seen));
    }
    let mut seen = vec![false; count];
    let mut sets: Vec<Vec<usize>> = Vec::new();
    for &start in finished.iter().rev() {
        let mut set = reached(start, &back, &mut seen);
        if !set.is_empty() {
            set.sort_unstable();
            sets.push(set);
        }
    }
    sets.reverse();
    sets
}

/// Places that have not been seen and can be reached, each after all that it leads to.
fn reached(start: usize, edges: &[Vec<usize>], seen: &mut [bool]) -> Vec<usize> {
    let mut finished = Vec::new();
    if std::mem::replace(&mut seen[start], true) {
        return finished;
    }
    let mut open = vec![(start, 0)];
    while let Some((place, next)) = open.last_mut() {
        match edges[*place].get(*next) {
            Some(&end) => {
                *next += 1;
                if !std::mem::replace(&mut seen[end], true) {
                    open.push((end, 0));
                }
            }
            None => {
                finished.push(*place);
                open.pop();
            }
        }
    }
    finished
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn circles_are_found_after_what_they_lead_to() {
        // 0 -> 1 <-> 2 -> 3, 4 -> 4 alone, 5 -> 0.
        let edges = [vec![1], vec![2], vec![1, 3], vec![], vec![4], vec![0]];
        let sets = components(&edges);
        let place = |node: usize| sets.iter().position(|set| set.contains(&node)).unwrap();
        assert_eq!(sets.iter().map(Vec::len).sum::<usize>(), 6);
        assert_eq!(place(1), place(2));
        assert!(place(3) < place(2) && place(1) < place(0) && place(0) < place(5));
    }
}
