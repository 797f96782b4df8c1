//! Rates of convergence to a manufactured solution, for every kind of element.
//!
//! The displacement
//!
//! ```text
//! u(X) = 16 X (1 - X) Y (1 - Y) sin(pi Z) (c + d X)
//! ```
//!
//! vanishes on the boundary of the unit cube; the force per reference volume
//! that keeps it in equilibrium is `b_i = -A_iJkL(F) u_k,JL`, exactly.

use crate::{
    assembly::{Block, Kind, kinds},
    linear_elastic, neo_hookean,
};
use nalgebra::{DMatrix, DVector, Matrix3, Vector3};
use num_dual::{DualNum, hessian};
use std::f64::consts::PI;
use striae_law::bulk::Material;
use striae_mesh::{COMPOSITE_PARTS, CellKind, Vec3};
use striae_verify::fitted_rate;

const CONSTANT: [f64; 3] = [0.08, -0.05, 0.03];
const SLOPE: [f64; 3] = [-0.04, 0.06, 0.02];

/// Component `k` of the displacement.
fn displacement<D: DualNum<Primitive = f64> + Copy>(k: usize, at: &Vector3<D>) -> D {
    let [x, y, z] = [at.x, at.y, at.z];
    let bump = |s: D| s * (s * -4.0 + 4.0);
    bump(x) * bump(y) * (z * PI).sin() * (x * SLOPE[k] + CONSTANT[k])
}

fn body_force(material: &Material, at: &Vec3) -> Vec3 {
    let derivatives = [0, 1, 2].map(|k| hessian(|x| displacement(k, &x), at));
    let f = Matrix3::from_fn(|i, j| derivatives[i].1[j] + if i == j { 1.0 } else { 0.0 });
    let tangent = material.response(&f).unwrap().tangent;
    Vec3::from_fn(|i, _| {
        let mut divergence = 0.0;
        for j in 0..3 {
            for (k, (_, _, second)) in derivatives.iter().enumerate() {
                for l in 0..3 {
                    divergence += tangent[(3 * i + j, 3 * k + l)] * second[(j, l)];
                }
            }
        }
        -divergence
    })
}

/// Natural coordinates and weights that resolve fields in a cell: 3x3x3 Gauss points
/// of the cube, for others those of the cube folded upon them.
fn points(kind: CellKind) -> Vec<(Vec3, f64)> {
    if kind == CellKind::CompositeTetrahedron {
        return points_of_parts();
    }
    let weight = [5.0 / 9.0, 8.0 / 9.0, 5.0 / 9.0];
    let points = (0..27).map(|point| {
        let place = [point % 3, point / 3 % 3, point / 9];
        let at = place.map(|at| (at as f64 - 1.0) * 0.6f64.sqrt());
        let weight: f64 = place.map(|at| weight[at]).iter().product();
        let [r, s, t] = at.map(|at| 0.5 + 0.5 * at);
        let (u, v) = (1.0 - t, 1.0 - s);
        match kind {
            CellKind::Hexahedron => (Vec3::from(at), weight),
            CellKind::Wedge => (Vec3::new(r * v, s, at[2]), weight * v / 4.0),
            CellKind::Pyramid => {
                let at = Vec3::new(at[0] * u, at[1] * u, t);
                (at, weight * u * u / 2.0)
            }
            CellKind::Tetrahedron => {
                let at = Vec3::new(r * v * u, s * u, t);
                (at, weight * v * u * u / 8.0)
            }
            CellKind::CompositeTetrahedron => unreachable!("made of parts"),
        }
    });
    points.collect()
}

/// Points of the linear tetrahedra that a composite one consists of.
fn points_of_parts() -> Vec<(Vec3, f64)> {
    let corners = CellKind::CompositeTetrahedron.shape().corners.iter();
    let mut nodes: Vec<Vec3> = corners.map(|x| Vec3::from(*x)).collect();
    nodes.push(nodes[4..].iter().sum::<Vec3>() / 6.0);
    let inside = points(CellKind::Tetrahedron);
    let of_part = |part: &[usize; 4]| {
        let [a, b, c, d] = part.map(|node| nodes[node]);
        let map = Matrix3::from_columns(&[b - a, c - a, d - a]);
        let placed = inside.iter();
        let placed = placed.map(move |(at, w)| (a + map * at, w * map.determinant()));
        placed.collect::<Vec<_>>()
    };
    COMPOSITE_PARTS.iter().flat_map(of_part).collect()
}

/// Visits points of every element with its corners, the shape functions, the position
/// and the volume.
fn for_each_point(block: &Block, mut visit: impl FnMut(&[usize], &[f64], &Vec3, f64)) {
    let kind = block.mesh.blocks[0].kind;
    let (cell, points) = (kind.shape(), points(kind));
    for nodes in block.mesh.elements() {
        let nodes: Vec<usize> = nodes.iter().map(|node| node.index()).collect();
        let corners: Vec<Vec3> = nodes
            .iter()
            .map(|&node| block.mesh.positions[node])
            .collect();
        for &(local, weight) in &points {
            let gradients = (cell.gradients)(&local);
            let jacobian: Matrix3<f64> = (corners.iter().zip(gradients))
                .map(|(x, gradient)| x * gradient.transpose())
                .sum();
            let values = (cell.interpolation)(&local);
            let at: Vec3 = corners.iter().zip(values).map(|(x, n)| x * n).sum();
            let volume = jacobian.determinant() * weight;
            visit(&nodes, &values, &at, volume);
        }
    }
}

/// `L2` norm of the error of the displacement on a block of `n^3` hexahedra.
fn error(n: usize, kind: Kind, material: &Material) -> f64 {
    let block = Block::new(n, 0.1, kind);
    let mut load = DVector::zeros(3 * block.mesh.positions.len());
    for_each_point(&block, |nodes, values, at, volume| {
        let force = body_force(material, at) * volume;
        for (node, value) in nodes.iter().zip(values) {
            let mut at_node = load.fixed_rows_mut::<3>(3 * node);
            at_node += force * *value;
        }
    });
    let no_tangent = DMatrix::zeros(load.len(), load.len());
    let start = block.mesh.positions.clone();
    let x = block.solve(
        material,
        |_| (load.clone(), no_tangent.clone()),
        &start,
        |unknown| block.on_boundary(unknown),
    );
    let mut square = 0.0;
    for_each_point(&block, |nodes, values, at, volume| {
        let found: Vec3 = (nodes.iter().zip(values))
            .map(|(&node, value)| (x[node] - start[node]) * *value)
            .sum();
        let exact = Vec3::from_fn(|k, _| displacement(k, at));
        square += (found - exact).norm_squared() * volume;
    });
    square.sqrt()
}

#[test]
fn displacements_converge_with_the_square_of_the_mesh_size() {
    for (kind, material) in kinds().zip([neo_hookean(), linear_elastic()].into_iter().cycle()) {
        // Pyramids have a node more in each hexahedron. What has triangles comes to its rate
        // late: tetrahedra by 1.49, 1.73 and 1.83 between 3, 4, 6 and 8 divisions. Composite
        // ones come to it from above: by 2.24 and 2.15 between 2, 3 and 4.
        let (divisions, range) = match kind.0 {
            CellKind::Pyramid => ([2, 3, 4], 1.85..2.2),
            CellKind::CompositeTetrahedron => ([2, 3, 4], 1.85..2.25),
            CellKind::Tetrahedron | CellKind::Wedge => ([6, 7, 8], 1.8..2.2),
            _ => ([3, 4, 6], 1.85..2.2),
        };
        let sizes = divisions.map(|n| 1.0 / n as f64);
        let errors = divisions.map(|n| error(n, kind, &material));
        let rate = fitted_rate(&sizes, &errors);
        assert!(range.contains(&rate), "{kind:?}: rate {rate} of {errors:?}");
    }
}
