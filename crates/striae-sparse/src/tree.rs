//! Assembly tree: the plan of a multifrontal factorisation.
//!
//! A front is the dense matrix on the unknowns of a supernode (its *pivots*)
//! and of those later supervariables they are coupled to (its *border*).
//! Eliminating the pivots leaves a contribution on the border, which is added
//! to the parent's front (Duff & Reid, doi:10.1145/356044.356047). Children are
//! ordered for the least working storage (Liu, doi:10.1145/7921.11325).

use crate::{
    structure::Structure,
    supernodes::{self, NONE, Supernode},
    supervariable::Tier,
};
use std::{cmp::Reverse, ops::Range};

/// An edge that is assembled elsewhere.
pub(crate) const ELSEWHERE: u32 = u32::MAX;

/// One front, with sizes in scalar unknowns before any pivot is delayed.
#[derive(Clone, Debug)]
pub(crate) struct Front {
    /// Supervariables eliminated here, in order.
    pub(crate) members: Vec<u32>,
    /// Supervariables of the border, in order of elimination.
    pub(crate) border: Vec<u32>,
    /// Unknowns of the members.
    pub(crate) pivots: usize,
    /// Unknowns of members and border.
    pub(crate) size: usize,
    /// Fronts whose contributions are added to this one.
    pub(crate) children: Vec<u32>,
    /// First unknown of each border supervariable in the parent's front.
    pub(crate) relative: Vec<u32>,
    /// Unknowns of the border up to the end of each border supervariable.
    pub(crate) ends: Vec<u32>,
    /// First front of the subtree below this one, which ends with it.
    pub(crate) first: u32,
    /// Work to factor the subtree.
    pub(crate) subtree_flops: f64,
    /// Most entries of contributions alive while the subtree is factored in sequence.
    pub(crate) stack: usize,
}

/// All fronts in postorder and where each entry of the matrix belongs.
#[derive(Clone, Debug)]
pub(crate) struct AssemblyTree {
    pub(crate) fronts: Vec<Front>,
    /// Fronts without a parent.
    pub(crate) roots: Vec<u32>,
    /// By edge `i -> j`: first unknown of `j` in the front that eliminates `i`,
    /// or [`ELSEWHERE`] if `j` is eliminated in an earlier one.
    pub(crate) local: Vec<u32>,
    /// By edge `i -> j`: the edge `j -> i`.
    pub(crate) mirror: Vec<u32>,
}

impl Front {
    /// Unknowns of the border.
    pub(crate) fn rest(&self) -> usize {
        self.size - self.pivots
    }

    /// Place in the parent's front of each unknown of the border, as planned.
    pub(crate) fn places(&self) -> impl Iterator<Item = usize> + '_ {
        let begins = std::iter::once(&0).chain(&self.ends);
        let sizes = self.ends.iter().zip(begins).map(|(end, begin)| end - begin);
        let starts = self.relative.iter().zip(sizes);
        starts.flat_map(|(&start, size)| start as usize..(start + size) as usize)
    }

    /// Entries of both factors.
    pub(crate) fn entries(&self) -> usize {
        self.pivots * (self.pivots + 2 * self.rest())
    }
}

impl AssemblyTree {
    /// Tree for an order of elimination whose last `kept` supervariables form one root.
    pub(crate) fn new(structure: &Structure, tiers: &[Tier], order: &[u32], kept: usize) -> Self {
        let nodes = sorted(supernodes::supernodes(structure, tiers, order, kept));
        let mut node_of = vec![NONE; structure.supervariables()];
        for (index, node) in nodes.iter().enumerate() {
            node.members
                .iter()
                .for_each(|&i| node_of[i as usize] = index as u32);
        }
        let borders = borders(structure, &nodes, &node_of);
        let mut tree = Self {
            fronts: Vec::with_capacity(nodes.len()),
            roots: Vec::new(),
            local: vec![ELSEWHERE; structure.edges_total()],
            mirror: mirror(structure),
        };
        let parents: Vec<u32> = nodes.iter().map(|node| node.parent).collect();
        for (node, border) in nodes.into_iter().zip(borders) {
            let size = |i: &u32| structure.group(*i as usize).len();
            let pivots = node.members.iter().map(size).sum();
            let mut rest = 0;
            let ends = border.iter().map(|i| {
                rest += size(i);
                rest as u32
            });
            let ends = ends.collect();
            tree.fronts.push(Front {
                members: node.members,
                border,
                pivots,
                size: pivots + rest,
                children: Vec::new(),
                relative: Vec::new(),
                ends,
                first: tree.fronts.len() as u32,
                subtree_flops: elimination_flops(pivots, pivots + rest),
                stack: rest * rest,
            });
        }
        tree.link(&parents);
        tree.locate(structure, &parents);
        tree
    }

    /// Fronts of the subtree that ends with front `f`.
    pub(crate) fn subtree(&self, f: usize) -> Range<usize> {
        self.fronts[f].first as usize..f + 1
    }

    /// Entries of the factors.
    pub(crate) fn entries(&self) -> usize {
        self.fronts.iter().map(Front::entries).sum()
    }

    /// Floating-point operations of an LU factorisation.
    pub(crate) fn flops(&self) -> f64 {
        self.roots
            .iter()
            .map(|&f| self.fronts[f as usize].subtree_flops)
            .sum()
    }

    /// Most entries of contributions alive at a time.
    pub(crate) fn stack(&self) -> usize {
        self.roots
            .iter()
            .map(|&f| self.fronts[f as usize].stack)
            .max()
            .unwrap_or(0)
    }

    /// Fills in what depends on parents and children.
    fn link(&mut self, parents: &[u32]) {
        for f in 0..self.fronts.len() {
            if parents[f] == NONE {
                self.roots.push(f as u32);
            } else {
                self.fronts[parents[f] as usize].children.push(f as u32);
            }
            let front = &self.fronts[f];
            let (mut below, mut stack, mut flops) = (0, 0, front.subtree_flops);
            let mut first = front.first;
            for &c in &front.children {
                let child = &self.fronts[c as usize];
                stack = stack.max(below + child.stack);
                below += child.rest() * child.rest();
                flops += child.subtree_flops;
                first = first.min(child.first);
            }
            let stack = stack.max(below + front.rest() * front.rest());
            let front = &mut self.fronts[f];
            (front.stack, front.subtree_flops, front.first) = (stack, flops, first);
        }
    }

    /// Fills in where edges and contributions go.
    fn locate(&mut self, structure: &Structure, parents: &[u32]) {
        let mut start = vec![ELSEWHERE; structure.supervariables()];
        for f in 0..self.fronts.len() {
            let front = &self.fronts[f];
            let mut next = 0;
            for &i in front.members.iter().chain(&front.border) {
                start[i as usize] = next;
                next += structure.group(i as usize).len() as u32;
            }
            for &i in &front.members {
                for edge in structure.edges(i as usize) {
                    self.local[edge] = start[structure.target(edge)];
                }
            }
            for c in self.fronts[f].children.clone() {
                let child = &mut self.fronts[c as usize];
                debug_assert_eq!(parents[c as usize] as usize, f);
                child.relative = child.border.iter().map(|&i| start[i as usize]).collect();
                debug_assert!(child.relative.iter().all(|&r| r != ELSEWHERE));
            }
            let front = &self.fronts[f];
            for &i in front.members.iter().chain(&front.border) {
                start[i as usize] = ELSEWHERE;
            }
        }
    }
}

/// Work to eliminate `pivots` of `size` unknowns by LU.
pub(crate) fn elimination_flops(pivots: usize, size: usize) -> f64 {
    // Sum of 2 k^2 + k for the sizes k of the remaining matrices.
    let sum = |k: f64| k * (k + 1.0) * (2.0 * k + 1.0) / 3.0 + k * (k + 1.0) / 2.0;
    if pivots == 0 {
        return 0.0;
    }
    sum(size as f64 - 1.0) - sum((size - pivots) as f64 - 1.0)
}

/// Postorder in which the children that need most storage come first.
fn sorted(nodes: Vec<Supernode>) -> Vec<Supernode> {
    let mut stack = vec![0; nodes.len()];
    let mut children: Vec<Vec<u32>> = vec![Vec::new(); nodes.len()];
    for (index, node) in nodes.iter().enumerate() {
        let own = |c: &u32| nodes[*c as usize].border * nodes[*c as usize].border;
        let mut list = std::mem::take(&mut children[index]);
        list.sort_by_key(|c| Reverse(stack[*c as usize] - own(c)));
        let (mut below, mut most) = (0, 0);
        for c in &list {
            most = most.max(below + stack[*c as usize]);
            below += own(c);
        }
        stack[index] = most.max(below + node.border * node.border);
        children[index] = list;
        if node.parent != NONE {
            children[node.parent as usize].push(index as u32);
        }
    }
    let order = depth_first(&nodes, &children);
    let mut number = vec![NONE; nodes.len()];
    for (new, &old) in order.iter().enumerate() {
        number[old as usize] = new as u32;
    }
    let mut nodes: Vec<Option<Supernode>> = nodes.into_iter().map(Some).collect();
    let take = |old: u32| nodes[old as usize].take();
    let mut sorted: Vec<Supernode> = order.into_iter().filter_map(take).collect();
    for node in &mut sorted {
        if node.parent != NONE {
            node.parent = number[node.parent as usize];
        }
    }
    sorted
}

/// Postorder that keeps the order of the children.
fn depth_first(nodes: &[Supernode], children: &[Vec<u32>]) -> Vec<u32> {
    let mut order = Vec::with_capacity(nodes.len());
    let mut visited = vec![0; nodes.len()];
    let mut path: Vec<u32> = Vec::new();
    for root in (0..nodes.len() as u32).filter(|&k| nodes[k as usize].parent == NONE) {
        path.push(root);
        while let Some(&k) = path.last() {
            match children[k as usize].get(visited[k as usize]) {
                Some(&child) => {
                    visited[k as usize] += 1;
                    path.push(child);
                }
                None => {
                    order.push(k);
                    path.pop();
                }
            }
        }
    }
    order
}

/// Border supervariables of each supernode, in order of elimination.
fn borders(structure: &Structure, nodes: &[Supernode], node_of: &[u32]) -> Vec<Vec<u32>> {
    let mut rank = vec![0_u32; node_of.len()];
    let members = nodes.iter().flat_map(|node| &node.members);
    members
        .enumerate()
        .for_each(|(k, &i)| rank[i as usize] = k as u32);
    let mut mark = vec![NONE; node_of.len()];
    let mut borders: Vec<Vec<u32>> = vec![Vec::new(); nodes.len()];
    let mut children: Vec<Vec<u32>> = vec![Vec::new(); nodes.len()];
    for (index, node) in nodes.iter().enumerate() {
        let mut border = Vec::new();
        let mut note = |i: u32| {
            if node_of[i as usize] > index as u32 && mark[i as usize] != index as u32 {
                mark[i as usize] = index as u32;
                border.push(i);
            }
        };
        for &i in &node.members {
            structure
                .edges(i as usize)
                .for_each(|edge| note(structure.target(edge) as u32));
        }
        for &c in &children[index] {
            borders[c as usize].iter().for_each(|&i| note(i));
        }
        border.sort_unstable_by_key(|&i| rank[i as usize]);
        borders[index] = border;
        if node.parent != NONE {
            children[node.parent as usize].push(index as u32);
        }
    }
    borders
}

/// For each edge `i -> j` the edge `j -> i`.
fn mirror(structure: &Structure) -> Vec<u32> {
    // Rising `i` meets the neighbours of every `j` in rising order.
    let count = structure.supervariables();
    let mut next: Vec<usize> = (0..count).map(|j| structure.edges(j).start).collect();
    let mut mirror = vec![0; structure.edges_total()];
    for i in 0..count {
        for edge in structure.edges(i) {
            let j = structure.target(edge);
            mirror[edge] = next[j] as u32;
            next[j] += 1;
        }
    }
    mirror
}
