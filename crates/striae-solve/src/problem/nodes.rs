//! Numbers of the nodes of bodies and surfaces in the whole problem.

use striae_contact::side::Side;
use striae_mesh::{NodeId, Vec3};
use striae_surface::node::SurfaceNode;

use super::Problem;
use striae_model::node::GlobalNode;

impl Problem {
    /// All nodes.
    pub fn global_nodes(&self) -> impl Iterator<Item = GlobalNode> + use<> {
        (0..self.reference.len()).map(GlobalNode)
    }

    /// Diagonal of the box around all nodes of the whole problem at rest.
    pub fn size(&self) -> f64 {
        let [least, most] = match self.share.holding() {
            Some(holding) => holding.whole.extent,
            None => extent(&self.reference),
        };
        (most - least).norm()
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
}

/// Ends of the box around some places.
pub(crate) fn extent<'a>(places: impl IntoIterator<Item = &'a Vec3>) -> [Vec3; 2] {
    let mut places = places.into_iter();
    let first = places.next().copied().unwrap_or_default();
    places.fold([first, first], |[least, most], x| {
        [least.inf(x), most.sup(x)]
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_extent_is_that_of_the_box() {
        let places = [[0.0, 0.0, 0.0], [3.0, 0.0, 0.0], [0.0, 4.0, 0.0]].map(Vec3::from);
        let [least, most] = extent(&places);
        assert_eq!((most - least).norm(), 5.0);
    }
}
