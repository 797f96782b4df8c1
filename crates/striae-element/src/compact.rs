//! The stiffness from compact tangents. With the gradients `h_a = B G_a`, and `m_a = M G_a`
//! where the mean volume is held and adds `B x M + M x B`,
//!
//! ```text
//! K_ab = sum_g w (identity G_a.G_b I + crossed h_b x h_a + direct h_a x h_b
//!                 + h_a x m_b + m_a x h_b),
//! ```
//!
//! so that sums over quadrature points take the place of sums over points and axes.

use super::{
    deformation::Deformation,
    product::{Factors, product, symmetrise},
    reference::{Gradients, Matrices, Reference},
    stiffness::{Blocks, COMPONENTS},
    tangent::Tangents,
};
use striae_law::bulk::CompactTangent;

/// Compact tangents at the quadrature points.
pub(super) struct Compact<const Q: usize> {
    identity: [f64; Q],
    crossed: [f64; Q],
    direct: [f64; Q],
    /// `B`.
    inverse_transposed: Matrices<Q>,
    /// `M`, where there is any.
    mixed: Option<Matrices<Q>>,
}

/// Vectors of corners by component and quadrature point.
type Field<const N: usize, const Q: usize> = [[[f64; N]; Q]; 3];

impl<const Q: usize> Tangents<Q> for Compact<Q> {
    type OfLaw = CompactTangent;

    #[inline(always)]
    fn unknown() -> Self {
        Self {
            identity: [0.0; Q],
            crossed: [0.0; Q],
            direct: [0.0; Q],
            inverse_transposed: [[0.0; Q]; 9],
            mixed: None,
        }
    }

    #[inline(always)]
    fn set(&mut self, point: usize, tangent: &CompactTangent) {
        self.identity[point] = tangent.identity;
        self.crossed[point] = tangent.crossed;
        self.direct[point] = tangent.direct;
        let columns = &tangent.inverse_transposed.data.0;
        for at in 0..9 {
            self.inverse_transposed[at][point] = columns[at % 3][at / 3];
        }
    }

    #[inline(always)]
    fn times_gradients(&self, at: &Deformation<Q>) -> Matrices<Q> {
        let mut products = [[0.0; Q]; 9];
        for row in 0..9 {
            for g in 0..Q {
                let of_b = self.crossed[g] + 3.0 * self.direct[g];
                let of_f = self.identity[g] * at.scales[g];
                let b = self.inverse_transposed[row][g];
                products[row][g] = of_f * at.gradients[row][g] + of_b * b;
            }
        }
        products
    }

    #[inline(always)]
    fn complete(&mut self, at: &Deformation<Q>, w: &Matrices<Q>, excess: &[f64; Q]) {
        for g in 0..Q {
            self.identity[g] *= at.scales[g] * at.scales[g];
            self.crossed[g] -= excess[g];
        }
        self.inverse_transposed = at.inverse_transposed;
        self.mixed = Some(*w);
    }

    #[inline(always)]
    fn stiffness<const N: usize, const E: usize>(
        &self,
        element: &Reference<N, Q>,
        products: impl Fn(usize, usize) -> ([[f64; N]; E], [[f64; N]; E]),
        blocks: Blocks<N>,
    ) {
        let mut fields = Fields::ZERO;
        fields.fill(element, self);
        let identity = self.of_identity(element);
        for ((i, k), block) in COMPONENTS.into_iter().zip(blocks) {
            let (first, second) = products(i, k);
            if i == k {
                fields.diagonal((&first, &second), i, block);
                for (row, sums) in block.iter_mut().zip(&identity) {
                    for b in 0..N {
                        row[b] += sums[b];
                    }
                }
                symmetrise(block);
            } else {
                fields.off_diagonal((&first, &second), (i, k), block);
            }
        }
    }
}

impl<const Q: usize> Compact<Q> {
    /// `sum_g w identity G_a.G_b`.
    #[inline(always)]
    fn of_identity<const N: usize>(&self, element: &Reference<N, Q>) -> [[f64; N]; N] {
        let mut scaled = [[[0.0; N]; 3]; Q];
        for (g, scaled) in scaled.iter_mut().enumerate() {
            let factor = self.identity[g] * element.weights[g];
            for j in 0..3 {
                for b in 0..N {
                    scaled[j][b] = element.gradients[g][j][b] * factor;
                }
            }
        }
        let mut sums = [[0.0; N]; N];
        let parts = [(element.gradients.as_flattened(), scaled.as_flattened())];
        product(parts, &mut sums);
        sums
    }
}

/// Factors that multiply the gradients of the shape functions.
struct Fields<const N: usize, const Q: usize> {
    /// `h`.
    h: Field<N, Q>,
    /// `w crossed h`.
    crossed: Field<N, Q>,
    /// `w (direct h + m)`.
    direct: Field<N, Q>,
    /// `w m`.
    mixed: Field<N, Q>,
    /// Quadrature points, if any tangent has an `M`.
    mixed_points: usize,
}

impl<const N: usize, const Q: usize> Fields<N, Q> {
    const ZERO: Self = Self {
        h: [[[0.0; N]; Q]; 3],
        crossed: [[[0.0; N]; Q]; 3],
        direct: [[[0.0; N]; Q]; 3],
        mixed: [[[0.0; N]; Q]; 3],
        mixed_points: 0,
    };

    // In place, as they are too large to be passed on.
    #[inline(always)]
    fn fill(&mut self, element: &Reference<N, Q>, tangents: &Compact<Q>) {
        for (g, gradients) in element.gradients.iter().enumerate() {
            let weight = element.weights[g];
            let (crossed, direct) = (tangents.crossed[g] * weight, tangents.direct[g] * weight);
            for i in 0..3 {
                let h = transformed(&tangents.inverse_transposed, (i, g), gradients);
                for a in 0..N {
                    self.crossed[i][g][a] = crossed * h[a];
                    self.direct[i][g][a] = direct * h[a];
                }
                self.h[i][g] = h;
            }
        }
        if let Some(mixed) = &tangents.mixed {
            self.mixed_points = Q;
            self.add_mixed(element, mixed);
        }
    }

    #[inline(always)]
    fn add_mixed(&mut self, element: &Reference<N, Q>, mixed: &Matrices<Q>) {
        for (g, gradients) in element.gradients.iter().enumerate() {
            for i in 0..3 {
                let m = transformed(mixed, (i, g), gradients);
                for a in 0..N {
                    self.mixed[i][g][a] = element.weights[g] * m[a];
                    self.direct[i][g][a] += element.weights[g] * m[a];
                }
            }
        }
    }

    /// The block of the components `i`, `i` but for the identity, with what has to be made
    /// symmetric.
    #[inline(always)]
    fn diagonal(&self, products: Factors<N>, i: usize, block: &mut [[f64; N]; N]) {
        let mut right = [[0.0; N]; Q];
        for (g, right) in right.iter_mut().enumerate() {
            for b in 0..N {
                right[b] = self.direct[i][g][b] + self.crossed[i][g][b] + self.mixed[i][g][b];
            }
        }
        product([(&self.h[i], &right), products], block);
    }

    /// The block of the components `i < k`.
    #[inline(always)]
    fn off_diagonal(
        &self,
        products: Factors<N>,
        (i, k): (usize, usize),
        block: &mut [[f64; N]; N],
    ) {
        let points = self.mixed_points;
        let parts = [
            (&self.h[i][..], &self.direct[k][..]),
            (&self.h[k], &self.crossed[i]),
            (&self.mixed[i][..points], &self.h[k][..points]),
            products,
        ];
        product(parts, block);
    }
}

/// The row `i` of the matrix at point `g` times the gradients.
#[inline(always)]
fn transformed<const N: usize, const Q: usize>(
    matrices: &Matrices<Q>,
    (i, g): (usize, usize),
    [x, y, z]: &Gradients<N>,
) -> [f64; N] {
    let [m_x, m_y, m_z] = [
        matrices[3 * i][g],
        matrices[3 * i + 1][g],
        matrices[3 * i + 2][g],
    ];
    let mut sums = [0.0; N];
    for a in 0..N {
        sums[a] = m_x * x[a] + m_y * y[a] + m_z * z[a];
    }
    sums
}
