//! Nodal normals and their variations.
//!
//! The normal of a node is the normalised sum over its facet corners of
//! `(x_next - x_I) x (x_previous - x_I)`, Jones & Papadopoulos (2006), eq. (52).

use nalgebra::Matrix3;
use striae_mesh::Vec3;

use crate::{node::SurfaceNode, topology::Surface};

/// Unit outward normals of all nodes at the positions `x` of the surface nodes.
pub fn nodal_normals(surface: &Surface, x: &[Vec3]) -> Vec<Vec3> {
    SurfaceNode::all(x.len())
        .map(|node| corner_sum(surface, x, node).normalize())
        .collect()
}

/// `d n_I / d x_J` for the node `I` and every node `J` that it depends on.
pub fn normal_jacobian(
    surface: &Surface,
    x: &[Vec3],
    node: SurfaceNode,
) -> Vec<(SurfaceNode, Matrix3<f64>)> {
    let sum = corner_sum(surface, x, node);
    let length = sum.norm();
    let n = sum / length;
    let projector = (Matrix3::identity() - n * n.transpose()) / length;
    let mut blocks: Vec<(SurfaceNode, Matrix3<f64>)> = Vec::with_capacity(10);
    let mut add = |other: SurfaceNode, block: Matrix3<f64>| match blocks
        .iter_mut()
        .find(|(known, _)| *known == other)
    {
        Some((_, sum)) => *sum += block,
        None => blocks.push((other, block)),
    };
    for corner in surface.corners(node) {
        let forward = (x[corner.next] - x[node]).cross_matrix();
        let backward = (x[corner.previous] - x[node]).cross_matrix();
        add(corner.next, -projector * backward);
        add(corner.previous, projector * forward);
        add(node, projector * (backward - forward));
    }
    blocks
}

fn corner_sum(surface: &Surface, x: &[Vec3], node: SurfaceNode) -> Vec3 {
    let origin = x[node];
    surface
        .corners(node)
        .iter()
        .map(|corner| (x[corner.next] - origin).cross(&(x[corner.previous] - origin)))
        .sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use striae_mesh::NodeId;

    fn bumpy() -> (Surface, Vec<Vec3>) {
        let n = NodeId::new;
        let facet = |i: usize, j: usize| {
            let at = |i: usize, j: usize| n(i + 4 * j);
            [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]
        };
        let facets: Vec<_> = (0..9).map(|k| facet(k % 3, k / 3)).collect();
        let x = (0..16)
            .map(|k| {
                let (i, j) = ((k % 4) as f64, (k / 4) as f64);
                Vec3::new(i, j, 0.3 * (1.3 * i + 0.4 * j).sin() + 0.1 * i * j)
            })
            .collect();
        (Surface::new(&facets), x)
    }

    #[test]
    fn normals_of_a_plane_point_up() {
        let (surface, mut x) = bumpy();
        x.iter_mut().for_each(|p| p.z = 0.0);
        for normal in nodal_normals(&surface, &x) {
            assert_eq!(normal, Vec3::z());
        }
    }

    #[test]
    fn jacobian_error_falls_at_second_order() {
        let (surface, x) = bumpy();
        for node in SurfaceNode::all(16) {
            let error = |step: f64| {
                let mut exact = Vec3::zeros();
                let (mut plus, mut minus) = (x.clone(), x.clone());
                for (other, block) in normal_jacobian(&surface, &x, node) {
                    let k = f64::from(other.0);
                    let direction = Vec3::new((3.0 * k).sin(), (5.0 * k).cos(), (k * k).sin());
                    exact += block * direction;
                    plus[other] += direction * step;
                    minus[other] -= direction * step;
                }
                let change =
                    nodal_normals(&surface, &plus)[node] - nodal_normals(&surface, &minus)[node];
                (change / (2.0 * step) - exact).norm()
            };
            let ratio = error(1e-2) / error(5e-3);
            assert!(ratio > 3.5 && ratio < 4.5, "{node}: ratio {ratio}");
        }
    }
}
