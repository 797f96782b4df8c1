//! Rates of convergence to a manufactured solution.
//!
//! The displacement
//!
//! ```text
//! u(X) = 16 X (1 - X) Y (1 - Y) sin(pi Z) (c + d X)
//! ```
//!
//! vanishes on the boundary of the unit cube; the force per reference volume
//! that keeps it in equilibrium is `b_i = -A_iJkL(F) u_k,JL`, exactly.

use super::assembly::Block;
use super::*;
use crate::element::shape::{shape, shape_gradients};
use nalgebra::{DMatrix, DVector, Matrix3, Vector3};
use num_dual::{DualNum, hessian};
use std::f64::consts::PI;
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

/// Visits 3x3x3 Gauss points of every element with its corners, the shape
/// functions, the position and the volume.
fn for_each_point(block: &Block, mut visit: impl FnMut(&[usize; 8], &[f64; 8], &Vec3, f64)) {
    let weight = [5.0 / 9.0, 8.0 / 9.0, 5.0 / 9.0];
    for nodes in &block.mesh.elements {
        let nodes = nodes.map(|node| node.index());
        let corners = nodes.map(|node| block.mesh.positions[node]);
        for point in 0..27 {
            let place = [point % 3, point / 3 % 3, point / 9];
            let local = Vec3::from_fn(|j, _| (place[j] as f64 - 1.0) * 0.6f64.sqrt());
            let gradients = shape_gradients(&local);
            let jacobian: Matrix3<f64> =
                (0..8).map(|a| corners[a] * gradients[a].transpose()).sum();
            let values = shape(&local);
            let at: Vec3 = (0..8).map(|a| corners[a] * values[a]).sum();
            let volume = jacobian.determinant() * place.map(|l| weight[l]).iter().product::<f64>();
            visit(&nodes, &values, &at, volume);
        }
    }
}

/// `L2` norm of the error of the displacement on a block of `n^3` elements.
fn error(n: usize, material: &Material) -> f64 {
    let block = Block::new(n, 0.1);
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
        let found: Vec3 = (0..8)
            .map(|a| (x[nodes[a]] - start[nodes[a]]) * values[a])
            .sum();
        let exact = Vec3::from_fn(|k, _| displacement(k, at));
        square += (found - exact).norm_squared() * volume;
    });
    square.sqrt()
}

#[test]
fn displacements_converge_with_the_square_of_the_mesh_size() {
    for material in [neo_hookean(), linear_elastic()] {
        let divisions = [3, 4, 6];
        let sizes = divisions.map(|n| 1.0 / n as f64);
        let errors = divisions.map(|n| error(n, &material));
        let rate = fitted_rate(&sizes, &errors);
        assert!((1.85..2.2).contains(&rate), "rate {rate} of {errors:?}");
    }
}
