//! Friction laws as sums of parameters times vectors, of which fits find the parameters.
//!
//! With `d = (c, s)`, the cosine and sine of the direction of slip, in the frame of the law,
//! friction over pressure is
//!
//! ```text
//! w(d) = -tau/p = sum_k q_k w_k(d) .
//! ```

use std::f64::consts::TAU;

use nalgebra::{DMatrix, DVector, Vector2};

use striae_declared::Values;

/// Directions of slip in which a law must dissipate.
const DIRECTIONS: usize = 720;

/// Parameters and vectors of a law.
#[derive(Clone, Copy, Debug)]
pub enum Basis {
    /// As many parameters as the law has numbers.
    Sum(Sum),
    /// A coefficient at each angle that was measured, against slip.
    Table {
        /// The parameter of the law with the angles.
        angles: &'static str,
        /// The parameter of the law with the coefficients.
        coefficients: &'static str,
    },
}

/// A sum of parameters times vectors.
#[derive(Clone, Copy, Debug)]
pub struct Sum {
    /// Readings that determine the parameters, to complete "it needs ...".
    pub needed: &'static str,
    /// Relations of the numbers of the law to the parameters, in the order of the law.
    pub constants: &'static [Meaning],
    /// Vectors `w_k` in a direction, for the parameters `q` where they depend on them, of degree
    /// zero, and the words of the law.
    pub vectors: fn(Direction, &[f64], &Values) -> Vec<Vector2<f64>>,
    /// Directions in which the law must dissipate, so that it does in all.
    pub judged: fn() -> Vec<Direction>,
}

/// Relation of a constant to the parameters.
#[derive(Clone, Copy, Debug)]
pub enum Meaning {
    /// One of them.
    Parameter(usize),
    /// The first one over the second one.
    Quotient(usize, usize),
}

/// A direction of slip at an angle between the textures of two surfaces (radians).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Direction {
    /// Angle between the textures; without effect on laws for one.
    pub theta: f64,
    /// Angle of slip from the axis of the law.
    pub slip: f64,
}

impl Meaning {
    /// Returns the constant.
    pub(crate) fn value(self, q: &DVector<f64>) -> f64 {
        match self {
            Self::Parameter(k) => q[k],
            Self::Quotient(k, l) => q[k] / q[l],
        }
    }

    /// Returns its interval, from the covariance of the parameters and Student's `t`.
    ///
    /// Fieller: the `r` for which `|q_k - r q_l|` is at most `t` times its standard deviation.
    pub(crate) fn interval(self, q: &DVector<f64>, covariance: &DMatrix<f64>, t: f64) -> [f64; 2] {
        let (k, l) = match self {
            Self::Parameter(k) => {
                let half = t * covariance[(k, k)].sqrt();
                return [q[k] - half, q[k] + half];
            }
            Self::Quotient(k, l) => (k, l),
        };
        let form = |i: usize, j: usize| q[i] * q[j] - t * t * covariance[(i, j)];
        let (square, middle, constant) = (form(l, l), form(k, l), form(k, k));
        if square <= 0.0 {
            return [f64::NEG_INFINITY, f64::INFINITY];
        }
        let root = (middle * middle - square * constant).max(0.0).sqrt();
        [(middle - root) / square, (middle + root) / square]
    }
}

impl Direction {
    /// Returns a direction of slip.
    pub fn new(theta: f64, slip: f64) -> Self {
        Self { theta, slip }
    }

    /// Returns directions all around.
    pub fn around(theta: f64) -> impl Iterator<Item = Self> {
        let step = TAU / DIRECTIONS as f64;
        (0..DIRECTIONS).map(move |i| Self::new(theta, i as f64 * step))
    }

    /// Returns the unit vector of slip.
    pub fn d(self) -> Vector2<f64> {
        Vector2::new(self.slip.cos(), self.slip.sin())
    }
}
