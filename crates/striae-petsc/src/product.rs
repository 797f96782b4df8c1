//! Products with the sum of all parts.

use crate::{binding::Sum, borders::Borders, error::Error};
use striae_condensed::Tangent;
use striae_solve::team::Team;
use striae_sparse::{LinearOperator, RowSums};

/// The whole matrix, as this rank's part of it.
pub(crate) struct Product<'a> {
    tangent: &'a Tangent,
    borders: &'a mut Borders,
    x: Vec<f64>,
    y: Vec<f64>,
}

/// Backward error of an answer that is at round-off, as on one rank.
const ROUND_OFF: f64 = 1e-12;

/// `b - A x`, and how large it is.
pub(crate) struct Residual {
    /// In own rows.
    pub(crate) values: Vec<f64>,
    /// Componentwise.
    pub(crate) backward_error: f64,
}

impl Residual {
    /// Returns whether a solution suffices: its scaled residual is below the wanted value, or at
    /// round-off, where it cannot become much smaller.
    pub(crate) fn suffices(&self, size: f64, wanted: f64) -> bool {
        size <= wanted || self.backward_error <= ROUND_OFF
    }
}

impl<'a> Product<'a> {
    /// With the borders that the tangent touches.
    pub(crate) fn new(tangent: &'a Tangent, borders: &'a mut Borders) -> Self {
        let count = tangent.unknowns();
        Self {
            tangent,
            borders,
            x: vec![0.0; count],
            y: vec![0.0; count],
        }
    }

    /// `y = A x` for own unknowns and rows.
    pub(crate) fn apply(&mut self, x: &[f64], y: &mut [f64]) -> Result<(), Error> {
        self.borders.spread(x, &mut self.x)?;
        self.tangent.multiply(&self.x, &mut self.y);
        self.borders.collect(&self.y, y, Sum::Added)
    }

    /// `b - A x` with unknowns measured in `units`, see [`LinearOperator::residual`].
    pub(crate) fn residual(
        &mut self,
        team: &dyn Team,
        (x, b): (&[f64], &[f64]),
        units: &[f64],
    ) -> Result<Residual, Error> {
        let sizes = x.iter().zip(units).map(|(x, unit)| x.abs() / unit);
        let mut largest = [sizes.fold(0.0, f64::max)];
        team.largest(&mut largest);
        let mut measure = vec![1.0; self.x.len()];
        self.borders.spread(units, &mut measure)?;
        self.borders.spread(x, &mut self.x)?;
        let sums = self.tangent.row_sums(&self.x, &measure);
        let mut total = |of: fn(&RowSums) -> f64| {
            let part: Vec<f64> = sums.iter().map(of).collect();
            let mut own = vec![0.0; b.len()];
            self.borders.collect(&part, &mut own, Sum::Added)?;
            Ok::<Vec<f64>, Error>(own)
        };
        let products = total(|row| row.product)?;
        let terms = total(|row| row.terms)?;
        let norms = total(|row| row.norm)?;
        let count = [b.len() as f64];
        let mut all = count;
        team.sum(&mut all);
        let round_off = 1000.0 * all[0] * f64::EPSILON;
        let mut backward_error = [0.0];
        let values = (0..b.len()).map(|k| {
            let (residual, size) = (b[k] - products[k], terms[k] + b[k].abs());
            let bound = norms[k] * largest[0];
            let size = match size > round_off * (bound + b[k].abs()) {
                true => size,
                false => terms[k] + bound,
            };
            let error = if residual == 0.0 {
                0.0
            } else {
                residual.abs() / size
            };
            // `f64::max` would drop an error that is not a number.
            if error > backward_error[0] || error.is_nan() {
                backward_error[0] = error;
            }
            residual
        });
        let values = values.collect();
        team.largest(&mut backward_error);
        Ok(Residual {
            values,
            backward_error: backward_error[0],
        })
    }
}

/// Length of a vector that lies on all ranks.
pub(crate) fn norm(team: &dyn Team, own: &[f64]) -> f64 {
    let mut square = [own.iter().map(|v| v * v).sum()];
    team.sum(&mut square);
    square[0].sqrt()
}

/// Multiplies values by factors.
pub(crate) fn scale(values: &mut [f64], factors: &[f64]) {
    values.iter_mut().zip(factors).for_each(|(v, f)| *v *= f);
}

/// Largest magnitude on all ranks; what is not a number wins.
pub(crate) fn largest(team: &dyn Team, own: &[f64]) -> f64 {
    let larger = |m: f64, v: &f64| {
        if m.is_nan() || v.abs() <= m {
            m
        } else {
            v.abs()
        }
    };
    let mut largest = [own.iter().fold(0.0, larger)];
    team.largest(&mut largest);
    largest[0]
}

/// Divides by the largest magnitude, which is returned.
pub(crate) fn normalise(team: &dyn Team, own: &mut [f64]) -> f64 {
    let size = largest(team, own);
    if size > 0.0 {
        own.iter_mut().for_each(|v| *v /= size);
    }
    size
}

/// First place on all ranks whose component is within one per cent of the largest.
pub(crate) fn place(team: &dyn Team, own: &[f64], first: usize) -> usize {
    let size = largest(team, own);
    let found = own.iter().position(|v| v.abs() >= 0.99 * size);
    let mut least = [found.map_or(f64::NEG_INFINITY, |at| -((first + at) as f64))];
    team.largest(&mut least);
    if least[0].is_finite() {
        -least[0] as usize
    } else {
        0
    }
}

/// A number with a magnitude between one half and one and any sign, the same for a place
/// however it is reached.
pub(crate) fn pseudo_random(place: usize) -> f64 {
    // SplitMix64.
    let mut z = (place as u64 + 1).wrapping_mul(0x9E37_79B9_7F4A_7C15);
    z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    z ^= z >> 31;
    let magnitude = 0.5 + 0.5 * (z >> 12) as f64 / (1_u64 << 52) as f64;
    if z & 1 == 0 { magnitude } else { -magnitude }
}

/// Makes vectors orthonormal, one after the other.
pub(crate) fn orthonormalise(team: &dyn Team, vectors: &mut [Vec<f64>]) {
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    for k in 0..vectors.len() {
        let (before, own) = vectors.split_at_mut(k);
        let own = &mut own[0];
        let mut products: Vec<f64> = before.iter().map(|other| dot(other, own)).collect();
        team.sum(&mut products);
        for (other, product) in before.iter().zip(products) {
            own.iter_mut()
                .zip(other)
                .for_each(|(a, b)| *a -= product * b);
        }
        let size = norm(team, own);
        if size > 0.0 {
            own.iter_mut().for_each(|a| *a /= size);
        }
    }
}
