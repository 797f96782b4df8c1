//! Groups of multipliers and nodes, gathered from all ranks.

use crate::nodes::{NONE, Nodes};
use std::collections::HashMap;
use striae_condensed::Group;
use striae_sparse::Tier;

/// Data of the interface that all ranks hold.
pub(crate) struct Gathered {
    pub(crate) groups: Vec<Group>,
    pub(crate) entries: Vec<(u32, u32, f64)>,
    /// Nodes of groups that have bulk unknowns.
    pub(crate) nodes: Vec<u32>,
    /// Number in the whole system of each multiplier.
    pub(crate) multipliers: Vec<u32>,
    /// Place of each group's unknowns.
    pub(crate) node_places: HashMap<u32, u32>,
    pub(crate) multiplier_places: HashMap<u32, u32>,
    /// First unknown after all.
    pub(crate) end: u32,
}

impl Gathered {
    /// Builds it from the groups that ranks report: node, tier, multipliers with both their
    /// numbers.
    pub(crate) fn new(words: impl Iterator<Item = u32>) -> Self {
        let mut gathered = Self {
            groups: Vec::new(),
            entries: Vec::new(),
            nodes: Vec::new(),
            multipliers: Vec::new(),
            node_places: HashMap::new(),
            multiplier_places: HashMap::new(),
            end: 0,
        };
        let words: Vec<u32> = words.collect();
        let mut rest = words.as_slice();
        while let [node, tier, count, others @ ..] = rest {
            let (own, others) = others.split_at(2 * *count as usize);
            gathered.add_group(*node, Tier(*tier), own);
            rest = others;
        }
        gathered
    }

    /// A group with multipliers, each with its inner number and that in the whole system.
    fn add_group(&mut self, node: u32, tier: Tier, multipliers: &[u32]) {
        let bulk = if node == NONE { 0 } else { 3 };
        if node != NONE {
            self.node_places.insert(node, self.end);
            self.nodes.push(node);
        }
        self.end += bulk;
        for pair in multipliers.chunks_exact(2) {
            self.multiplier_places.insert(pair[0], self.end);
            self.multipliers.push(pair[1]);
            self.end += 1;
        }
        self.groups.push(Group {
            bulk: bulk as usize,
            multipliers: multipliers.len() / 2,
            tier,
        });
    }

    /// Groups of nodes without multipliers that entries name, and the places of all entries.
    pub(crate) fn add_bare_nodes(&mut self, nodes: &Nodes) {
        let named = self
            .entries
            .iter()
            .flat_map(|&(row, column, _)| [row, column]);
        let mut bare: Vec<u32> = named
            .filter(|&inner| !nodes.is_multiplier(inner))
            .map(|inner| inner / 3)
            .collect();
        bare.sort_unstable();
        bare.dedup();
        bare.retain(|node| !self.node_places.contains_key(node));
        for node in bare {
            self.add_group(node, Tier(0), &[]);
        }
        let place = |inner: u32| match nodes.is_multiplier(inner) {
            true => self.multiplier_places[&inner],
            false => self.node_places[&(inner / 3)] + inner % 3,
        };
        for entry in &mut self.entries {
            (entry.0, entry.1) = (place(entry.0), place(entry.1));
        }
    }

    /// Adds up entries of one place, in the order of the ranks.
    pub(crate) fn sum(&mut self) {
        self.entries.sort_by_key(|&(row, column, _)| (row, column));
        self.entries.dedup_by(|next, kept| {
            let is_same = (next.0, next.1) == (kept.0, kept.1);
            if is_same {
                kept.2 += next.2;
            }
            is_same
        });
    }

    /// Unknown of each multiplier.
    pub(crate) fn multiplier_unknowns(&self) -> Vec<u32> {
        let mut unknowns = Vec::with_capacity(self.multipliers.len());
        let mut end = 0;
        for group in &self.groups {
            let first = end + group.bulk as u32;
            end = first + group.multipliers as u32;
            unknowns.extend(first..end);
        }
        unknowns
    }
}
