//! Facets and nodes of a surface and how they hang together.

use crate::node::SurfaceNode;
use striae_mesh::{FacetId, NodeId, Vec3};

/// A surface of facets with three or four corners, in local numbering.
///
/// Corners run counter-clockwise seen from outside. A triangle repeats its
/// last corner.
#[derive(Clone, Debug)]
pub struct Surface {
    nodes: Vec<NodeId>,
    facets: Vec<[SurfaceNode; 4]>,
    corners_of_node: Vec<Vec<Corner>>,
    boundary_edges: Vec<BoundaryEdge>,
    on_boundary: Vec<bool>,
}

/// A corner of a facet at a node: the node's neighbours along the facet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Corner {
    /// The facet.
    pub facet: FacetId,
    /// Surface-local neighbour that follows the node counter-clockwise.
    pub next: SurfaceNode,
    /// Surface-local neighbour that precedes the node.
    pub previous: SurfaceNode,
}

/// An edge that belongs to one facet only.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BoundaryEdge {
    /// Surface-local end nodes in the facet's sense of rotation.
    pub nodes: [SurfaceNode; 2],
    /// The facet.
    pub facet: FacetId,
}

impl Surface {
    /// A surface from the corners of its facets.
    pub fn new(facets: &[[NodeId; 4]]) -> Self {
        let mut nodes: Vec<NodeId> = facets.iter().flatten().copied().collect();
        nodes.sort_unstable();
        nodes.dedup();
        let local = |node: &NodeId| SurfaceNode::new(nodes.partition_point(|other| other < node));
        let facets: Vec<[SurfaceNode; 4]> =
            facets.iter().map(|f| f.each_ref().map(local)).collect();
        Self::of_parts(nodes, facets)
    }

    /// A surface whose nodes belong to smooth faces: a node of the mesh becomes as many nodes of
    /// the surface as faces meet there. Facets with a common edge belong to one face where the
    /// angle between their unit normals has at least this cosine.
    pub fn with_faces(facets: &[[NodeId; 4]], normals: &[Vec3], cosine: f64) -> Self {
        let faces = Faces::new(facets, normals, cosine);
        let mut seats: Vec<(NodeId, usize)> = facets
            .iter()
            .enumerate()
            .flat_map(|(facet, nodes)| (0..4).map(move |at| (nodes[at], facet, at)))
            .map(|(node, facet, at)| (node, faces.root(facet, at)))
            .collect();
        seats.sort_unstable();
        seats.dedup();
        let local = |facet: usize, at: usize| {
            let seat = (facets[facet][at], faces.root(facet, at));
            SurfaceNode::new(seats.partition_point(|other| *other < seat))
        };
        let of_facet = |facet: usize| std::array::from_fn(|at| local(facet, at));
        let local_facets = (0..facets.len()).map(of_facet).collect();
        let nodes = seats.into_iter().map(|(node, _)| node).collect();
        Self::of_parts(nodes, local_facets)
    }

    fn of_parts(nodes: Vec<NodeId>, facets: Vec<[SurfaceNode; 4]>) -> Self {
        let corners_of_node = corners_of_node(nodes.len(), &facets);
        let boundary_edges = boundary_edges(&facets);
        let mut on_boundary = vec![false; nodes.len()];
        for edge in &boundary_edges {
            for node in edge.nodes {
                on_boundary[node] = true;
            }
        }
        Self {
            nodes,
            facets,
            corners_of_node,
            boundary_edges,
            on_boundary,
        }
    }

    /// Copy of the surface for a mesh whose nodes have other numbers in unchanged order.
    ///
    /// # Panics
    /// If the order changes.
    pub fn renumbered(mut self, number: impl Fn(NodeId) -> NodeId) -> Self {
        self.nodes.iter_mut().for_each(|node| *node = number(*node));
        assert!(self.nodes.is_sorted(), "nodes keep their order");
        self
    }

    /// Mesh node of every surface node, ascending; on an edge between faces more than once.
    pub fn nodes(&self) -> &[NodeId] {
        &self.nodes
    }

    /// The surface node that a mesh node is, if it lies on the surface; on an edge between faces
    /// one of them.
    pub fn node(&self, node: NodeId) -> Option<SurfaceNode> {
        let place = self.nodes.binary_search(&node).ok();
        place.map(SurfaceNode::new)
    }

    /// Corners of every facet in surface-local numbering.
    pub fn facets(&self) -> &[[SurfaceNode; 4]] {
        &self.facets
    }

    /// Facet corners that meet at a surface node.
    pub fn corners(&self, node: SurfaceNode) -> &[Corner] {
        &self.corners_of_node[node]
    }

    /// Edges with a facet on one side only.
    pub fn boundary_edges(&self) -> &[BoundaryEdge] {
        &self.boundary_edges
    }

    /// Returns whether no other facet has the edge from a corner of a facet to its next one.
    pub fn is_boundary_edge(&self, [start, end]: [SurfaceNode; 2]) -> bool {
        let mut around = self.corners_of_node[start].iter();
        !around.any(|corner| corner.previous == end)
    }

    /// Returns whether the surface node lies on an edge of the surface.
    pub fn is_on_boundary(&self, node: SurfaceNode) -> bool {
        self.on_boundary[node]
    }
}

/// Smooth faces: which corners at a node belong together.
struct Faces {
    /// A corner of the same face, by `4 facet + corner`; the first one stands for all.
    parent: Vec<usize>,
}

impl Faces {
    fn new(facets: &[[NodeId; 4]], normals: &[Vec3], cosine: f64) -> Self {
        let mut faces = Self {
            parent: (0..4 * facets.len()).collect(),
        };
        let mut edges = Vec::with_capacity(4 * facets.len());
        for (facet, nodes) in facets.iter().enumerate() {
            let count = if nodes[2] == nodes[3] { 3 } else { 4 };
            if count == 3 {
                faces.join(4 * facet + 2, 4 * facet + 3);
            }
            for at in 0..count {
                let next = (at + 1) % count;
                let ends = match nodes[at] < nodes[next] {
                    true => [at, next],
                    false => [next, at],
                };
                edges.push((ends.map(|at| nodes[at]), facet, ends));
            }
        }
        edges.sort_unstable();
        for around in edges.chunk_by(|a, b| a.0 == b.0) {
            for (at, &(_, first, ends)) in around.iter().enumerate() {
                for &(_, second, others) in &around[at + 1..] {
                    if normals[first].dot(&normals[second]) >= cosine {
                        for (end, other) in ends.into_iter().zip(others) {
                            faces.join(4 * first + end, 4 * second + other);
                        }
                    }
                }
            }
        }
        faces
    }

    fn root(&self, facet: usize, at: usize) -> usize {
        self.root_of(4 * facet + at)
    }

    fn root_of(&self, mut corner: usize) -> usize {
        while self.parent[corner] != corner {
            corner = self.parent[corner];
        }
        corner
    }

    fn join(&mut self, a: usize, b: usize) {
        let [a, b] = [self.root_of(a), self.root_of(b)];
        self.parent[a.max(b)] = a.min(b);
    }
}

/// Distinct corners of a facet: three or four.
pub fn distinct_corners(facet: &[SurfaceNode; 4]) -> &[SurfaceNode] {
    if facet[2] == facet[3] {
        &facet[..3]
    } else {
        facet
    }
}

fn corners_of_node(node_count: usize, facets: &[[SurfaceNode; 4]]) -> Vec<Vec<Corner>> {
    let mut corners = vec![Vec::new(); node_count];
    for (index, facet) in facets.iter().enumerate() {
        let ring = distinct_corners(facet);
        for (position, &node) in ring.iter().enumerate() {
            corners[node].push(Corner {
                facet: FacetId::new(index),
                next: ring[(position + 1) % ring.len()],
                previous: ring[(position + ring.len() - 1) % ring.len()],
            });
        }
    }
    corners
}

fn boundary_edges(facets: &[[SurfaceNode; 4]]) -> Vec<BoundaryEdge> {
    let mut uses = Vec::with_capacity(4 * facets.len());
    for (index, facet) in facets.iter().enumerate() {
        let ring = distinct_corners(facet);
        for (position, &start) in ring.iter().enumerate() {
            let end = ring[(position + 1) % ring.len()];
            let edge = BoundaryEdge {
                nodes: [start, end],
                facet: FacetId::new(index),
            };
            uses.push(([start.min(end), start.max(end)], edge));
        }
    }
    uses.sort_unstable_by_key(|(ends, _)| *ends);
    uses.chunk_by(|a, b| a.0 == b.0)
        .filter(|edges| edges.len() == 1)
        .map(|edges| edges[0].1)
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nodes_on_an_edge_between_faces_belong_to_both() {
        let n = NodeId::new;
        // A strip of three facets: two in a plane, the third one at a right angle.
        let facets = [
            [n(0), n(1), n(5), n(4)],
            [n(1), n(2), n(6), n(5)],
            [n(2), n(3), n(7), n(6)],
        ];
        let normals = [Vec3::z(), Vec3::z(), Vec3::x()];
        let surface = Surface::with_faces(&facets, &normals, 0.7);
        let nodes = [0, 1, 2, 2, 3, 4, 5, 6, 6, 7].map(n);
        assert_eq!(surface.nodes(), nodes);
        assert_eq!(surface.boundary_edges().len(), 6 + 4);
        let [first, second] = [1, 2].map(|facet| surface.facets()[facet]);
        assert!(first.iter().all(|node| !second.contains(node)));
        assert_eq!(surface.corners(surface.facets()[0][1]).len(), 2);
        let whole = Surface::with_faces(&facets, &normals, -1.0);
        assert_eq!(whole.nodes(), Surface::new(&facets).nodes());
        assert_eq!(whole.facets(), Surface::new(&facets).facets());
    }

    #[test]
    fn two_facets_share_an_edge() {
        let n = NodeId::new;
        let surface = Surface::new(&[[n(3), n(7), n(8), n(4)], [n(7), n(9), n(8), n(8)]]);
        assert_eq!(surface.nodes(), [n(3), n(4), n(7), n(8), n(9)]);
        assert_eq!(surface.boundary_edges().len(), 5);
        assert_eq!(surface.corners(SurfaceNode(2)).len(), 2);
        assert_eq!(surface.corners(SurfaceNode(2))[0].next, SurfaceNode(3));
        assert_eq!(surface.corners(SurfaceNode(2))[0].previous, SurfaceNode(0));
    }
}
