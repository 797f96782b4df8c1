//! Nodal forces of a load over a whole face, and their derivative.

use super::UNKNOWNS;
use super::integrand::{Tangents, lift, parametric_traction, shape, shape_slopes, tangents};
use crate::model::{LoadKind, Value};
use nalgebra::{U1, U6, Vector3};
use num_dual::DualSVec64;
use striae_mesh::Vec3;

/// External nodal forces on the corners of a face.
#[derive(Clone, Debug, PartialEq)]
pub struct FaceLoad {
    /// Force on the corners.
    pub force: [f64; UNKNOWNS],
    /// Derivative of the force by the corner positions, row by row.
    pub tangent: [f64; UNKNOWNS * UNKNOWNS],
}

/// A load that cannot be evaluated.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum LoadError {
    /// The face has no normal, or is turned by 180 degrees under a follower traction.
    #[error(
        "the load has no direction at Gauss point {gauss_point}: \
         the face is degenerate or turned by 180 degrees"
    )]
    Undirected {
        /// Local number of the Gauss point, `0..4`.
        gauss_point: usize,
    },
    /// A function has no finite value at a point of the face.
    #[error("a function of the load has no finite value at ({:.3e}, {:.3e}, {:.3e})", point.x, point.y, point.z)]
    Undefined {
        /// The point in the reference configuration.
        point: Vec3,
    },
}

/// A scalar with its derivatives by the two current tangents.
type Dual = DualSVec64<6>;

/// Load of the given kind on the face with reference corners `X` and current
/// corners `x`, with its present values (a factor on the load is a factor on
/// the values in its kind).
///
/// # Errors
///
/// As [`LoadError`] says.
pub fn response(
    kind: &LoadKind<Value>,
    reference: &[Vec3; 4],
    current: &[Vec3; 4],
) -> Result<FaceLoad, LoadError> {
    let at = 1.0 / 3f64.sqrt();
    let points = [[-at, -at], [at, -at], [at, at], [-at, at]];
    let mut load = FaceLoad {
        force: [0.0; UNKNOWNS],
        tangent: [0.0; UNKNOWNS * UNKNOWNS],
    };
    for (gauss_point, [xi, eta]) in points.into_iter().enumerate() {
        let slopes = shape_slopes(xi, eta);
        let shape = shape(xi, eta);
        let point = (0..4).map(|a| reference[a] * shape[a]).sum::<Vec3>();
        let kind = kind.at(&point);
        if !kind.is_finite() {
            return Err(LoadError::Undefined { point });
        }
        let reference = tangents(reference, &slopes).map(lift);
        let current = variable(&tangents(current, &slopes));
        let traction =
            parametric_traction(&kind.map(|value| Dual::from(*value)), &reference, &current);
        if !traction.iter().all(is_finite) {
            return Err(LoadError::Undirected { gauss_point });
        }
        load.add(&traction, &shape, &slopes);
    }
    Ok(load)
}

impl FaceLoad {
    /// Adds the share of a Gauss point of weight one.
    fn add(&mut self, traction: &Vector3<Dual>, shape: &[f64; 4], slopes: &[[f64; 2]; 4]) {
        for i in 0..3 {
            let derivative = traction[i].eps.unwrap_generic(U6, U1);
            for a in 0..4 {
                let row = 3 * a + i;
                self.force[row] += shape[a] * traction[i].re;
                for b in 0..4 {
                    for k in 0..3 {
                        self.tangent[UNKNOWNS * row + 3 * b + k] += shape[a]
                            * (derivative[k] * slopes[b][0] + derivative[3 + k] * slopes[b][1]);
                    }
                }
            }
        }
    }
}

/// The current tangents as the variables to differentiate by.
fn variable(tangents: &Tangents<f64>) -> Tangents<Dual> {
    [0, 1].map(|direction| {
        Vector3::from_fn(|k, _| Dual::from_re(tangents[direction][k]).derivative(3 * direction + k))
    })
}

fn is_finite(component: &Dual) -> bool {
    let derivative = component.eps.unwrap_generic(U6, U1);
    component.re.is_finite() && derivative.iter().all(|v| v.is_finite())
}
