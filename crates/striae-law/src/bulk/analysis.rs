//! Response of a material in the standard tests that characterise it.
//!
//! A specimen is stretched by `l` along the first axis, free of stress where it is free to
//! contract:
//!
//! ```text
//! uniaxial     F = diag(l, s, s)    P_22 = P_33 = 0
//! equibiaxial  F = diag(l, l, s)    P_33 = 0
//! planar       F = diag(l, 1, s)    P_33 = 0      (also called pure shear)
//! ```
//!
//! The contraction `s` follows by Newton's method, from the stretch before. With the
//! Kirchhoff stresses `tau_a = l_a P_aa` and the logarithmic strains `e_a = ln l_a`, a state
//! is stable in the sense of Drucker where `d tau . d e > 0` for all changes of stretches,
//! that is, where the symmetric matrix
//!
//! ```text
//! D_ab = d tau_a/d e_b = l_b (d_ab P_aa + l_a A_aabb)
//! ```
//!
//! is positive definite.

use nalgebra::Matrix3;

use super::{LameConstants, Material, Response};

/// A test in which a material is stretched.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mode {
    /// Along one axis, free along the others.
    Uniaxial,
    /// Equally along two axes, free along the third.
    Equibiaxial,
    /// Along one axis, held along the second, free along the third.
    Planar,
}

/// A state of such a test.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TestState {
    /// Stretch `l`.
    pub stretch: f64,
    /// Contraction `s` of the free axes.
    pub contraction: f64,
    /// Nominal stress `P_11`: force per area of the specimen at rest.
    pub nominal: f64,
    /// Least eigenvalue of `D`, a stress; the state is stable where it is positive.
    pub stability: f64,
}

/// Iterations of Newton's method for the contraction.
const ITERATIONS: usize = 50;
/// Stress on the free faces that is zero: round-off of the pressure, over the modulus
/// `|lambda| + 2 G`.
const FREE: f64 = 16.0 * f64::EPSILON;

impl Mode {
    /// All modes.
    pub const ALL: [Self; 3] = [Self::Uniaxial, Self::Equibiaxial, Self::Planar];

    /// The name of the test.
    pub fn name(self) -> &'static str {
        match self {
            Self::Uniaxial => "uniaxial",
            Self::Equibiaxial => "equibiaxial",
            Self::Planar => "planar",
        }
    }

    fn stretches(self, l: f64, s: f64) -> [f64; 3] {
        match self {
            Self::Uniaxial => [l, s, s],
            Self::Equibiaxial => [l, l, s],
            Self::Planar => [l, 1.0, s],
        }
    }

    /// The states at `count` stretches from 1 to `last`, in equal steps of their
    /// logarithm; fewer where the material has no answer beyond.
    pub fn states(self, material: &Material, last: f64, count: usize) -> Vec<TestState> {
        let mut states: Vec<TestState> = Vec::with_capacity(count);
        for step in 0..count {
            let stretch = (last.ln() * step as f64 / (count - 1).max(1) as f64).exp();
            let start = states.last().map_or(1.0, |state| state.contraction);
            match self.state(material, stretch, start) {
                Some(state) => states.push(state),
                None => break,
            }
        }
        states
    }

    /// The state at a stretch, by Newton's method from a contraction nearby.
    fn state(self, material: &Material, stretch: f64, start: f64) -> Option<TestState> {
        let LameConstants { lambda, shear } = material.lame_constants();
        let free = FREE * (lambda.abs() + 2.0 * shear);
        let mut contraction = start;
        for _ in 0..ITERATIONS {
            let stretches = self.stretches(stretch, contraction);
            let f = Matrix3::from_diagonal(&stretches.into());
            let response = material.response(&f).ok()?;
            let residual = response.first_piola[(2, 2)];
            if residual.abs() <= free {
                return Some(TestState {
                    stretch,
                    contraction,
                    nominal: response.first_piola[(0, 0)],
                    stability: stability(&response, stretches),
                });
            }
            let coupled = match self {
                Self::Uniaxial => response.tangent[(8, 4)],
                Self::Equibiaxial | Self::Planar => 0.0,
            };
            let change = -residual / (response.tangent[(8, 8)] + coupled);
            // Half the way to nothing at most, so that the material is not turned inside out.
            contraction += change.max(-0.5 * contraction);
        }
        None
    }
}

/// Least eigenvalue of `D`.
fn stability(response: &Response, stretches: [f64; 3]) -> f64 {
    let d = Matrix3::from_fn(|a, b| {
        let own = if a == b {
            response.first_piola[(a, a)]
        } else {
            0.0
        };
        stretches[b] * (own + stretches[a] * response.tangent[(4 * a, 4 * b)])
    });
    d.symmetric_eigenvalues().min()
}
