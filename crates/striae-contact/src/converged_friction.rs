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
//! Where `sum_j E_j E_j` has rank 1, its pseudo-inverse gives the rotation of that line.

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

/// Round-off of a determinant in units of the square of the trace.
const ROUND_OFF: f64 = 1e-14;

/// `tau^n'` of a node with the present `frame`, from its components along the tangents in
/// the configuration `start`.
pub fn converged_friction(
    configuration: &Configuration,
    start: &Configuration,
    (side, node): (Side, SurfaceNode),
    frame: &Frame,
    components: [f64; 2],
) -> Tracked {
    let old = frame_of(start, side, node);
    let n_old = old.n.value;
    let b = old.t.each_ref().map(|t| t.value);
    let tau = b[0] * components[0] + b[1] * components[1];
    let turned = |v: &Vec3| Transported::new(v, &n_old, &frame.n.value);
    let [b1, b2] = [turned(&b[0]), turned(&b[1])];
    let [u, v] = [turned(&tau), turned(&n_old.cross(&tau))];
    let edges = edges(configuration, start, (side, node), &b);
    let a = [0, 1].map(|k| edges.iter().map(|e| e.now * e.share[k]).sum::<Vec3>());
    let mut c = b1.value.dot(&a[0]) + b2.value.dot(&a[1]);
    let s = b2.value.dot(&a[0]) - b1.value.dot(&a[1]);
    if c == 0.0 && s == 0.0 {
        // No edge tells a rotation.
        c = 1.0;
    }
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
    Tracked { value, jacobian }
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
    (side, node): (Side, SurfaceNode),
    tangents: &[Vec3; 2],
) -> Vec<Edge> {
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
    let inverse = inverse(&squares);
    ends.iter()
        .map(|to| Edge {
            to: *to,
            now: now.x[*to] - now.x[node],
            share: (inverse * old(to)).into(),
        })
        .collect()
}

/// Inverse of `sum_j E_j E_j`; where the tangents see all edges in one line, as next to a rigid
/// surface that stands upright on them, the pseudo-inverse.
fn inverse(squares: &Matrix2<f64>) -> Matrix2<f64> {
    let trace = squares.trace();
    if squares.determinant() > ROUND_OFF * trace * trace
        && let Some(inverse) = squares.try_inverse()
    {
        return inverse;
    }
    match trace > 0.0 {
        true => Matrix2::identity() / trace,
        false => Matrix2::zeros(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn edges_in_one_line_have_the_pseudo_inverse() {
        let edges = [Vector2::new(0.3, -0.4), Vector2::new(0.6, -0.8)];
        let squares: Matrix2<f64> = edges.iter().map(|e| e * e.transpose()).sum();
        let share = inverse(&squares) * edges[0];
        // The pseudo-inverse of `1.25 d d`, applied to `0.5 d`.
        let expected = Vector2::new(0.6, -0.8) * (0.5 / 1.25);
        assert!((share - expected).norm() < 1e-15);
        assert_eq!(inverse(&Matrix2::zeros()), Matrix2::zeros());
        let all = squares + Matrix2::new(0.01, 0.0, 0.0, 0.0);
        let whole = inverse(&all) * all;
        assert!((whole - Matrix2::identity()).norm() < 1e-12);
    }
}
