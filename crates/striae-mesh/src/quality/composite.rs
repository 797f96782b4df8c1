//! Volumes of the points of composite tetrahedra.

use super::jacobian_determinant;
use crate::{CellKind, Vec3, composite_linear};

/// Volumes `w_g = int psi_g dV` of the four points: a quarter of that of a regular tetrahedron.
pub(super) fn composite_volumes(corners: &[Vec3]) -> [f64; 4] {
    let mut volumes = [0.0; 4];
    let kind = CellKind::CompositeTetrahedron;
    for &(middle, weight) in kind.shape().points {
        let volume = weight * jacobian_determinant(kind, corners, middle);
        let shares = composite_linear(&Vec3::from(middle));
        for (sum, share) in volumes.iter_mut().zip(shares) {
            *sum += volume * share;
        }
    }
    volumes
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn volumes_of_the_points_are_quarters_and_sum_to_that_of_the_parts() {
        let shape = CellKind::CompositeTetrahedron.shape();
        let corners = shape.corners.iter();
        let regular: Vec<Vec3> = corners.map(|x| Vec3::from(*x)).collect();
        for volume in composite_volumes(&regular) {
            assert!((volume - 1.0 / 24.0).abs() < 1e-15, "{volume}");
        }
        let moved = regular.iter();
        let bent: Vec<Vec3> = moved
            .map(|x| x + Vec3::new(0.1 * x.y * x.y, 0.2 * x.z * x.x, 0.0))
            .collect();
        let sum: f64 = composite_volumes(&bent).iter().sum();
        let of_parts = |&(at, weight): &([f64; 3], f64)| {
            weight * jacobian_determinant(CellKind::CompositeTetrahedron, &bent, at)
        };
        let volume: f64 = shape.points.iter().map(of_parts).sum();
        assert!((sum - volume).abs() < 1e-15, "{sum} {volume}");
    }
}
