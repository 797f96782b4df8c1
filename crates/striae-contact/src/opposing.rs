//! A projection along a node's own normal with its derivatives, and nodal vectors of
//! the other side brought there.
//!
//! The projection solves `r = sum N_J x_J - x_I - g n_I = 0`. With the inverse `J^-1`
//! of `dr/d(xi, eta, g)` and `dr` at fixed `(xi, eta, g)`
//!
//! ```text
//! d(xi, eta, g) = -J^-1 dr,   dr = sum N_J dx_J - dx_I - g dn_I
//! ```
//!
//! so all that follows from a projection depends on positions and normal through `dr`.

use nalgebra::Matrix3;
use striae_mesh::Vec3;
use striae_surface::{facet::Shape, scalar::combination};

use crate::{projection::Hit, term::add_block, transported::Transported};

/// The point of a facet opposite to a node.
pub struct Opposing {
    /// Gap.
    pub gap: f64,
    /// `N_J`.
    pub weights: [f64; 4],
    /// `dN_J/dr`.
    pub weights_by_r: [Vec3; 4],
    /// `dg/dr`.
    pub gap_by_r: Vec3,
}

/// Lanes of the node's position and normal and of the four corners.
#[derive(Clone, Copy, Debug)]
pub struct PlaceLanes {
    /// Three lanes from here on.
    pub x: usize,
    /// Three lanes from here on.
    pub n: usize,
    /// Twelve lanes from here on.
    pub corners: usize,
}

impl Opposing {
    /// At a converged projection along `n`.
    pub fn new(shape: Shape, hit: &Hit, n: &Vec3, corners: &[Vec3; 4]) -> Self {
        let weights = shape.weights(hit.xi, hit.eta);
        let by_xi = combination(&weights.d_xi, corners);
        let by_eta = combination(&weights.d_eta, corners);
        let inverse = Matrix3::from_columns(&[by_xi, by_eta, -n])
            .try_inverse()
            .expect("a converged projection has a regular Jacobian");
        let [xi, eta, gap] = [0, 1, 2].map(|row| -inverse.row(row).transpose());
        Self {
            gap: hit.gap,
            weights: weights.value,
            weights_by_r: std::array::from_fn(|corner| {
                xi * weights.d_xi[corner] + eta * weights.d_eta[corner]
            }),
            gap_by_r: gap,
        }
    }

    /// Adds the derivatives of three rows that depend on `r` to their gradient.
    pub fn spread(&self, by_r: &Matrix3<f64>, lanes: PlaceLanes, gradient: &mut [[f64; 3]]) {
        add_block(gradient, lanes.x, &-by_r);
        add_block(gradient, lanes.n, &(by_r * -self.gap));
        for corner in 0..4 {
            add_block(
                gradient,
                lanes.corners + 3 * corner,
                &(by_r * self.weights[corner]),
            );
        }
    }

    /// `-sum N_J u_J` of the vectors `u_J = R(n, -n_J) v_J` of the corners.
    pub fn sum(&self, turned: &[Transported; 4]) -> Vec3 {
        -(0..4)
            .map(|corner| turned[corner].value * self.weights[corner])
            .sum::<Vec3>()
    }

    /// Adds the derivatives of `rows` times that sum to their gradient, but for those
    /// by `r`, which are returned. Lanes of the `n_J` and `v_J`, twelve each, start at
    /// `normals` and `vectors`, that of `n` at `n`.
    pub fn spread_sum(
        &self,
        rows: &Matrix3<f64>,
        turned: &[Transported; 4],
        [n, normals, vectors]: [usize; 3],
        gradient: &mut [[f64; 3]],
    ) -> Matrix3<f64> {
        let mut by_n = Matrix3::zeros();
        let mut by_r = Matrix3::zeros();
        for (corner, turned) in turned.iter().enumerate() {
            let share = rows * -self.weights[corner];
            by_n += share * turned.by_n;
            by_r -= rows * turned.value * self.weights_by_r[corner].transpose();
            add_block(gradient, normals + 3 * corner, &-(share * turned.by_from));
            add_block(gradient, vectors + 3 * corner, &(share * turned.by_vector));
        }
        add_block(gradient, n, &by_n);
        by_r
    }
}
