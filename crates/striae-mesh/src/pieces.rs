//! Pieces of a mesh that share no nodes, and nodes at the same place that are not joined.

use std::collections::HashMap;

use crate::{Mesh, NodeId};

/// Distance over the extent of the mesh within which two nodes are at the same place.
const SAME: f64 = 1e-9;
/// Distance over the edges of their elements within which they are, in a mesh of slender elements.
const OF_EDGE: f64 = 1e-3;

impl Mesh {
    /// Nodes of each piece: elements of one piece share nodes, those of two share none.
    /// Pieces are in the order of their first nodes.
    pub fn pieces(&self) -> Vec<Vec<NodeId>> {
        let mut parents: Vec<usize> = (0..self.positions.len()).collect();
        for corners in self.elements() {
            for node in &corners[1..] {
                let one = root(&mut parents, corners[0].index());
                let other = root(&mut parents, node.index());
                parents[one.max(other)] = one.min(other);
            }
        }
        let mut pieces: Vec<Vec<NodeId>> = Vec::new();
        let mut of_root: HashMap<usize, usize> = HashMap::new();
        for node in 0..parents.len() {
            let root = root(&mut parents, node);
            let piece = *of_root.entry(root).or_insert_with(|| {
                pieces.push(Vec::new());
                pieces.len() - 1
            });
            pieces[piece].push(NodeId::new(node));
        }
        pieces
    }

    /// Pairs of different nodes at the same place, each node with the first one that is there.
    pub fn coincident_nodes(&self) -> Vec<[NodeId; 2]> {
        let start = [f64::INFINITY, f64::NEG_INFINITY].map(crate::Vec3::repeat);
        let [low, high] = self
            .positions
            .iter()
            .fold(start, |[low, high], x| [low.inf(x), high.sup(x)]);
        let extent = SAME * (high - low).norm();
        let edges = self.shortest_edges().into_iter();
        let tolerances: Vec<f64> = edges.map(|edge| extent.min(OF_EDGE * edge)).collect();
        let mut order: Vec<usize> = (0..self.positions.len()).collect();
        // Along an oblique direction, in which hardly two nodes of a regular mesh are level.
        let direction = crate::Vec3::new(0.6180, 0.5698, 0.5415);
        let along: Vec<f64> = self.positions.iter().map(|x| x.dot(&direction)).collect();
        order.sort_by(|&a, &b| along[a].total_cmp(&along[b]));
        let mut pairs = Vec::new();
        for (at, &node) in order.iter().enumerate() {
            let near = order[at + 1..]
                .iter()
                .take_while(|&&other| along[other] - along[node] <= tolerances[node]);
            let place = self.positions[node];
            let is_there = |other: usize| {
                let tolerance = tolerances[node].min(tolerances[other]);
                (self.positions[other] - place).norm() <= tolerance
            };
            for &other in near.filter(|&&other| is_there(other)) {
                pairs.push([node.min(other), node.max(other)].map(NodeId::new));
            }
        }
        pairs.sort_unstable();
        pairs.dedup_by_key(|pair| pair[1]);
        pairs
    }

    /// Distance of each node from the nearest other one of its elements; infinite without any.
    fn shortest_edges(&self) -> Vec<f64> {
        let mut shortest = vec![f64::INFINITY; self.positions.len()];
        for corners in self.elements() {
            for (at, node) in corners.iter().enumerate() {
                for other in &corners[at + 1..] {
                    let [one, two] = [node, other].map(|node| node.index());
                    let length = (self.positions[one] - self.positions[two]).norm();
                    shortest[one] = shortest[one].min(length);
                    shortest[two] = shortest[two].min(length);
                }
            }
        }
        shortest
    }
}

/// Root of a node, with the way to it made shorter.
fn root(parents: &mut [usize], mut node: usize) -> usize {
    while parents[node] != node {
        parents[node] = parents[parents[node]];
        node = parents[node];
    }
    node
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{CellBlock, Vec3, generate::Block};

    /// Two cubes, one on the other, that are not joined.
    fn stacked() -> Mesh {
        let cube = Block::default().mesh().expect("a cube");
        let above = cube.positions.iter().map(|x| x + Vec3::z());
        let positions: Vec<Vec3> = cube.positions.iter().copied().chain(above).collect();
        let corners = |from: usize| [0, 1, 3, 2, 4, 5, 7, 6].map(|at| NodeId::new(from + at));
        let blocks = vec![CellBlock::hexahedra([corners(0), corners(8)])];
        Mesh::new(positions, blocks).expect("two cubes")
    }

    #[test]
    fn pieces_share_no_nodes() {
        let whole = Block {
            divisions: [3, 2, 2],
            ..Block::default()
        };
        let whole = whole.mesh().expect("a block");
        assert_eq!(whole.pieces().len(), 1);
        assert!(whole.coincident_nodes().is_empty());
        let pieces = stacked().pieces();
        let lengths: Vec<usize> = pieces.iter().map(Vec::len).collect();
        assert_eq!(lengths, [8, 8]);
        assert_eq!((pieces[0][0], pieces[1][0]), (NodeId(0), NodeId(8)));
    }

    #[test]
    fn nodes_of_slender_elements_are_not_at_one_place() {
        let slender = Block {
            size: Vec3::new(1.0, 1e6, 0.05),
            divisions: [1, 1, 500],
            ..Block::default()
        };
        let slender = slender.mesh().expect("a block");
        assert!(slender.coincident_nodes().is_empty());
    }

    #[test]
    fn nodes_at_one_place_are_paired() {
        let pairs = [[4, 8], [5, 9], [6, 10], [7, 11]].map(|pair| pair.map(NodeId));
        assert_eq!(stacked().coincident_nodes(), pairs);
    }
}
