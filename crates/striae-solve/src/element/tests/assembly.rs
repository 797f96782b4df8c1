//! The unit cube as a block of elements with dense matrices.

use super::*;
use crate::element::{ReferenceElement, reference_elements};
use nalgebra::{DMatrix, DVector};
use striae_mesh::{Mesh, NodeId, generate};

/// A block of `n^3` elements over the unit cube.
pub(super) struct Block {
    pub(super) mesh: Mesh,
    pub(super) reference: Vec<ReferenceElement>,
}

/// A nodal force with its derivative by the node positions.
pub(super) type Force = (DVector<f64>, DMatrix<f64>);

impl Block {
    /// The block with nodes disturbed by up to the fraction `irregularity` of a
    /// mesh size; those on faces and edges of the cube stay on them.
    pub(super) fn new(n: usize, irregularity: f64) -> Self {
        let block = generate::Block {
            divisions: [n; 3],
            irregularity,
            seed: n as u64,
            ..generate::Block::default()
        };
        let mesh = block.mesh().unwrap();
        let reference = reference_elements(&mesh).unwrap();
        Self { mesh, reference }
    }

    /// Whether an unknown belongs to a node on the surface of the cube.
    pub(super) fn on_boundary(&self, unknown: usize) -> bool {
        let position = self.mesh.positions[unknown / 3];
        position.iter().any(|&x| x == 0.0 || x == 1.0)
    }

    /// No force at all.
    pub(super) fn zero(&self) -> Force {
        let size = 3 * self.mesh.positions.len();
        (DVector::zeros(size), DMatrix::zeros(size, size))
    }

    /// Internal force at the node positions `x`.
    pub(super) fn internal(&self, x: &[Vec3], material: &Material) -> Force {
        let mut total = self.zero();
        for (corners, element) in self.mesh.elements.iter().zip(&self.reference) {
            let current = corners.map(|node| x[node.index()]);
            let local = element.response(&current, material).unwrap();
            scatter(
                corners,
                &local.force,
                &local.stiffness.by_rows(),
                &mut total,
            );
        }
        total
    }

    /// Newton's method from `start`; the unknowns named by `fixed` rest.
    pub(super) fn solve(
        &self,
        material: &Material,
        external: impl Fn(&[Vec3]) -> Force,
        start: &[Vec3],
        fixed: impl Fn(usize) -> bool,
    ) -> Vec<Vec3> {
        let free: Vec<usize> = (0..3 * start.len()).filter(|&u| !fixed(u)).collect();
        let mut x = start.to_vec();
        for _ in 0..12 {
            let ((force, stiffness), (load, tangent)) = (self.internal(&x, material), external(&x));
            let residual = (force - load).select_rows(&free);
            if residual.norm() < 1e-14 {
                return x;
            }
            let matrix = (stiffness - tangent)
                .select_rows(&free)
                .select_columns(&free);
            let step = matrix.lu().solve(&residual).expect("a regular tangent");
            for (step, &unknown) in step.iter().zip(&free) {
                x[unknown / 3][unknown % 3] -= step;
            }
        }
        panic!("Newton's method did not converge");
    }
}

/// Adds a local force and tangent to the whole.
pub(super) fn scatter(nodes: &[NodeId], force: &[f64], tangent: &[f64], total: &mut Force) {
    let global = |row: usize| 3 * nodes[row / 3].index() + row % 3;
    for row in 0..force.len() {
        total.0[global(row)] += force[row];
        for column in 0..force.len() {
            total.1[(global(row), global(column))] += tangent[force.len() * row + column];
        }
    }
}
