//! The normal of a pair of facets.
//!
//! ```text
//! n = unit(c_b n_a - c_a n_b),   dn = (I - n n)/|s| (c_b dn_a - c_a dn_b),   s = c_b n_a - c_a n_b
//! n_i = unit(p x q),   dn_i = (I - n_i n_i)/|p x q| ([p] dq - [q] dp)
//! ```
//!
//! with the diagonals `p = x_2 - x_0`, `q = x_3 - x_1` of a quadrilateral, the edges
//! `p = x_1 - x_0`, `q = x_2 - x_0` of a triangle.

use nalgebra::Matrix3;
use striae_mesh::Vec3;
use striae_surface::facet::Shape;

use super::Facet;

/// Unit normal of a facet; `None` if it has no area.
pub(crate) fn facet_normal(facet: &Facet) -> Option<Vec3> {
    let [p, q] = spans(facet);
    p.cross(&q).try_normalize(0.0)
}

fn spans(facet: &Facet) -> [Vec3; 2] {
    let x = &facet.corners;
    match facet.shape {
        Shape::Triangle => [x[1] - x[0], x[2] - x[0]],
        Shape::Quadrilateral => [x[2] - x[0], x[3] - x[1]],
    }
}

/// `dn_i/dx_c` of a facet.
pub(super) fn facet_slopes(facet: &Facet, n: &Vec3) -> [Matrix3<f64>; 4] {
    let [p, q] = spans(facet);
    let projector = across(n) / p.cross(&q).norm();
    let (by_q, by_p) = (projector * p.cross_matrix(), -projector * q.cross_matrix());
    match facet.shape {
        Shape::Triangle => [-by_p - by_q, by_p, by_q, Matrix3::zeros()],
        Shape::Quadrilateral => [-by_p, -by_q, by_p, by_q],
    }
}

/// `I - n n`.
fn across(n: &Vec3) -> Matrix3<f64> {
    Matrix3::identity() - n * n.transpose()
}

/// The normal of a pair of facets with these unit normals.
pub(super) fn pair_normal([n_a, n_b]: [&Vec3; 2], [c_a, c_b]: [f64; 2]) -> Option<Vec3> {
    let scale = c_a.max(c_b);
    if scale <= 0.0 {
        return None;
    }
    (n_a * (c_b / scale) - n_b * (c_a / scale)).try_normalize(0.0)
}

/// `dn/dx_c` of the pair by all corners.
pub(super) fn pair_slopes(
    facets: [&Facet; 2],
    normals: [&Vec3; 2],
    [c_a, c_b]: [f64; 2],
) -> [Matrix3<f64>; 8] {
    let mut slopes = [Matrix3::zeros(); 8];
    let scale = c_a.max(c_b);
    let shares = [c_b / scale, -c_a / scale];
    let sum = normals[0] * shares[0] + normals[1] * shares[1];
    let length = sum.norm();
    let projector = across(&(sum / length)) / length;
    for side in 0..2 {
        if shares[side] == 0.0 {
            continue;
        }
        let own = facet_slopes(facets[side], normals[side]);
        for (corner, slope) in own.iter().enumerate() {
            slopes[4 * side + corner] = projector * slope * shares[side];
        }
    }
    slopes
}
