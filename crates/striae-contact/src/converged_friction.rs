//! The converged friction at a node, turned along with the surface.
//!
//! With the edges `E_i` from the node in the last converged configuration, `e_i` now, and
//! the tangents `b_k` of then,
//!
//! ```text
//! a_k = sum_i e_i g_ik,   g_i = (sum_j E_j E_j)^-1 E_i                  what b_k has become
//! c = b_1' . a_1 + b_2' . a_2,   s = b_2' . a_1 - b_1' . a_2,   b_k' = R(n, n^n) b_k
//! tau^n' = (c u + s n x u)/sqrt(c^2 + s^2),   u = R(n, n^n) tau^n
//! ```
//!
//! which is the rotation in the polar decomposition of the surface's deformation: the same
//! at all nodes where that is homogeneous, whatever their edges, and that of rigid motion.

use nalgebra::{Matrix2, Matrix3, Vector2};
use striae_mesh::Vec3;
use striae_surface::node::SurfaceNode;

use crate::{
    configuration::Configuration,
    frame::{Frame, frame_of},
    side::Side,
    tracked::{Tracked, add_chained},
    transported::Transported,
};

/// `tau^n'` of a node with the present `frame`, from its components along the tangents in
/// the configuration `start`.
///
/// # Errors
/// If the facets around the node had collapsed to a line.
pub fn converged_friction(
    configuration: &Configuration,
    start: &Configuration,
    (side, node): (Side, SurfaceNode),
    frame: &Frame,
    components: [f64; 2],
) -> Result<Tracked, CollapsedFacets> {
    let old = frame_of(start, side, node);
    let n_old = old.n.value;
    let b = old.t.each_ref().map(|t| t.value);
    let tau = b[0] * components[0] + b[1] * components[1];
    let turned = |v: &Vec3| Transported::new(v, &n_old, &frame.n.value);
    let [b1, b2] = [turned(&b[0]), turned(&b[1])];
    let [u, v] = [turned(&tau), turned(&n_old.cross(&tau))];
    let edges = edges(configuration, start, side, node, &b)?;
    let a = [0, 1].map(|k| edges.iter().map(|e| e.now * e.share[k]).sum::<Vec3>());
    let c = b1.value.dot(&a[0]) + b2.value.dot(&a[1]);
    let s = b2.value.dot(&a[0]) - b1.value.dot(&a[1]);
    let length = c.hypot(s);
    let value = (u.value * c + v.value * s) / length;
    let by_c = (u.value - value * (c / length)) / length;
    let by_s = (v.value - value * (s / length)) / length;
    let c_by_n = b1.by_n.tr_mul(&a[0]) + b2.by_n.tr_mul(&a[1]);
    let s_by_n = b2.by_n.tr_mul(&a[0]) - b1.by_n.tr_mul(&a[1]);
    let by_n =
        by_c * c_by_n.transpose() + by_s * s_by_n.transpose() + (u.by_n * c + v.by_n * s) / length;
    let numbering = configuration.pair.numbering();
    let own = numbering.position(side, node);
    let mut jacobian = vec![(own, Matrix3::zeros())];
    for edge in &edges {
        let [first, second] = edge.share;
        let c_by_edge = b1.value * first + b2.value * second;
        let s_by_edge = b2.value * first - b1.value * second;
        let block = by_c * c_by_edge.transpose() + by_s * s_by_edge.transpose();
        jacobian.push((numbering.position(side, edge.to), block));
        jacobian[0].1 -= block;
    }
    add_chained(&mut jacobian, &by_n, &frame.n.jacobian);
    Ok(Tracked { value, jacobian })
}

/// A node whose facets have collapsed to a line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CollapsedFacets {
    /// Side of the pair.
    pub side: Side,
    /// Surface-local node.
    pub node: SurfaceNode,
}

/// An edge from a node.
struct Edge {
    /// The node at its end.
    to: SurfaceNode,
    now: Vec3,
    /// `g_i`.
    share: [f64; 2],
}

fn edges(
    configuration: &Configuration,
    start: &Configuration,
    side: Side,
    node: SurfaceNode,
    tangents: &[Vec3; 2],
) -> Result<Vec<Edge>, CollapsedFacets> {
    let (before, now) = (start.side(side), configuration.side(side));
    let corners = before.surface.corners(node);
    let mut ends: Vec<SurfaceNode> = corners
        .iter()
        .flat_map(|corner| [corner.next, corner.previous])
        .collect();
    ends.sort_unstable();
    ends.dedup();
    let from = before.x[node];
    let old = |to: &SurfaceNode| {
        let edge = before.x[*to] - from;
        Vector2::new(tangents[0].dot(&edge), tangents[1].dot(&edge))
    };
    let squares: Matrix2<f64> = ends.iter().map(|to| old(to) * old(to).transpose()).sum();
    let inverse = squares
        .try_inverse()
        .ok_or(CollapsedFacets { side, node })?;
    let edges = ends
        .iter()
        .map(|to| Edge {
            to: *to,
            now: now.x[*to] - now.x[node],
            share: (inverse * old(to)).into(),
        })
        .collect();
    Ok(edges)
}
