//! Splitting of nodal directions into edge ordinates, and their convection.
//!
//! On a facet with edges `E_J`, `E_K` at node `I`, in such an order that `E_J x E_K` points
//! outward, `A = alpha E_J + beta E_K + gamma N` gives
//!
//! ```text
//! alpha = A . (E_K x N)/d,   beta = A . (N x E_J)/d,   d = N . (E_J x E_K)
//! ```
//!
//! Averaged over the `m` facets at the node (paper, equation (50)), the ordinates of an edge
//! that two facets share add up: `w_J = (1/m) sum_f alpha_f`. Convection, equation (51), is then
//! `s_I ~ sum_J w_J (x_J - x_I)`: a linear map of the positions of the node and of its ring.

use std::collections::BTreeMap;

use nalgebra::Vector3;
use striae_mesh::{FacetId, Vec3};

use super::{Axes, TextureError};
use crate::{
    node::SurfaceNode,
    scalar::{Real, constant, scaled},
    topology::distinct_corners,
};

/// Least `d/(|E_J| |E_K|)` of a facet's corner.
const FLAT: f64 = 1e-6;

/// The neighbours of a node along edges and its ordinates on them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ordinates<'a> {
    /// Neighbours in ascending order.
    pub ring: &'a [SurfaceNode],
    /// Ordinate on the edge to each neighbour, 1/length.
    pub weights: &'a [f64],
}

impl Ordinates<'_> {
    /// Texture for current positions of the node and of its [`ring`](Self::ring), in the same
    /// order, and for its unit normal; `None` where the convected direction has no tangential
    /// part.
    ///
    /// Generic over the scalar, so that dual numbers give the derivatives.
    pub(crate) fn convect<D: Real>(
        &self,
        position: Vector3<D>,
        neighbours: &[Vector3<D>],
        normal: Vector3<D>,
    ) -> Option<Axes<D>> {
        debug_assert_eq!(neighbours.len(), self.weights.len());
        let mut direction = Vector3::from_element(constant(0.0));
        for (neighbour, &weight) in neighbours.iter().zip(self.weights) {
            direction += scaled(&(neighbour - position), constant(weight));
        }
        Axes::along(direction, normal)
    }
}

/// Averaged ordinates of every node, by neighbour, for unit tangential `directions`.
pub(super) fn split(
    positions: &[Vec3],
    facets: &[[SurfaceNode; 4]],
    normals: &[Vec3],
    directions: &[Vec3],
) -> Vec<BTreeMap<SurfaceNode, f64>> {
    let mut facets_at = vec![0.0; positions.len()];
    let mut rings = vec![BTreeMap::new(); positions.len()];
    for corner in facets.iter().flat_map(|facet| fans(positions, facet)) {
        let node = corner.node.index();
        let [e_j, e_k] = corner.edges;
        let (direction, normal) = (directions[node], normals[node]);
        let d = normal.dot(&e_j.cross(&e_k));
        *rings[node].entry(corner.next).or_insert(0.0) += direction.dot(&e_k.cross(&normal)) / d;
        *rings[node].entry(corner.previous).or_insert(0.0) +=
            direction.dot(&normal.cross(&e_j)) / d;
        facets_at[node] += 1.0;
    }
    for (ring, count) in rings.iter_mut().zip(facets_at) {
        ring.values_mut().for_each(|weight| *weight /= count);
    }
    rings
}

/// Checks that every node has facets and that all facets have corners that can carry ordinates.
pub(super) fn check(
    positions: &[Vec3],
    facets: &[[SurfaceNode; 4]],
    normals: &[Vec3],
) -> Result<(), TextureError> {
    let nodes = positions.len();
    if normals.len() != nodes {
        return Err(TextureError::Count {
            what: "normals",
            found: normals.len(),
            nodes,
        });
    }
    let mut loose = vec![true; nodes];
    for (number, facet) in facets.iter().enumerate() {
        if let Some(&node) = facet.iter().find(|&&node| node.index() >= nodes) {
            return Err(TextureError::MissingNode { node, nodes });
        }
        for corner in fans(positions, facet) {
            let [e_j, e_k] = corner.edges;
            let d = normals[corner.node].dot(&e_j.cross(&e_k));
            let spans_area = d > FLAT * e_j.norm() * e_k.norm();
            if !spans_area {
                let (facet, node) = (FacetId::new(number), corner.node);
                return Err(TextureError::DegenerateFacet { facet, node });
            }
            loose[corner.node] = false;
        }
    }
    match loose.iter().position(|&loose| loose) {
        Some(node) => Err(TextureError::LooseNode {
            node: SurfaceNode::new(node),
        }),
        None => Ok(()),
    }
}

/// A corner of a facet with the edges to the next and to the previous corner.
struct Corner {
    node: SurfaceNode,
    next: SurfaceNode,
    previous: SurfaceNode,
    edges: [Vec3; 2],
}

fn fans<'a>(
    positions: &'a [Vec3],
    facet: &'a [SurfaceNode; 4],
) -> impl Iterator<Item = Corner> + 'a {
    let corners = distinct_corners(facet);
    let count = corners.len();
    (0..count).map(move |i| {
        let [node, next, previous] = [i, i + 1, i + count - 1].map(|k| corners[k % count]);
        let edge = |to: SurfaceNode| positions[to] - positions[node];
        Corner {
            node,
            next,
            previous,
            edges: [edge(next), edge(previous)],
        }
    })
}
