//! Hexahedra that bend: an enhanced deformation gradient.
//!
//! To the deformation gradient `F` of the displacements a field with nine inner parameters is
//! added, three covectors `b_I`,
//!
//! ```text
//! t_I = sum_a x_a dN_a/dxi_I(0)                       axes of the element in its middle
//! F_g = F + sum_I s_I t_I (x) b_I,   s_I = xi_I j(0)/j
//! W_e = min_b sum_g w W(F_g)
//! ```
//!
//! with the Jacobian determinant `j`. This is the transposed form of Wilson's modes by Glaser &
//! Armero (Eng. Comput. 14 (1997) 759, doi:10.1108/02644409710188664), an enhanced strain
//! method as Simo & Armero's (Int. J. Numer. Methods Eng. 33 (1992) 1413): `t_I` turns with the
//! element, and as `sum_g w s_I = 0`, both patch tests hold. The form of 1992, `a_I (x) xi_I
//! grad xi_I`, buckles into hourglasses under compression. This one does not: in a box stretched
//! uniformly by .3 to 4 the modes of hourglasses have the least stiffness of the standard element,
//! or a positive one. Like it, it can buckle where a free block of its size would.
//!
//! The parameters are found by Newton's method from zero in every response, to round-off, so that
//! nothing has to be remembered. With
//! `B = F_g,b`, which is `s_I t_I` in the row of a covector, and the modified gradients
//! `G'_a = G_a + sum_I s_I dN_a/dxi_I(0) b_I`
//!
//! ```text
//! f_a  = sum_g w P G'_a,          0 = f_I = sum_g w s_I P^T t_I
//! K    = K_xx - K_xb K_bb^-1 K_bx
//! K_xx = sum_g w G'_a A G'_b,     K_bb = sum_g w s_I s_K t_I A t_K
//! K_xb = sum_g w (G'_a A s_I t_I + P s_I dN_a/dxi_I(0)).
//! ```
//!
//! The condensed stiffness is symmetric to the last bit, as `K_bb = L L^T`. Volumes that can hardly
//! change are taken up better than by the standard element, not as well as with mean dilatation.

use super::{
    ElementError, ElementResponse, Stiffness, actuation::Law, fault::error_at,
    reference::Reference, stiffness::COMPONENTS,
};
use nalgebra::{Matrix3, SMatrix, SVector};
use striae_law::bulk::{Past, Present, Response, Tangent};
use striae_mesh::{CellKind, Vec3};

/// Inner parameters: component `J` of `b_I` is number `3 I + J`.
type Inner = SVector<f64, 9>;
type InnerMatrix = SMatrix<f64, 9, 9>;

/// Most iterations for the inner parameters.
const ITERATIONS: usize = 20;
/// Change of the deformation gradient that is round-off.
const ROUND_OFF: f64 = 1e-13;
/// Change below which the iteration ends as soon as changes grow.
const SMALL: f64 = 1e-8;

/// `s_I` at the quadrature points of an element.
#[derive(Clone, Debug)]
pub(super) struct Fields<const Q: usize>([[f64; 3]; Q]);

/// An element that has found its inner parameters.
struct Settled<const Q: usize> {
    /// `t_I`.
    axes: [Vec3; 3],
    /// `b_I`.
    covectors: [Vec3; 3],
    /// The law at the points.
    laws: Vec<Response>,
    /// `K_bb`.
    inner: InnerMatrix,
    dissipated: [f64; Q],
}

impl<const Q: usize> Fields<Q> {
    /// Modes of a hexahedron with the reference positions `X`.
    pub(super) fn new(corners: &[Vec3]) -> Self {
        let shape = CellKind::Hexahedron.shape();
        let jacobian = |at: [f64; 3]| {
            striae_mesh::quality::jacobian_determinant(CellKind::Hexahedron, corners, at)
        };
        let middle = jacobian([0.0; 3]);
        Self(std::array::from_fn(|g| {
            let at = shape.points[g].0;
            at.map(|xi| xi * middle / jacobian(at))
        }))
    }
}

/// `dN_a/dxi_I` in the middle.
fn arms<const N: usize>() -> [[f64; 3]; N] {
    let corners = CellKind::Hexahedron.shape().corners;
    std::array::from_fn(|a| corners[a].map(|xi| 0.125 * xi))
}

impl<const N: usize, const Q: usize> Reference<N, Q> {
    /// As [`Reference::respond`], with the enhanced gradient.
    ///
    /// # Errors
    ///
    /// [`ElementError::Inverted`] where the material is turned inside out,
    /// [`ElementError::Unsettled`] where no inner parameters are found.
    pub(super) fn respond_enhanced(
        &self,
        fields: &Fields<Q>,
        current: &[Vec3; N],
        law: &Law,
        past: Past,
        element: &mut ElementResponse,
    ) -> Result<(), ElementError> {
        let settled = self.settled(fields, current, |g, f| {
            let mut present = element.present(g, Q);
            let response = law.respond(f, past.of_point(g, Q), &mut present);
            Ok((response.map_err(error_at(g))?, present.dissipated))
        })?;
        (element.energy, element.dissipated) = (0.0, 0.0);
        let modified = self.modified(fields, &settled.covectors);
        let mut stresses = [Matrix3::zeros(); Q];
        let mut tangents = [Tangent::zeros(); Q];
        for (g, law) in settled.laws.iter().enumerate() {
            element.energy += self.weights[g] * law.energy;
            element.dissipated += self.weights[g] * settled.dissipated[g];
            stresses[g] = law.first_piola;
            tangents[g] = law.tangent;
        }
        modified.sum(&stresses, &tangents, element);
        let mixed = modified.mixed(fields, &settled);
        let lower = settled.inner.cholesky().ok_or(ElementError::Unsettled)?;
        let reduced = mixed.map(|of_corner| {
            of_corner.map(|column| {
                let solved = lower.l_dirty().solve_lower_triangular(&column);
                solved.expect("a diagonal without zeros")
            })
        });
        subtract_products(&reduced, &mut element.stiffness);
        Ok(())
    }

    /// Cauchy stress at the quadrature points.
    pub(super) fn enhanced_stress(
        &self,
        fields: &Fields<Q>,
        current: &[Vec3; N],
        law: &Law,
        variables: &[f64],
    ) -> Result<Vec<Matrix3<f64>>, ElementError> {
        let gradients = self.enhanced_gradients(fields, current, law, variables)?;
        let each = variables.len() / Q;
        let stress = |g: usize| {
            let f = gradients[g];
            let variables = &variables[g * each..(g + 1) * each];
            law.cauchy_stress_after(&f, variables).map_err(error_at(g))
        };
        (0..Q).map(stress).collect()
    }

    /// Enhanced deformation gradients of points with given variables.
    pub(super) fn enhanced_gradients(
        &self,
        fields: &Fields<Q>,
        current: &[Vec3; N],
        law: &Law,
        variables: &[f64],
    ) -> Result<[Matrix3<f64>; Q], ElementError> {
        let (elapsed, mut room) = (0.0, vec![0.0; variables.len() / Q]);
        let past = Past { variables, elapsed };
        let settled = self.settled(fields, current, |g, f| {
            let mut present = Present {
                variables: &mut room,
                dissipated: 0.0,
            };
            let response = law.respond(f, past.of_point(g, Q), &mut present);
            Ok((response.map_err(error_at(g))?, 0.0))
        })?;
        let modified = self.modified(fields, &settled.covectors);
        Ok(modified.deformation_gradients(current))
    }

    /// The inner parameters at which the energy is least; `law` answers at a point, with what
    /// is dissipated.
    fn settled(
        &self,
        fields: &Fields<Q>,
        current: &[Vec3; N],
        mut law: impl FnMut(usize, &Matrix3<f64>) -> Result<(Response, f64), ElementError>,
    ) -> Result<Settled<Q>, ElementError> {
        let arms = arms::<N>();
        let axes = [0, 1, 2].map(|i| (0..N).map(|a| current[a] * arms[a][i]).sum::<Vec3>());
        let plain = self.deformation_gradients(current);
        let mut covectors = [Vec3::zeros(); 3];
        let mut before = f64::INFINITY;
        for _ in 0..ITERATIONS {
            let (mut force, mut inner) = (Inner::zeros(), InnerMatrix::zeros());
            let (mut laws, mut dissipated) = (Vec::with_capacity(Q), [0.0; Q]);
            for g in 0..Q {
                let added = [0, 1, 2].map(|i| axes[i] * covectors[i].transpose() * fields.0[g][i]);
                let (response, lost) = law(g, &(plain[g] + added.iter().sum::<Matrix3<f64>>()))?;
                let scaled = [0, 1, 2].map(|i| axes[i] * fields.0[g][i]);
                add(&scaled, self.weights[g], &response, &mut force, &mut inner);
                dissipated[g] = lost;
                laws.push(response);
            }
            let factors = inner.cholesky().ok_or(ElementError::Unsettled)?;
            let step = factors.solve(&force);
            let change = change(&step, &axes);
            if change < ROUND_OFF || change < SMALL && change >= 0.5 * before {
                return Ok(Settled {
                    axes,
                    covectors,
                    laws,
                    inner,
                    dissipated,
                });
            }
            for (at, covector) in covectors.iter_mut().enumerate() {
                *covector -= step.fixed_rows::<3>(3 * at);
            }
            before = change;
        }
        Err(ElementError::Unsettled)
    }

    /// The element with the gradients `G'_a`.
    fn modified(&self, fields: &Fields<Q>, covectors: &[Vec3; 3]) -> Self {
        let arms = arms::<N>();
        let mut modified = self.clone();
        for (gradients, field) in modified.gradients.iter_mut().zip(&fields.0) {
            for (j, of_corners) in gradients.iter_mut().enumerate() {
                for (gradient, arm) in of_corners.iter_mut().zip(&arms) {
                    *gradient += (0..3)
                        .map(|i| field[i] * arm[i] * covectors[i][j])
                        .sum::<f64>();
                }
            }
        }
        modified
    }

    /// `K_bx` by corner and component.
    fn mixed(&self, fields: &Fields<Q>, settled: &Settled<Q>) -> [[Inner; 3]; N] {
        let arms = arms::<N>();
        let mut mixed = [[Inner::zeros(); 3]; N];
        for (g, law) in settled.laws.iter().enumerate() {
            let (field, weight) = (&fields.0[g], self.weights[g]);
            // s_I t_I,i A_iJkL by parameter, k and L.
            let rows: [[f64; 9]; 9] = std::array::from_fn(|parameter| {
                let (i, j) = (parameter / 3, parameter % 3);
                let axis = settled.axes[i] * field[i];
                std::array::from_fn(|kl| {
                    (0..3).map(|c| axis[c] * law.tangent[(3 * c + j, kl)]).sum()
                })
            });
            let [x, y, z] = &self.gradients[g];
            for (a, of_corner) in mixed.iter_mut().enumerate() {
                for (k, column) in of_corner.iter_mut().enumerate() {
                    for (parameter, row) in rows.iter().enumerate() {
                        let (i, j) = (parameter / 3, parameter % 3);
                        let material =
                            row[3 * k] * x[a] + row[3 * k + 1] * y[a] + row[3 * k + 2] * z[a];
                        let stress = law.first_piola[(k, j)] * field[i] * arms[a][i];
                        column[parameter] += weight * (material + stress);
                    }
                }
            }
        }
        mixed
    }
}

/// Adds what a point gives to the force on the inner parameters and to `K_bb`.
fn add(axes: &[Vec3; 3], weight: f64, law: &Response, force: &mut Inner, inner: &mut InnerMatrix) {
    for row in 0..9 {
        let (i, j) = (row / 3, row % 3);
        force[row] += weight * law.first_piola.column(j).dot(&axes[i]);
        // t_I,c A_cJkL by k and L.
        let of_row: [f64; 9] = std::array::from_fn(|kl| {
            (0..3)
                .map(|c| axes[i][c] * law.tangent[(3 * c + j, kl)])
                .sum()
        });
        for column in 0..=row {
            let (k, l) = (column / 3, column % 3);
            let entry: f64 = (0..3).map(|c| of_row[3 * c + l] * axes[k][c]).sum();
            inner[(row, column)] += weight * entry;
        }
        for column in 0..row {
            inner[(column, row)] = inner[(row, column)];
        }
    }
}

/// Largest change of the deformation gradient that a step makes.
fn change(step: &Inner, axes: &[Vec3; 3]) -> f64 {
    let parts = (0..3).map(|i| step.fixed_rows::<3>(3 * i).norm() * axes[i].norm());
    parts.fold(0.0, f64::max)
}

/// Subtracts `Y^T Y`.
fn subtract_products<const N: usize>(y: &[[Inner; 3]; N], stiffness: &mut Stiffness) {
    for ((i, k), block) in COMPONENTS.into_iter().zip(stiffness.blocks_mut::<N>()) {
        for (row, entries) in block.iter_mut().enumerate() {
            for (column, entry) in entries.iter_mut().enumerate() {
                *entry -= y[row][i].dot(&y[column][k]);
            }
        }
    }
}
