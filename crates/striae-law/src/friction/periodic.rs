//! A smooth function of an angle through given points, monotone between them.
//!
//! Between the angles `phi_i` and `phi_(i+1)`, `h_i` apart, with the secants
//! `s_i = (f_(i+1) - f_i)/h_i`, the function is the cubic with the values `f` and
//! the slopes `m` at both ends,
//!
//! ```text
//! f(phi_i + x) = f_i + m_i x + (3 s_i - 2 m_i - m_(i+1)) x^2/h_i + (m_i + m_(i+1) - 2 s_i) x^3/h_i^2
//! m_i = 0                                                  where s_(i-1) s_i <= 0 ,
//! m_i = 3 (h_(i-1) + h_i)/[(2 h_i + h_(i-1))/s_(i-1) + (h_i + 2 h_(i-1))/s_i]   elsewhere.
//! ```
//!
//! The interpolant has a continuous derivative, also across the seam from the last point to the
//! first one a turn later. `|m| <= 3 min |s|` makes it monotone between the points: it passes
//! through all of them and stays between the smallest and the largest value. For a smooth function
//! sampled at a distance `h` its error is `O(h^2)` next to extremes and smaller elsewhere. Angles
//! are in radians.
//!
//! Source: Fritsch & Carlson (1980), "Monotone piecewise cubic interpolation", SIAM
//! J. Numer. Anal. 17, 238-246, doi:10.1137/0717021, with the slopes of Fritsch &
//! Butland (1984), "A method for constructing local monotone piecewise cubic
//! interpolants", SIAM J. Sci. Stat. Comput. 5, 300-304, doi:10.1137/0905021.

use serde::Serialize;
use std::f64::consts::TAU;

use num_dual::DualNum;

/// A monotone periodic interpolant.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(super) struct Periodic {
    /// One for each point, by angle; the last one ends where the first begins.
    pieces: Vec<Piece>,
}

/// A cubic that begins at a given point.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
struct Piece {
    start: f64,
    /// Of the powers of the angle from `start`.
    coefficients: [f64; 4],
}

impl Periodic {
    /// Through the values at ascending angles that span less than a turn.
    pub(super) fn through(angles: &[f64], values: &[f64]) -> Self {
        let count = angles.len();
        let next = |i: usize| (i + 1) % count;
        let before = |i: usize| (i + count - 1) % count;
        let width = |i: usize| {
            let turn = if next(i) > i { 0.0 } else { TAU };
            angles[next(i)] + turn - angles[i]
        };
        let secant = |i: usize| (values[next(i)] - values[i]) / width(i);
        let slope = |i: usize| {
            let ([h_0, h], [s_0, s]) =
                ([width(before(i)), width(i)], [secant(before(i)), secant(i)]);
            if s_0 * s <= 0.0 {
                0.0
            } else {
                3.0 * (h_0 + h) / ((2.0 * h + h_0) / s_0 + (h + 2.0 * h_0) / s)
            }
        };
        let piece = |i: usize| {
            let (h, s, m, m_1) = (width(i), secant(i), slope(i), slope(next(i)));
            let square = (3.0 * s - 2.0 * m - m_1) / h;
            let cube = (m + m_1 - 2.0 * s) / (h * h);
            Piece {
                start: angles[i],
                coefficients: [values[i], m, square, cube],
            }
        };
        Self {
            pieces: (0..count).map(piece).collect(),
        }
    }

    /// Value at any angle.
    pub(super) fn at<D: DualNum<Primitive = f64> + Copy>(&self, angle: D) -> D {
        let turns = ((angle.re() - self.pieces[0].start) / TAU).floor();
        let angle = angle - turns * TAU;
        let after = self
            .pieces
            .partition_point(|piece| piece.start <= angle.re());
        let piece = &self.pieces[after.saturating_sub(1)];
        let x = angle - piece.start;
        let [constant, linear, square, cube] = piece.coefficients;
        ((x * cube + square) * x + linear) * x + constant
    }

    /// The given points, as angles and values.
    pub(super) fn points(&self) -> impl Iterator<Item = [f64; 2]> {
        self.pieces
            .iter()
            .map(|piece| [piece.start, piece.coefficients[0]])
    }
}
