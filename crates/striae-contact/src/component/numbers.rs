//! Numbers of the unknowns of all pairs in the caller's system.

use striae_mesh::NodeId;
use striae_surface::node::SurfaceNode;

use crate::{pair::ContactPair, selection::Selection, side::Side};

/// First unknown in the system of every triple of the unknowns of a pair.
#[derive(Clone, Debug)]
pub(super) struct Numbers {
    /// By pair and triple; `None` for tractions of nodes that are not kept.
    triples: Vec<Vec<Option<usize>>>,
    /// Kept nodes before those of each pair; the last entry is the number of all.
    kept: Vec<usize>,
    nodes: usize,
}

impl Numbers {
    /// Numbers of the unknowns of pairs on so many nodes.
    pub(super) fn new<'a>(
        nodes: usize,
        pairs: impl Iterator<Item = (&'a ContactPair, &'a Selection)>,
    ) -> Self {
        let mut numbers = Self {
            triples: Vec::new(),
            kept: vec![0],
            nodes,
        };
        for (pair, selection) in pairs {
            let before = numbers.kept();
            let mut of_pair = vec![None; pair.numbering().count() as usize / 3];
            for &side in pair.deformable_sides() {
                for (node, of_mesh) in of_side(pair, side) {
                    let place = pair.numbering().position(side, node) as usize / 3;
                    of_pair[place] = Some(3 * of_mesh.index());
                }
            }
            for (k, kept) in selection.kept().iter().enumerate() {
                let place = pair.numbering().traction(kept.side, kept.node) as usize / 3;
                of_pair[place] = Some(3 * (nodes + before + k));
            }
            numbers.triples.push(of_pair);
            numbers.kept.push(before + selection.kept().len());
        }
        numbers
    }

    /// Number of a pair's unknown in the system.
    pub(super) fn number(&self, pair: usize, unknown: u32) -> usize {
        let (triple, component) = (unknown as usize / 3, unknown as usize % 3);
        let first = self.triples[pair][triple];
        first.expect("terms refer to positions and kept nodes") + component
    }

    /// Number of kept nodes before those of a pair.
    pub(super) fn before(&self, pair: usize) -> usize {
        self.kept[pair]
    }

    /// Number of kept nodes of all pairs.
    pub(super) fn kept(&self) -> usize {
        self.kept[self.kept.len() - 1]
    }

    /// Number of all unknowns.
    pub(super) fn all(&self) -> usize {
        3 * (self.nodes + self.kept())
    }
}

/// Nodes of a side and those of the mesh that they are.
pub(super) fn of_side(
    pair: &ContactPair,
    side: Side,
) -> impl Iterator<Item = (SurfaceNode, NodeId)> {
    let nodes = pair.sides[side].surface().map_or(&[][..], |s| s.nodes());
    SurfaceNode::all(nodes.len()).zip(nodes.iter().copied())
}

/// Nodes of the mesh on a side; none of a rigid one.
pub(super) fn nodes_of(pair: &ContactPair, side: Side) -> Vec<NodeId> {
    match pair.is_deformable(side) {
        true => of_side(pair, side).map(|(_, node)| node).collect(),
        false => Vec::new(),
    }
}
