//! Stored energy, internal force and consistent stiffness of an element.

use super::{
    ElementError, Stiffness,
    reference::{Gradients, Reference},
    stiffness::COMPONENTS,
};
use nalgebra::Matrix3;
use pulp::{Arch, Simd, WithSimd};
use striae_law::bulk::{Material, Past, Present, ResponseError, Tangent};
use striae_mesh::Vec3;

/// Energy of an element with its first and second derivatives.
#[derive(Clone, Debug, PartialEq)]
pub struct ElementResponse {
    /// Stored energy.
    pub energy: f64,
    /// Internal force on every corner, the derivative of the energy by its position.
    pub force: Vec<[f64; 3]>,
    /// Derivative of the force, symmetric to the last bit.
    pub stiffness: Stiffness,
    /// Energy that has been dissipated since the last converged state.
    pub dissipated: f64,
    /// What the quadrature points have come to, one after the other.
    pub variables: Vec<f64>,
}

impl ElementResponse {
    /// Where one of `count` points writes what it has come to.
    pub(super) fn present(&mut self, point: usize, count: usize) -> Present<'_> {
        let each = self.variables.len() / count;
        Present {
            variables: &mut self.variables[point * each..(point + 1) * each],
            dissipated: 0.0,
        }
    }
}

impl<const N: usize, const Q: usize> Reference<N, Q> {
    /// Response to current corner positions `x`, written over an older one.
    ///
    /// # Errors
    ///
    /// [`ElementError::Inverted`] where the material is turned inside out.
    pub(super) fn respond(
        &self,
        current: &[Vec3; N],
        material: &Material,
        past: Past,
        element: &mut ElementResponse,
    ) -> Result<(), ElementError> {
        (element.energy, element.dissipated) = (0.0, 0.0);
        let mut force = [[0.0; 3]; N];
        let mut tangents = [Tangent::zeros(); Q];
        for g in 0..Q {
            let f = self.deformation_gradient(g, current);
            let mut present = element.present(g, Q);
            let response = material.respond(&f, past.of_point(g, Q), &mut present);
            let dissipated = present.dissipated;
            let response = response.map_err(error_at(g))?;
            element.energy += self.weights[g] * response.energy;
            element.dissipated += self.weights[g] * dissipated;
            self.add_force(g, &response.first_piola, &mut force);
            tangents[g] = response.tangent;
        }
        element.force.copy_from_slice(&force);
        self.sum(&tangents, &mut element.stiffness);
        Ok(())
    }

    /// `f_ai += w P_iJ G_a,J` at quadrature point `g`.
    pub(super) fn add_force(
        &self,
        g: usize,
        first_piola: &Matrix3<f64>,
        force: &mut [[f64; 3]; N],
    ) {
        let [x, y, z] = &self.gradients[g];
        let stress = first_piola * self.weights[g];
        for a in 0..N {
            for i in 0..3 {
                force[a][i] +=
                    stress[(i, 0)] * x[a] + stress[(i, 1)] * y[a] + stress[(i, 2)] * z[a];
            }
        }
    }

    /// The stiffness from the tangents at the quadrature points.
    pub(super) fn sum(&self, tangents: &[Tangent; Q], stiffness: &mut Stiffness) {
        Arch::new().dispatch(Sum {
            element: self,
            tangents,
            stiffness,
        });
    }
}

/// The stiffness from the tangents, by as many lanes as the processor has: they are filled
/// with corners, so that sums do not depend on their number.
struct Sum<'a, const N: usize, const Q: usize> {
    element: &'a Reference<N, Q>,
    tangents: &'a [Tangent; Q],
    stiffness: &'a mut Stiffness,
}

impl<const N: usize, const Q: usize> WithSimd for Sum<'_, N, Q> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        stiffness(self.element, self.tangents, |_, _| ([], []), self.stiffness);
    }
}

/// The stiffness from the tangents, and of `E` products of vectors of corners, of which the two
/// factors of each are given for components `i` and `k`.
#[inline(always)]
pub(super) fn stiffness<const N: usize, const Q: usize, const E: usize>(
    element: &Reference<N, Q>,
    tangents: &[Tangent; Q],
    products: impl Fn(usize, usize) -> ([[f64; N]; E], [[f64; N]; E]),
    stiffness: &mut Stiffness,
) {
    let gradients = element.gradients.as_flattened();
    for ((i, k), block) in COMPONENTS.into_iter().zip(stiffness.blocks_mut::<N>()) {
        let right = right(element, tangents, i, k);
        let (first, second) = products(i, k);
        let parts = [(gradients, right.as_flattened()), (&first, &second)];
        // Some rows at a time in registers: as many as divide the corners.
        match N {
            4 | 8 => product::<N, N, 4, 2>(parts, block),
            6 => product::<N, N, 3, 2>(parts, block),
            10 => product::<N, N, 5, 2>(parts, block),
            _ => product::<N, N, 1, 2>(parts, block),
        }
        if i == k {
            mirror(block);
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

/// Factors `L` and `R` of a product, by what is summed over.
type Factors<'a, const M: usize, const N: usize> = (&'a [[f64; M]], &'a [[f64; N]]);

/// `K_ab = sum_c L_ca R_cb` over all `c` of some parts, a product of tall and wide matrices,
/// `ROWS` rows at a time.
#[inline(always)]
pub(super) fn product<const M: usize, const N: usize, const ROWS: usize, const PARTS: usize>(
    parts: [Factors<M, N>; PARTS],
    block: &mut [[f64; N]; M],
) {
    for (first, rows) in (0..M).step_by(ROWS).zip(block.chunks_exact_mut(ROWS)) {
        let mut sums = [[0.0; N]; ROWS];
        for (left, right) in parts {
            for (left, right) in left.iter().zip(right) {
                for a in 0..ROWS {
                    for b in 0..N {
                        sums[a][b] += left[first + a] * right[b];
                    }
                }
            }
        }
        rows.copy_from_slice(&sums);
    }
}

/// Makes a block symmetric to the last bit.
#[inline(always)]
fn mirror<const N: usize>(block: &mut [[f64; N]; N]) {
    for a in 0..N {
        for b in 0..a {
            block[b][a] = block[a][b];
        }
    }
}

/// The error of the material as an error of the element at quadrature point `g`.
pub(super) fn error_at(g: usize) -> impl Fn(ResponseError) -> ElementError {
    move |error| match error {
        ResponseError::Inverted { determinant } => ElementError::Inverted {
            point: g,
            determinant,
        },
        ResponseError::Overstretched { strain, limit } => ElementError::Overstretched {
            point: g,
            strain,
            limit,
        },
        ResponseError::OverstretchedFibres { strain, limit } => ElementError::OverstretchedFibres {
            point: g,
            strain,
            limit,
        },
    }
}
