//! Numbers of the nodes of bodies and surfaces in the whole problem.

use striae_contact::side::Side;
use striae_mesh::NodeId;
use striae_surface::node::SurfaceNode;

use super::Problem;
use crate::node::GlobalNode;

impl Problem {
    /// All nodes.
    pub fn global_nodes(&self) -> impl Iterator<Item = GlobalNode> + use<> {
        (0..self.reference.len()).map(GlobalNode)
    }

    /// Nodes that belong to this rank: all where it is alone.
    pub fn own_nodes(&self) -> impl Iterator<Item = GlobalNode> {
        self.global_nodes().filter(|node| self.share.owns(*node))
    }

    /// Nodes of a body.
    pub fn nodes_of(&self, body: usize) -> impl Iterator<Item = GlobalNode> + use<> {
        (self.first_node[body]..self.first_node[body + 1]).map(GlobalNode)
    }

    /// Global number of a node of a body.
    pub fn node(&self, body: usize, node: NodeId) -> GlobalNode {
        GlobalNode(self.first_node[body] + node.index())
    }

    /// Global numbers of nodes of a body.
    pub fn nodes(&self, body: usize, nodes: &[NodeId]) -> Vec<GlobalNode> {
        nodes.iter().map(|&node| self.node(body, node)).collect()
    }

    /// Body and node, in the whole mesh, of a global node number: what messages name.
    pub(crate) fn named_node(&self, node: GlobalNode) -> (usize, NodeId) {
        let (body, node) = self.body_node(node);
        (body, self.share.whole_mesh_node(body, node))
    }

    /// Body and node of a global node number.
    pub(crate) fn body_node(&self, GlobalNode(node): GlobalNode) -> (usize, NodeId) {
        let body = self.first_node.partition_point(|&first| first <= node) - 1;
        (body, NodeId::new(node - self.first_node[body]))
    }

    /// Global node of a surface node of a pair.
    pub fn surface_node(&self, pair: usize, side: Side, node: SurfaceNode) -> Option<GlobalNode> {
        let geometry = &self.pairs[pair];
        let surface = geometry.contact.sides[side].surface()?;
        let body = geometry.bodies[side]?;
        Some(self.node(body, surface.nodes()[node]))
    }

    /// Global node that the traction unknowns of a node of a pair lodge with: itself, or
    /// that of side `a` at a point of a rigid side.
    pub(crate) fn carrier(&self, pair: usize, side: Side, node: SurfaceNode) -> Option<GlobalNode> {
        let own = self.surface_node(pair, side, node);
        own.or_else(|| self.surface_node(pair, Side::A, node))
    }
}
