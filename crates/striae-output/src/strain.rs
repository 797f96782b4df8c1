//! Logarithmic strain at the nodes.
//!
//! At every quadrature point, with the deformation gradient of the displacement,
//!
//! ```text
//! F = sum_a x_a (x) dN_a/dX,   ln V = 1/2 ln(F F^T)
//! ```
//!
//! In each element the linear field in natural coordinates that fits the values at the
//! quadrature points best is continued to the corners; at each node the values of its
//! elements are averaged with their reference volumes. Uniform strain is reproduced exactly.
//! Elements with mean dilatation show the strain of the displacement, whose volume ratio is
//! that of the material in the mean only.

use nalgebra::{Matrix3, Matrix4, SymmetricEigen, Vector4};
use striae_mesh::{CellKind, Mesh, Vec3};

/// Sums over the elements at every node of logarithmic strain `ln V` times volume, and of
/// volume, in a mesh whose nodes have moved to `positions`; `None` where an element is turned
/// inside out.
pub(crate) fn strain_sums(
    mesh: &Mesh,
    positions: &[Vec3],
) -> Option<(Vec<Matrix3<f64>>, Vec<f64>)> {
    let mut strain = vec![Matrix3::zeros(); positions.len()];
    let mut volume = vec![0.0; positions.len()];
    for block in &mesh.blocks {
        let continued = continuation(block.kind);
        for corners in block.cells() {
            let at = |x: &[Vec3]| -> Vec<Vec3> { corners.iter().map(|c| x[c.index()]).collect() };
            let (values, size) = at_points(block.kind, &at(&mesh.positions), &at(positions))?;
            for (node, weights) in corners.iter().zip(&continued) {
                let values = values.iter().zip(weights);
                let value: Matrix3<f64> = values.map(|(value, weight)| value * *weight).sum();
                strain[node.index()] += value * size;
                volume[node.index()] += size;
            }
        }
    }
    Some((strain, volume))
}

/// Strain at the quadrature points of a cell, and its reference volume.
fn at_points(kind: CellKind, reference: &[Vec3], now: &[Vec3]) -> Option<(Vec<Matrix3<f64>>, f64)> {
    let shape = kind.shape();
    let mut volume = 0.0;
    let mut values = Vec::with_capacity(shape.points.len());
    for (place, weight) in shape.points {
        let gradients = (shape.gradients)(&Vec3::from(*place));
        let slopes = |x: &[Vec3]| -> Matrix3<f64> {
            let products = x.iter().zip(&gradients);
            products.map(|(x, gradient)| x * gradient.transpose()).sum()
        };
        let jacobian = slopes(reference);
        volume += weight * jacobian.determinant();
        let f = slopes(now) * jacobian.try_inverse()?;
        if f.determinant() <= 0.0 {
            return None;
        }
        values.push(logarithm(&(f * f.transpose())) * 0.5);
    }
    Some((values, volume))
}

/// Logarithm of a symmetric, positive definite tensor.
fn logarithm(b: &Matrix3<f64>) -> Matrix3<f64> {
    let eigen = SymmetricEigen::new(*b);
    let logarithms = Matrix3::from_diagonal(&eigen.eigenvalues.map(f64::ln));
    eigen.eigenvectors * logarithms * eigen.eigenvectors.transpose()
}

/// Weights of the quadrature points at every corner: those of the best linear fit.
fn continuation(kind: CellKind) -> Vec<Vec<f64>> {
    let shape = kind.shape();
    let row = |[x, y, z]: [f64; 3]| Vector4::new(1.0, x, y, z);
    let rows: Vec<Vector4<f64>> = shape.points.iter().map(|(place, _)| row(*place)).collect();
    let normal: Matrix4<f64> = rows.iter().map(|row| row * row.transpose()).sum();
    let inverse = normal.try_inverse();
    let inverse = inverse.expect("quadrature points do not lie in a plane");
    let at = |corner: &[f64; 3]| {
        let of_corner = inverse * row(*corner);
        rows.iter().map(|row| row.dot(&of_corner)).collect()
    };
    shape.corners.iter().map(at).collect()
}

#[cfg(test)]
mod tests {
    use nalgebra::Rotation3;
    use striae_mesh::{CellBlock, NodeId};

    use super::*;

    /// One cell of each kind with its corners at their natural coordinates.
    fn cell(kind: CellKind) -> Mesh {
        let corners = kind.shape().corners;
        let positions = corners.iter().map(|place| Vec3::from(*place)).collect();
        let nodes = (0..corners.len()).map(NodeId::new).collect();
        Mesh::new(positions, vec![CellBlock { kind, nodes }]).unwrap()
    }

    #[test]
    fn uniform_strain_is_exact_in_all_kinds_of_cells_under_any_rotation() {
        let turn = *Rotation3::from_euler_angles(0.4, -1.0, 0.7).matrix();
        let along = *Rotation3::from_euler_angles(-0.2, 0.5, 1.9).matrix();
        let stretch = |values: Vec3| along * Matrix3::from_diagonal(&values) * along.transpose();
        let f = turn * stretch(Vec3::new(1.3, 0.8, 1.1));
        let logarithms = Vec3::new(1.3, 0.8, 1.1).map(f64::ln);
        let expected = turn * stretch(logarithms) * turn.transpose();
        for kind in CellKind::ALL {
            let mesh = cell(kind);
            let moved: Vec<Vec3> = mesh.positions.iter().map(|x| f * x).collect();
            let (sums, volumes) = strain_sums(&mesh, &moved).unwrap();
            for (sum, volume) in sums.iter().zip(volumes) {
                let strain = sum / volume;
                assert!((strain - expected).norm() < 1e-13, "{kind}: {strain}");
            }
        }
    }

    #[test]
    fn a_cell_that_is_turned_inside_out_has_no_strain() {
        let mesh = cell(CellKind::Hexahedron);
        let turned: Vec<Vec3> = mesh.positions.iter().map(|x| -x).collect();
        assert_eq!(strain_sums(&mesh, &turned), None);
    }
}
