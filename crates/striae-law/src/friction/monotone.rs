//! A smooth function through given points, monotone between them and constant beyond.
//!
//! Cubics between points `h_i` apart with the secants `s_i`, as in [`periodic`](super::periodic),
//! with the same slopes at inner points. At the ends the slope is that of the parabola through
//! three points where it keeps the cubic monotone, and else the nearest that does:
//!
//! ```text
//! m_0 = [(2 h_0 + h_1) s_0 - h_0 s_1]/(h_0 + h_1) ,   between 0 and 3 s_0
//! ```
//!
//! The interpolant stays between the smallest and the largest value, and has a continuous
//! derivative except for kinks at the two ends, where the derivative is that of the constant.

use std::fmt;

use num_dual::DualNum;
use serde::Serialize;

use super::error::{FrictionError, finite};

/// A monotone interpolant.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(super) struct Monotone {
    points: Vec<[f64; 2]>,
    /// Slopes at the points.
    slopes: Vec<f64>,
}

impl Monotone {
    /// Through positive values at places that ascend from zero or above; `names` are those of
    /// the places and of the values in faults.
    pub(super) fn through(
        places: &[f64],
        values: &[f64],
        names: [&'static str; 2],
    ) -> Result<Self, FrictionError> {
        check(places, values, names)?;
        let last = places.len() - 1;
        let width = |i: usize| places[i + 1] - places[i];
        let secant = |i: usize| (values[i + 1] - values[i]) / width(i);
        let end = |i: usize, next: usize| {
            if i == next {
                return secant(i);
            }
            let ([h, h_1], [s, s_1]) = ([width(i), width(next)], [secant(i), secant(next)]);
            let slope = ((2.0 * h + h_1) * s - h * s_1) / (h + h_1);
            let [low, high] = [(3.0 * s).min(0.0), (3.0 * s).max(0.0)];
            slope.clamp(low, high)
        };
        let slope = |i: usize| {
            if i == 0 {
                return end(0, 1.min(last - 1));
            }
            if i == last {
                return end(last - 1, last.saturating_sub(2));
            }
            let ([h_0, h], [s_0, s]) = ([width(i - 1), width(i)], [secant(i - 1), secant(i)]);
            if s_0 * s <= 0.0 {
                0.0
            } else {
                3.0 * (h_0 + h) / ((2.0 * h + h_0) / s_0 + (h + 2.0 * h_0) / s)
            }
        };
        Ok(Self {
            slopes: (0..=last).map(slope).collect(),
            points: places.iter().zip(values).map(|(x, f)| [*x, *f]).collect(),
        })
    }

    /// The given points.
    pub(super) fn points(&self) -> &[[f64; 2]] {
        &self.points
    }

    /// The last place.
    pub(super) fn last(&self) -> f64 {
        self.points[self.points.len() - 1][0]
    }

    /// Value at any place.
    pub(super) fn at<D: DualNum<Primitive = f64> + Copy>(&self, x: D) -> D {
        let after = self.points.partition_point(|[place, _]| *place <= x.re());
        if after == 0 || after == self.points.len() {
            return D::from(self.points[after.saturating_sub(1)][1]);
        }
        let ([x_0, f_0], [x_1, f_1]) = (self.points[after - 1], self.points[after]);
        let [m_0, m_1] = [self.slopes[after - 1], self.slopes[after]];
        let h = x_1 - x_0;
        let s = (f_1 - f_0) / h;
        let square = (3.0 * s - 2.0 * m_0 - m_1) / h;
        let cube = (m_0 + m_1 - 2.0 * s) / (h * h);
        let x = x - x_0;
        ((x * cube + square) * x + m_0) * x + f_0
    }
}

impl fmt::Display for Monotone {
    /// Its points, one after the other.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let told = self.points.iter().map(|[x, f]| format!("{f} at {x}"));
        write!(f, "{}", told.collect::<Vec<_>>().join(", "))
    }
}

fn check(places: &[f64], values: &[f64], names: [&'static str; 2]) -> Result<(), FrictionError> {
    let [of_places, of_values] = names;
    if places.len() != values.len() || places.len() < 2 {
        return Err(FrictionError::FactorLengths {
            of_places,
            places: places.len(),
            of_values,
            values: values.len(),
        });
    }
    for (place, value) in places.iter().zip(values) {
        finite(of_places, *place)?;
        super::error::positive(of_values, *value)?;
    }
    super::error::not_negative(of_places, places[0])?;
    match places.windows(2).find(|pair| pair[1] <= pair[0]) {
        Some(pair) => Err(FrictionError::FactorOrder {
            of_places,
            place: pair[1],
            before: pair[0],
        }),
        None => Ok(()),
    }
}
