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

    /// At a place with these interpolation functions, whose change is another matter.
    pub fn at(weights: [f64; 4]) -> Self {
        Self {
            gap: 0.0,
            weights,
            weights_by_r: [Vec3::zeros(); 4],
            gap_by_r: Vec3::zeros(),
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

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{DMatrix, DVector};
    use striae_mesh::FacetId;
    use striae_verify::assert_derivative;

    const SHAPE: Shape = Shape::Quadrilateral;
    const LANES: PlaceLanes = PlaceLanes {
        x: 0,
        n: 3,
        corners: 6,
    };

    fn vector(u: &DVector<f64>, lane: usize) -> Vec3 {
        Vec3::new(u[lane], u[lane + 1], u[lane + 2])
    }

    fn four(u: &DVector<f64>, lane: usize) -> [Vec3; 4] {
        [0, 3, 6, 9].map(|offset| vector(u, lane + offset))
    }

    /// The projection by Newton's method, and the vectors turned there.
    fn at(u: &DVector<f64>) -> (Opposing, [Transported; 4]) {
        let (x, n, corners) = (vector(u, 0), vector(u, 3), four(u, 6));
        let [normals, vectors] = [18, 30].map(|lane| four(u, lane));
        let mut root = Vec3::zeros();
        for _ in 0..20 {
            let weights = SHAPE.weights(root.x, root.y);
            let [by_xi, by_eta] = [&weights.d_xi, &weights.d_eta].map(|w| combination(w, &corners));
            let residual = combination(&weights.value, &corners) - x - n * root.z;
            let jacobian = Matrix3::from_columns(&[by_xi, by_eta, -n]);
            root -= jacobian.try_inverse().unwrap() * residual;
        }
        let hit = Hit {
            facet: FacetId::new(0),
            xi: root.x,
            eta: root.y,
            gap: root.z,
        };
        let turned = std::array::from_fn(|c| Transported::new(&vectors[c], &-normals[c], &n));
        (Opposing::new(SHAPE, &hit, &n, &corners), turned)
    }

    fn scene() -> DVector<f64> {
        let mut u = DVector::from_fn(42, |lane, _| 0.1 * (1.7 * lane as f64).sin());
        u[2] += 0.2;
        u[5] -= 1.0;
        let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
        for (corner, [x, y]) in corners.into_iter().enumerate() {
            u[6 + 3 * corner] += x;
            u[7 + 3 * corner] += y;
            u[20 + 3 * corner] += 1.0;
        }
        u
    }

    fn dense(gradient: &[[f64; 3]; 42]) -> DMatrix<f64> {
        DMatrix::from_fn(3, 42, |row, lane| gradient[lane][row])
    }

    #[test]
    fn gap_and_weights_change_with_all_that_the_projection_sees() {
        let values = |u: &DVector<f64>| {
            let (opposing, _) = at(u);
            DVector::from_vec(vec![opposing.gap, opposing.weights[0], opposing.weights[2]])
        };
        let jacobian = |u: &DVector<f64>| {
            let (opposing, _) = at(u);
            let mut gradient = [[0.0; 3]; 42];
            let [first, third] = [0, 2].map(|c: usize| opposing.weights_by_r[c]);
            let rows = [opposing.gap_by_r, first, third].map(|row| row.transpose());
            opposing.spread(&Matrix3::from_rows(&rows), LANES, &mut gradient);
            dense(&gradient)
        };
        assert_derivative(values, jacobian, &scene());
    }

    #[test]
    fn the_sum_changes_with_all_that_it_is_made_of() {
        let rows = Matrix3::new(0.3, -0.2, 0.9, 0.1, 0.8, 0.4, -0.7, 0.2, 0.5);
        let sum = |u: &DVector<f64>| {
            let (opposing, turned) = at(u);
            let sum = rows * opposing.sum(&turned);
            DVector::from_column_slice(sum.as_slice())
        };
        let jacobian = |u: &DVector<f64>| {
            let (opposing, turned) = at(u);
            let mut gradient = [[0.0; 3]; 42];
            let by_r = opposing.spread_sum(&rows, &turned, [3, 18, 30], &mut gradient);
            opposing.spread(&by_r, LANES, &mut gradient);
            dense(&gradient)
        };
        assert_derivative(sum, jacobian, &scene());
    }
}
