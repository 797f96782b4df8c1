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

use std::{convert::Infallible, fmt};

use serde::Serialize;

use super::error::{FrictionError, positive};
use super::monotone::Monotone;
use striae_declared::{Declared, Kind, NO_UNIT, NOT_NEGATIVE, POSITIVE, Parameter, Statement};

/// Dependence of coefficients of friction on the accumulated slip.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
#[serde(transparent)]
pub struct SlipDependence {
    form: Form,
    #[serde(skip)]
    statement: Option<Statement>,
}

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

/// The forms that can be called by their names.
pub static BY_SLIP: &[&Declared<SlipDependence>] = &[&EXPONENTIAL, &TABLE];

static EXPONENTIAL: Declared<SlipDependence> = Declared {
    name: "exponential",
    summary: "Coefficients times `w + (1 - w) exp(-s/s_0)`, as a surface runs in.",
    parameters: &[
        Parameter::number(
            "final_over_initial",
            POSITIVE,
            NO_UNIT,
            "`w`, coefficients after long slip over those at the start, which the law states.",
        ),
        Parameter::number(
            "slip",
            POSITIVE,
            "length",
            "`s_0`, the slip after which the difference has fallen to 1/e.",
        ),
    ],
    build: |values| {
        Ok(SlipDependence::from(Form::Exponential {
            final_over_initial: positive(
                "final_over_initial",
                values.number("final_over_initial"),
            )?,
            slip: positive("slip", values.number("slip"))?,
        }))
    },
    fit: None,
};

static TABLE: Declared<SlipDependence> = Declared {
    name: "table",
    summary: "Coefficients times a factor by the accumulated slip.",
    parameters: &[
        Parameter::numbers(
            "slips",
            NOT_NEGATIVE,
            "length",
            "Accumulated slips, at least two, ascending.",
        ),
        Parameter::numbers(
            "factors",
            POSITIVE,
            NO_UNIT,
            "Factor after each slip: monotone and smooth between them, constant beyond the \
             first and the last.",
        ),
    ],
    build: |values| {
        let names = ["slips", "factors"];
        let [places, factors] = names.map(|name| values.numbers(name));
        let table = Monotone::through(places, factors, names)?;
        Ok(SlipDependence::from(Form::Table(table)))
    },
    fit: None,
};

impl Kind for SlipDependence {
    type Refusal = FrictionError;
    type Fit = Infallible;

    fn with_statement(self, statement: Statement) -> Self {
        let statement = Some(statement);
        Self { statement, ..self }
    }

    fn statement(&self) -> Option<&Statement> {
        self.statement.as_ref()
    }
}

impl From<Form> for SlipDependence {
    fn from(form: Form) -> Self {
        let statement = None;
        Self { form, statement }
    }
}

impl SlipDependence {
    /// Coefficients that come exponentially to `final_over_initial` times those stated; the
    /// difference has fallen to 1/e at the accumulated slip `slip`.
    ///
    /// # Errors
    /// When a constant is not positive.
    pub fn exponential(final_over_initial: f64, slip: f64) -> Result<Self, FrictionError> {
        let values = [("final_over_initial", final_over_initial), ("slip", slip)];
        EXPONENTIAL.made(&values.into())
    }

    /// Coefficients that are those stated times `factors` at accumulated `slips`: a monotone
    /// cubic between them, constant beyond the first and the last.
    ///
    /// # Errors
    /// When there are fewer than two slips or not as many factors, slips do not ascend from zero
    /// or above, or a factor is not positive.
    pub fn table(slips: &[f64], factors: &[f64]) -> Result<Self, FrictionError> {
        let values = [("slips", slips.into()), ("factors", factors.into())];
        TABLE.made(&values.into_iter().collect())
    }

    /// Returns whether there is any.
    pub fn is_some(&self) -> bool {
        self.form != Form::None
    }

    /// Accumulated slip up to which the dependence is visible; `None` if there is none.
    pub fn scale(&self) -> Option<f64> {
        match &self.form {
            Form::None => None,
            Form::Exponential { slip, .. } => Some(5.0 * slip),
            Form::Table(table) => Some(1.1 * table.last()),
        }
    }

    /// Largest coefficient over the stated one.
    pub fn largest_factor(&self) -> f64 {
        match &self.form {
            Form::None => 1.0,
            Form::Exponential {
                final_over_initial, ..
            } => final_over_initial.max(1.0),
            Form::Table(table) => table.points().iter().map(|[_, f]| *f).fold(0.0, f64::max),
        }
    }

    /// `W(s)`.
    pub fn at(&self, slip: f64) -> f64 {
        match &self.form {
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
        match &self.form {
            Form::None => write!(f, "1"),
            Form::Exponential {
                final_over_initial: w,
                slip,
            } => write!(f, "{w} + (1 - {w}) exp(-s/{slip})"),
            Form::Table(table) => write!(f, "{table}"),
        }
    }
}
