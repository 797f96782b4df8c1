//! Coefficients of friction that depend on the accumulated slip.
//!
//! Coefficients are the stated ones times a function `W` of the slip `s >= 0` that a point of the
//! surface has done since the start, as a surface is run in, worn or covered.
//!
//! ```text
//! exponential   W = w + (1 - w) exp(-s/s_0)      w = final over initial coefficient
//! table         monotone and cubic between points, constant beyond
//! ```
//!
//! `s` is that of the last converged configuration, so `W` is a constant within an increment: it
//! adds nothing to the tangent, and friction that falls with slip does not make an increment ill
//! posed. The error is of first order in the size of the increment.
//!
//! Slip dissipates `varpi |du|` times what the law of the directions does, so `W > 0` suffices.

use std::fmt;

use serde::Serialize;

use super::error::{FrictionError, positive};
use super::monotone::Monotone;

/// Dependence of coefficients of friction on the accumulated slip.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct SlipDependence(Form);

/// Its forms.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
enum Form {
    #[default]
    None,
    Exponential {
        final_over_initial: f64,
        slip: f64,
    },
    Table(Monotone),
}

/// The constants of a dependence on the accumulated slip.
#[derive(Clone, Debug, PartialEq)]
pub enum SlipConstants<'a> {
    /// Coefficients do not depend on it.
    None,
    /// `w + (1 - w) exp(-s/s_0)`.
    Exponential {
        /// `w`.
        final_over_initial: f64,
        /// `s_0`.
        slip: f64,
    },
    /// Accumulated slips and factors of a table.
    Table(&'a [[f64; 2]]),
}

impl SlipDependence {
    /// Coefficients that come exponentially to `final_over_initial` times those stated; the
    /// difference has fallen to 1/e at the accumulated slip `slip`.
    ///
    /// # Errors
    /// When a constant is not positive.
    pub fn exponential(final_over_initial: f64, slip: f64) -> Result<Self, FrictionError> {
        Ok(Self(Form::Exponential {
            final_over_initial: positive("final_over_initial", final_over_initial)?,
            slip: positive("slip", slip)?,
        }))
    }

    /// Coefficients that are those stated times `factors` at accumulated `slips`: a monotone
    /// cubic between them, constant beyond the first and the last.
    ///
    /// # Errors
    /// When there are fewer than two slips or not as many factors, slips do not ascend from zero
    /// or above, or a factor is not positive.
    pub fn table(slips: &[f64], factors: &[f64]) -> Result<Self, FrictionError> {
        let table = Monotone::through(slips, factors, ["slips", "factors"])?;
        Ok(Self(Form::Table(table)))
    }

    /// Its constants.
    pub fn constants(&self) -> SlipConstants<'_> {
        match &self.0 {
            Form::None => SlipConstants::None,
            &Form::Exponential {
                final_over_initial,
                slip,
            } => SlipConstants::Exponential {
                final_over_initial,
                slip,
            },
            Form::Table(table) => SlipConstants::Table(table.points()),
        }
    }

    /// Accumulated slip up to which the dependence is visible; `None` if there is none.
    pub fn scale(&self) -> Option<f64> {
        match &self.0 {
            Form::None => None,
            Form::Exponential { slip, .. } => Some(5.0 * slip),
            Form::Table(table) => Some(1.1 * table.last()),
        }
    }

    /// Largest coefficient over the stated one.
    pub fn largest_factor(&self) -> f64 {
        match &self.0 {
            Form::None => 1.0,
            Form::Exponential {
                final_over_initial, ..
            } => final_over_initial.max(1.0),
            Form::Table(table) => table.points().iter().map(|[_, f]| *f).fold(0.0, f64::max),
        }
    }

    /// `W(s)`.
    pub fn at(&self, slip: f64) -> f64 {
        match &self.0 {
            Form::None => 1.0,
            Form::Exponential {
                final_over_initial,
                slip: scale,
            } => final_over_initial + (1.0 - final_over_initial) * (-slip / scale).exp(),
            Form::Table(table) => table.at(slip),
        }
    }
}

impl fmt::Display for SlipDependence {
    /// The formula of `W` with its constants.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.0 {
            Form::None => write!(f, "1"),
            Form::Exponential {
                final_over_initial: w,
                slip,
            } => write!(f, "{w} + (1 - {w}) exp(-s/{slip})"),
            Form::Table(table) => write!(f, "{table}"),
        }
    }
}
