//! Patches of the contact surfaces that move as one.
//!
//! A node-wise diagonal `D` describes how a node yields to a force on it alone. Where meshes do not
//! match, rough multipliers make smooth forces, too, to which a body yields much more: by as much
//! as their wavelength is longer than an element. A half-space meets a motion of a patch of `n`
//! nodes with `1 / sqrt(n)` of the stiffness that the nodes would meet one by one, as its stiffness
//! grows with the width of what presses on it. So
//!
//! ```text
//! K^-1 ~ D^-1 + sum_a z_a z_a^T / d_a,    d_a = gamma / sqrt(n_a),
//! ```
//!
//! with unit vectors `z_a` of the translations of patches of two sizes, as in the
//! preconditioner of Bramble, Pasciak and Xu (doi:10.1090/S0025-5718-1990-1023042-6). The
//! system is scaled, so that a node alone meets a stiffness of about one; `n_a` counts the
//! nodes that are free to move along the axis.

use super::scaled::Scaled;
use std::collections::{BTreeMap, BTreeSet};
use striae_sparse::{Supervariable, sparse_elimination::Row};

/// `gamma` of the smaller patches, and of the larger ones, in which those are.
const STIFFNESS: [f64; 2] = [1.0, 3.0];

/// Nodes that multipliers couple to, with those among them that elements couple to each.
#[derive(Debug)]
pub(super) struct Surface {
    /// Numbers of nodes, rising.
    nodes: Vec<u32>,
    /// Places of its neighbours in that list, and its own.
    near: Vec<BTreeSet<u32>>,
}

impl Surface {
    /// From pairs of neighbours, in any order.
    pub(super) fn new(pairs: &[(u32, u32)]) -> Self {
        let mut near: BTreeMap<u32, BTreeSet<u32>> = BTreeMap::new();
        for &(a, b) in pairs {
            near.entry(a).or_default().extend([a, b]);
            near.entry(b).or_default().extend([a, b]);
        }
        let nodes: Vec<u32> = near.keys().copied().collect();
        let place = |node: &u32| nodes.partition_point(|other| other < node) as u32;
        let near = near.values().map(|near| near.iter().map(place).collect());
        Self {
            near: near.collect(),
            nodes,
        }
    }

    /// Of the nodes that are kept where the rest of the bulk is condensed.
    pub(super) fn of(scaled: &Scaled<'_>) -> Self {
        let nodes = &scaled.nodes;
        let is_kept = |i: usize| nodes.partition.is_kept(Supervariable(i));
        let mut pairs = Vec::new();
        for (node, &i) in (0..).zip(&nodes.supervariables) {
            let i = i as usize;
            let edges = nodes.partition.edges(i).filter(|_| is_kept(i));
            let bulk = edges.filter(|&edge| nodes.partition.is_bulk_edge(edge));
            let others = bulk.map(|edge| nodes.partition.target(edge));
            for j in others.filter(|&j| is_kept(j) && nodes.of[j] != super::NONE) {
                pairs.push((node, nodes.of[j]));
            }
        }
        Self::new(&pairs)
    }

    /// Members of the smaller patches and of the larger ones, by node.
    fn patches(&self) -> [Vec<Vec<u32>>; 2] {
        let small = groups(&self.near);
        let mut of = vec![0; self.nodes.len()];
        for (patch, members) in (0..).zip(&small) {
            members.iter().for_each(|&k| of[k as usize] = patch);
        }
        let mut near = vec![BTreeSet::new(); small.len()];
        for (k, others) in self.near.iter().enumerate() {
            let others = others.iter().map(|&other| of[other as usize]);
            near[of[k] as usize].extend(others);
        }
        // A patch alone has its motion already.
        let large = groups(&near)
            .into_iter()
            .filter(|patches| patches.len() > 1);
        let large = large.map(|patches| {
            let members = patches
                .iter()
                .map(|&patch| small[patch as usize].as_slice());
            members.collect::<Vec<_>>().concat()
        });
        let large = large.collect();
        [small, large].map(|patches| {
            let by_node = patches.into_iter().filter(|members| members.len() > 1);
            let node = |k: u32| self.nodes[k as usize];
            by_node
                .map(|members| members.into_iter().map(node).collect())
                .collect()
        })
    }
}

/// A translation of a patch.
#[derive(Debug)]
pub(super) struct Motion {
    /// Unit vector, by `3 node + component`.
    pub(super) vector: Row,
    /// Stiffness `d` that it meets.
    pub(super) stiffness: f64,
}

impl Motion {
    /// Translations of the patches of a surface, the smaller ones first: one for each axis
    /// along which any node of a patch is free.
    pub(super) fn all(scaled: &Scaled<'_>, surface: &Surface) -> Vec<Vec<Self>> {
        let sizes = surface.patches().into_iter().zip(STIFFNESS);
        let patches = sizes.flat_map(|(patches, gamma)| {
            let patches = patches.into_iter();
            patches.map(move |nodes| {
                let axes = (0..3).map(|axis| Self::along(scaled, &nodes, axis, gamma));
                axes.filter(|motion| !motion.vector.is_empty()).collect()
            })
        });
        patches.collect()
    }

    fn along(scaled: &Scaled<'_>, nodes: &[u32], axis: usize, gamma: f64) -> Self {
        let mut vector = Row::new();
        for &node in nodes {
            let i = scaled.nodes.supervariables[node as usize] as usize;
            let unknown = scaled.nodes.partition.bulk_group(i).start + axis;
            if !scaled.prescribed[unknown] {
                let value = 1.0 / scaled.scaling.columns[unknown];
                vector.push((3 * node + axis as u32, value));
            }
        }
        let length = vector.iter().map(|e| e.1 * e.1).sum::<f64>().sqrt();
        vector.iter_mut().for_each(|entry| entry.1 /= length);
        Self {
            stiffness: stiffness(gamma, vector.len()),
            vector,
        }
    }
}

/// Stiffness `d` of so many nodes that move as one.
fn stiffness(gamma: f64, nodes: usize) -> f64 {
    gamma / (nodes as f64).sqrt()
}

/// Groups, each of one with all that are near it, where none of them is taken; what is left
/// joins a group of one that is near.
fn groups(near: &[BTreeSet<u32>]) -> Vec<Vec<u32>> {
    let mut of: Vec<Option<usize>> = vec![None; near.len()];
    let mut groups: Vec<Vec<u32>> = Vec::new();
    for near in near {
        if near.iter().all(|&other| of[other as usize].is_none()) {
            for &member in near {
                of[member as usize] = Some(groups.len());
            }
            groups.push(near.iter().copied().collect());
        }
    }
    for (member, near) in (0..).zip(near) {
        let mut others = near.iter().filter_map(|&other| of[other as usize]);
        if let (None, Some(group)) = (of[member as usize], others.next()) {
            groups[group].push(member);
        }
    }
    groups
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Pairs of neighbours on a grid of so many nodes along each axis.
    fn grid(nodes: [u32; 2]) -> Vec<(u32, u32)> {
        let [width, height] = nodes;
        let all = (0..width * height).flat_map(|a| (0..width * height).map(move |b| (a, b)));
        let is_near = |a: u32, b: u32| {
            (a % width).abs_diff(b % width) <= 1 && (a / width).abs_diff(b / width) <= 1
        };
        all.filter(|&(a, b)| is_near(a, b)).collect()
    }

    #[test]
    fn every_node_is_in_one_patch_of_each_size() {
        for nodes in [[9, 9], [7, 12], [2, 30], [20, 17]] {
            let [small, large] = Surface::new(&grid(nodes)).patches();
            for patches in [&small, &large] {
                let mut all = patches.concat();
                all.sort_unstable();
                assert_eq!(
                    all,
                    (0..nodes[0] * nodes[1]).collect::<Vec<_>>(),
                    "{nodes:?}"
                );
            }
            assert!(small.len() > 2 * large.len(), "{nodes:?}");
        }
    }

    /// `f F f` of a unit force spread over some nodes, over what a node yields alone.
    fn yielded(patches: &[Vec<Vec<u32>>; 2], nodes: &[u32]) -> f64 {
        let motions = patches.iter().zip(STIFFNESS).flat_map(|(patches, gamma)| {
            patches.iter().map(move |patch| {
                let both = patch.iter().filter(|node| nodes.contains(node)).count() as f64;
                let work = both / ((patch.len() * nodes.len()) as f64).sqrt();
                work * work / stiffness(gamma, patch.len())
            })
        });
        1.0 + motions.sum::<f64>()
    }

    #[test]
    fn a_region_yields_by_its_width_as_a_half_space_does() {
        let patches = Surface::new(&grid([45, 45])).patches();
        // To a factor of two. Smaller ones are at the edge, where a node has fewer neighbours.
        for patch in patches.iter().flatten().filter(|patch| patch.len() >= 9) {
            let width = (patch.len() as f64).sqrt();
            let ratio = yielded(&patches, patch) / width;
            assert!(ratio > 0.5 && ratio < 2.0, "{width} {ratio}");
        }
        let node = yielded(&patches, &[1000]);
        assert!(node > 1.0 && node < 1.8, "{node}");
    }

    #[test]
    fn a_surface_of_one_patch_has_no_larger_one() {
        let [small, large] = Surface::new(&grid([3, 3])).patches();
        assert_eq!((small.len(), large.len()), (1, 0));
        let [small, large] = Surface::new(&grid([1, 1])).patches();
        assert_eq!((small.len(), large.len()), (0, 0));
    }
}
