//! Stiffness of elements from the tangents at their quadrature points.

use super::{
    deformation::Deformation,
    product::{mirror, product},
    reference::{Gradients, Matrices, Reference},
    stiffness::{Blocks, COMPONENTS},
};
use striae_law::bulk::Tangent;

/// Tangents at the quadrature points of an element, in one form or another.
pub(super) trait Tangents<const Q: usize> {
    /// Tangent returned by a law.
    type OfLaw;

    /// Tangents that are not known yet.
    fn unknown() -> Self;

    /// Takes over the answer of the law at a point.
    fn set(&mut self, point: usize, tangent: &Self::OfLaw);

    /// `A : Fbar`, where they were taken at `Fbar`.
    fn times_gradients(&self, at: &Deformation<Q>) -> Matrices<Q>;

    /// Makes of them the tangents for the mean volume held,
    /// `alpha^2 A + H x W + W x H - e H_iL H_kJ`.
    fn complete(&mut self, at: &Deformation<Q>, w: &Matrices<Q>, excess: &[f64; Q]);

    /// Writes the blocks of the stiffness from the tangents, and of `E` products of vectors of
    /// corners, of which the two factors of each are given for components `i` and `k`.
    fn stiffness<const N: usize, const E: usize>(
        &self,
        element: &Reference<N, Q>,
        products: impl Fn(usize, usize) -> ([[f64; N]; E], [[f64; N]; E]),
        blocks: Blocks<N>,
    );
}

/// Tangents by all components.
impl<const Q: usize> Tangents<Q> for [Tangent; Q] {
    type OfLaw = Tangent;

    fn unknown() -> Self {
        [Tangent::zeros(); Q]
    }

    #[inline(always)]
    fn set(&mut self, point: usize, tangent: &Tangent) {
        self[point] = *tangent;
    }

    #[inline(always)]
    fn times_gradients(&self, at: &Deformation<Q>) -> Matrices<Q> {
        let mut products = [[0.0; Q]; 9];
        for (g, tangent) in self.iter().enumerate() {
            let mut sums = [0.0; 9];
            for (column, by) in tangent.data.0.iter().zip(&at.gradients) {
                for row in 0..9 {
                    sums[row] += column[row] * by[g];
                }
            }
            for row in 0..9 {
                products[row][g] = sums[row] * at.scales[g];
            }
        }
        products
    }

    #[inline(always)]
    fn complete(&mut self, at: &Deformation<Q>, w: &Matrices<Q>, excess: &[f64; Q]) {
        for (g, tangent) in self.iter_mut().enumerate() {
            let square = at.scales[g] * at.scales[g];
            let (mut h, mut of_w) = ([0.0; 9], [0.0; 9]);
            for row in 0..9 {
                (h[row], of_w[row]) = (at.inverse_transposed[row][g], w[row][g]);
            }
            // Of the blocks those with `i <= k` and what shares their lanes, as the stiffness
            // needs no others.
            let columns = &mut tangent.data.0;
            column_block::<4>(columns, 0, square, &h, &of_w, excess[g]);
            column_block::<8>(columns, 1, square, &h, &of_w, excess[g]);
            column_block::<9>(columns, 2, square, &h, &of_w, excess[g]);
        }
    }

    #[inline(always)]
    fn stiffness<const N: usize, const E: usize>(
        &self,
        element: &Reference<N, Q>,
        products: impl Fn(usize, usize) -> ([[f64; N]; E], [[f64; N]; E]),
        blocks: Blocks<N>,
    ) {
        let gradients = element.gradients.as_flattened();
        for ((i, k), block) in COMPONENTS.into_iter().zip(blocks) {
            let right = right(element, self, i, k);
            let (first, second) = products(i, k);
            let parts = [(gradients, right.as_flattened()), (&first, &second)];
            product(parts, block);
            if i == k {
                mirror(block);
            }
        }
    }
}

/// `sum_L w A_iJkL G_b,L` for two components `i`, `k` by quadrature point, `J` and corner.
#[inline(always)]
fn right<const N: usize, const Q: usize>(
    element: &Reference<N, Q>,
    tangents: &[Tangent; Q],
    i: usize,
    k: usize,
) -> [Gradients<N>; Q] {
    let mut right = [[[0.0; N]; 3]; Q];
    for g in 0..Q {
        let ([x, y, z], weight) = (&element.gradients[g], element.weights[g]);
        for j in 0..3 {
            let [t_x, t_y, t_z] =
                [0, 1, 2].map(|l| tangents[g].data.0[3 * k + l][3 * i + j] * weight);
            for b in 0..N {
                right[g][j][b] = t_x * x[b] + t_y * y[b] + t_z * z[b];
            }
        }
    }
    right
}

/// Completes the first rows of the columns `3 k + L`.
#[inline(always)]
fn column_block<const ROWS: usize>(
    tangent: &mut [[f64; 9]; 9],
    k: usize,
    square: f64,
    h: &[f64; 9],
    w: &[f64; 9],
    excess: f64,
) {
    let along: [f64; ROWS] = std::array::from_fn(|row| excess * h[3 * k + row % 3]);
    for l in 0..3 {
        let (of_h, of_w, column) = (h[3 * k + l], w[3 * k + l], &mut tangent[3 * k + l]);
        let across: [f64; ROWS] = std::array::from_fn(|row| h[3 * (row / 3) + l]);
        for row in 0..ROWS {
            let mixed = h[row] * of_w + w[row] * of_h;
            column[row] = column[row] * square + mixed - along[row] * across[row];
        }
    }
}
