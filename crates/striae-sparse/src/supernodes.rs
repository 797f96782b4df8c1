//! From an elimination order to a tree of supernodes.
//!
//! Elimination tree with path compression and column counts by row subtrees
//! (Liu, doi:10.1137/0611010), maximal supernodes, then relaxed amalgamation:
//! a child is merged into its parent while the explicit zeros this stores stay
//! a small share of the front (Duff & Reid, doi:10.1145/356044.356047).

use crate::{
    structure::Structure,
    supervariable::{Supervariable, Tier},
};

/// No parent.
pub(crate) const NONE: u32 = u32::MAX;

/// Supervariables that are eliminated together.
#[derive(Clone, Debug, Default)]
pub(crate) struct Supernode {
    /// Its supervariables in order of elimination.
    pub(crate) members: Vec<u32>,
    /// Unknowns of the members.
    pub(crate) pivots: usize,
    /// Unknowns of later supernodes that share a front with them.
    pub(crate) border: usize,
    /// The supernode that receives the contribution, or [`NONE`].
    pub(crate) parent: u32,
    /// Stored entries of the front that are known to be zero.
    zeros: usize,
}

/// Share of zeros that is allowed in a front with up to so many pivots.
const RELAXATION: [(usize, f64); 4] = [(16, 0.7), (48, 0.25), (128, 0.1), (usize::MAX, 0.04)];

/// Amalgamated supernodes; a parent comes after its children.
///
/// The last `kept` supervariables of the order end up alone in one supernode.
pub(crate) fn supernodes(
    structure: &Structure,
    tiers: &[Tier],
    order: &[u32],
    kept: usize,
) -> Vec<Supernode> {
    let parents = elimination_tree(structure, order, kept);
    let counts = counts(structure, order, &parents, kept);
    let mut nodes = maximal(structure, tiers, order, &parents, &counts, kept);
    amalgamate(tiers, &mut nodes, kept);
    nodes
}

/// Positions of the supervariables in the order.
pub(crate) fn positions(order: &[u32]) -> Vec<u32> {
    let mut position = vec![0; order.len()];
    for (k, &i) in order.iter().enumerate() {
        position[i as usize] = k as u32;
    }
    position
}

/// Parent of each position in the order.
fn elimination_tree(structure: &Structure, order: &[u32], kept: usize) -> Vec<u32> {
    let position = positions(order);
    let mut parents = vec![NONE; order.len()];
    let mut ancestors = vec![NONE; order.len()];
    for k in 0..order.len() as u32 {
        let i = order[k as usize] as usize;
        for neighbour in structure.neighbours(Supervariable(i)) {
            let mut j = position[neighbour.0];
            while j < k {
                let next = ancestors[j as usize];
                ancestors[j as usize] = k;
                if next == NONE {
                    parents[j as usize] = k;
                }
                j = next.min(k);
            }
        }
    }
    let interior = order.len() - kept;
    for k in interior..order.len() {
        parents[k] = if k + 1 < order.len() {
            k as u32 + 1
        } else {
            NONE
        };
    }
    for parent in &mut parents[..interior] {
        // All kept ones are one supernode: its first position stands for it.
        if *parent != NONE && *parent as usize > interior {
            *parent = interior as u32;
        }
    }
    parents
}

/// Unknowns below each position's own in its column of the factor.
fn counts(structure: &Structure, order: &[u32], parents: &[u32], kept: usize) -> Vec<usize> {
    let position = positions(order);
    let size = |k: usize| structure.group(order[k] as usize).len();
    let interior = order.len() - kept;
    let mut counts = vec![0; order.len()];
    let mut mark = vec![NONE; order.len()];
    for k in 0..order.len() {
        mark[k] = k as u32;
        for neighbour in structure.neighbours(Supervariable(order[k] as usize)) {
            let mut j = position[neighbour.0] as usize;
            while j < interior.min(k) && mark[j] != k as u32 {
                mark[j] = k as u32;
                counts[j] += size(k);
                j = parents[j] as usize;
            }
        }
    }
    for k in (interior..order.len()).rev().skip(1) {
        counts[k] = counts[k + 1] + size(k + 1);
    }
    counts
}

/// Maximal supernodes in postorder.
fn maximal(
    structure: &Structure,
    tiers: &[Tier],
    order: &[u32],
    parents: &[u32],
    counts: &[usize],
    kept: usize,
) -> Vec<Supernode> {
    let interior = order.len() - kept;
    let size = |k: usize| structure.group(order[k] as usize).len();
    let tier = |k: usize| tiers[order[k] as usize];
    let mut node_of = vec![NONE; order.len()];
    let mut nodes: Vec<Supernode> = Vec::new();
    let mut last = NONE;
    for k in postorder(parents) {
        let k = k as usize;
        let joins = last != NONE && parents[last as usize] as usize == k && {
            let child = last as usize;
            let same = counts[child] == counts[k] + size(k) && tier(child) == tier(k);
            if k < interior {
                same
            } else {
                child >= interior
            }
        };
        if !joins {
            nodes.push(Supernode {
                parent: NONE,
                ..Supernode::default()
            });
        }
        let index = nodes.len() - 1;
        node_of[k] = index as u32;
        nodes[index].members.push(order[k]);
        nodes[index].pivots += size(k);
        nodes[index].border = counts[k];
        last = k as u32;
    }
    for k in 0..order.len() {
        let parent = parents[k];
        if parent != NONE && node_of[parent as usize] != node_of[k] {
            nodes[node_of[k] as usize].parent = node_of[parent as usize];
        }
    }
    nodes
}

/// Children before parents, a subtree in one piece.
pub(crate) fn postorder(parents: &[u32]) -> Vec<u32> {
    let (mut first, mut next) = (vec![NONE; parents.len()], vec![NONE; parents.len()]);
    let mut roots = Vec::new();
    for k in (0..parents.len()).rev() {
        match parents[k] {
            NONE => roots.push(k as u32),
            parent => {
                next[k] = first[parent as usize];
                first[parent as usize] = k as u32;
            }
        }
    }
    let mut order = Vec::with_capacity(parents.len());
    let mut path = Vec::new();
    while let Some(root) = roots.pop() {
        path.push(root);
        while let Some(&k) = path.last() {
            let child = first[k as usize];
            if child == NONE {
                order.push(k);
                path.pop();
            } else {
                first[k as usize] = next[child as usize];
                path.push(child);
            }
        }
    }
    order
}

/// Merges children into parents where that stores few zeros.
fn amalgamate(tiers: &[Tier], nodes: &mut Vec<Supernode>, kept: usize) {
    let mut children = vec![Vec::new(); nodes.len()];
    for (index, node) in nodes.iter().enumerate() {
        if node.parent != NONE {
            children[node.parent as usize].push(index);
        }
    }
    let tier = |node: &Supernode| node.members.first().map(|&i| tiers[i as usize]);
    let root = if kept > 0 {
        nodes.len() - 1
    } else {
        usize::MAX
    };
    let mut merged = vec![false; nodes.len()];
    for p in 0..nodes.len() {
        if p == root {
            continue;
        }
        let mut candidates = std::mem::take(&mut children[p]);
        candidates.sort_by_key(|&c| std::cmp::Reverse(nodes[c].border));
        for c in candidates {
            let union = union(&nodes[c], &nodes[p]);
            if tier(&nodes[c]) != tier(&nodes[p]) || !worthwhile(&union) {
                children[p].push(c);
                continue;
            }
            merged[c] = true;
            let adopted = std::mem::take(&mut children[c]);
            children[p].extend(adopted);
            let mut members = std::mem::take(&mut nodes[c].members);
            members.append(&mut nodes[p].members);
            nodes[p] = Supernode {
                members,
                parent: nodes[p].parent,
                ..union
            };
        }
    }
    for (p, list) in children.iter().enumerate() {
        for &c in list {
            nodes[c].parent = p as u32;
        }
    }
    compact(nodes, &merged);
}

/// Sizes of the union of a child and its parent, without the members.
fn union(child: &Supernode, parent: &Supernode) -> Supernode {
    let mut union = Supernode {
        pivots: child.pivots + parent.pivots,
        border: parent.border,
        ..Supernode::default()
    };
    let separate = entries(child) + entries(parent);
    union.zeros = child.zeros + parent.zeros + entries(&union) - separate.min(entries(&union));
    union
}

fn worthwhile(node: &Supernode) -> bool {
    let share = node.zeros as f64 / entries(node).max(1) as f64;
    RELAXATION
        .iter()
        .any(|&(pivots, allowed)| node.pivots <= pivots && share <= allowed)
}

/// Entries of the factors in a front.
pub(crate) fn entries(node: &Supernode) -> usize {
    node.pivots * (node.pivots + 2 * node.border)
}

/// Removes the merged supernodes and renumbers the parents.
fn compact(nodes: &mut Vec<Supernode>, merged: &[bool]) {
    let mut number = vec![NONE; nodes.len()];
    let mut count = 0;
    for (index, &gone) in merged.iter().enumerate() {
        if !gone {
            number[index] = count;
            count += 1;
        }
    }
    let mut index = 0;
    nodes.retain(|_| {
        index += 1;
        !merged[index - 1]
    });
    for node in nodes {
        if node.parent != NONE {
            node.parent = number[node.parent as usize];
        }
    }
}
