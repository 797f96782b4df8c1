//! Edge graph of a surface and shortest distances along it.
//!
//! The nodes of the graph are the nodes of the surface, its edges the sides of
//! the facets (no diagonals), weighed by their length `|X_J - X_I|` in the
//! reference configuration. The distance of two nodes is the length of the
//! shortest chain of edges between them: E. W. Dijkstra, "A note on two problems
//! in connexion with graphs", Numer. Math. 1 (1959), doi:10.1007/BF01386390, with
//! a binary heap, `O(E log N)` a source. Nodes of another component are at
//! infinite distance.
//!
//! Distances do not depend on the numbering, not even in the last digit: every
//! one is the least of sums formed in the order of the chain, and rounding is
//! monotone. Units: length.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use striae_mesh::Vec3;

use crate::{node::SurfaceNode, topology::distinct_corners};

#[cfg(test)]
mod tests;

/// An undirected graph with positive lengths, by compressed rows.
pub(crate) struct EdgeGraph {
    offsets: Vec<usize>,
    arcs: Vec<Arc>,
}

#[derive(Clone, Copy)]
struct Arc {
    to: SurfaceNode,
    length: f64,
}

impl EdgeGraph {
    /// The graph of the sides of `facets`.
    pub(crate) fn new(positions: &[Vec3], facets: &[[SurfaceNode; 4]]) -> Self {
        let mut sides: Vec<(SurfaceNode, SurfaceNode)> = facets.iter().flat_map(sides).collect();
        sides.sort_unstable();
        sides.dedup();
        let length = |a: SurfaceNode, b: SurfaceNode| (positions[a] - positions[b]).norm();
        Self::from_edges(
            positions.len(),
            sides.into_iter().map(|(a, b)| (a, b, length(a, b))),
        )
    }

    /// The graph of `nodes` nodes with edges `(a, b, length)`.
    pub(crate) fn from_edges(
        nodes: usize,
        edges: impl IntoIterator<Item = (SurfaceNode, SurfaceNode, f64)>,
    ) -> Self {
        let mut rows = vec![Vec::new(); nodes];
        for (a, b, length) in edges {
            rows[a].push(Arc { to: b, length });
            rows[b].push(Arc { to: a, length });
        }
        let mut offsets = vec![0];
        offsets.extend(rows.iter().scan(0, |end, row| {
            *end += row.len();
            Some(*end)
        }));
        Self {
            offsets,
            arcs: rows.concat(),
        }
    }

    /// Shortest distance of every node from `source`.
    pub(crate) fn distances_from(&self, source: SurfaceNode) -> Vec<f64> {
        let mut distances = vec![f64::INFINITY; self.offsets.len() - 1];
        distances[source] = 0.0;
        let mut front = BinaryHeap::from([Reached {
            distance: 0.0,
            node: source,
        }]);
        while let Some(Reached { distance, node }) = front.pop() {
            let node = node.index();
            if distance > distances[node] {
                continue;
            }
            for arc in &self.arcs[self.offsets[node]..self.offsets[node + 1]] {
                let through = distance + arc.length;
                if through < distances[arc.to] {
                    distances[arc.to] = through;
                    front.push(Reached {
                        distance: through,
                        node: arc.to,
                    });
                }
            }
        }
        distances
    }
}

fn sides(facet: &[SurfaceNode; 4]) -> impl Iterator<Item = (SurfaceNode, SurfaceNode)> {
    let corners = distinct_corners(facet);
    (0..corners.len()).map(|i| {
        let (a, b) = (corners[i], corners[(i + 1) % corners.len()]);
        (a.min(b), a.max(b))
    })
}

/// A node on the front, the nearest one greatest; ties by number.
#[derive(PartialEq)]
struct Reached {
    distance: f64,
    node: SurfaceNode,
}

impl Eq for Reached {}

impl Ord for Reached {
    fn cmp(&self, other: &Self) -> Ordering {
        (other.distance.total_cmp(&self.distance)).then(other.node.cmp(&self.node))
    }
}

impl PartialOrd for Reached {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}
