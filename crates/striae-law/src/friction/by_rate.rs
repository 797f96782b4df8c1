//! Coefficients of friction that depend on the slip rate.
//!
//! Longer than other files, as each form declares its parameters.
//!
//! Coefficients are the stated ones times a function `R` of the slip rate `v >= 0`.
//!
//! ```text
//! decay         R = c + (1 - c) exp(-(v/v_s)^d) + k v     c = mu_k/mu_s ,  d >= 1 ,  k >= 0
//! logarithm     R = 1 + a ln(1 + v/v_0)                   constant beyond a limit, if there is one
//! table         monotone and cubic between points, constant beyond
//! ```
//!
//! The first is the decay of Oden & Martins (1985) for `d = 1`, `k = 0`, and with `d` and `k` the
//! curve of Stribeck in the form of Armstrong-Hélouvry, Dupont & Canudas de Wit (1994). The
//! second is the steady state of friction that depends on rate and state, Ruina (1983), with
//! `a = (A - B)/mu`, regularised at rest.
//!
//! # Admissible functions
//!
//! Slip dissipates `varpi |v|` times what the law of the directions does, so `R > 0` suffices,
//! or zero in endless slip. All slopes `R'` are finite: `d >= 1`, and a logarithm that falls must
//! have a limit, before which it stays positive.
//!
//! If friction falls with the rate, an increment can have several solutions, or Newton's method go
//! backwards from rest. [`weakest_rate`](RateDependence::weakest_rate) is the rate at which
//! friction has fallen most; the contact rows begin there.
//!
//! Sources: Oden & Martins (1985), "Models and computational methods for dynamic friction
//! phenomena", Comput. Methods Appl. Mech. Engrg. 52, 527-634; Armstrong-Hélouvry, Dupont &
//! Canudas de Wit (1994), "A survey of models, analysis tools and compensation methods for the
//! control of machines with friction", Automatica 30, 1083-1138; Ruina (1983), "Slip instability
//! and state variable friction laws", J. Geophys. Res. 88, 10359-10370.

use std::{convert::Infallible, fmt};

use num_dual::DualNum;
use serde::Serialize;

use super::error::{FrictionError, finite, not_negative, positive, within};
use super::monotone::Monotone;
use striae_declared::{
    ANY, Absent, Bound, Declared, Kind, NO_UNIT, NOT_NEGATIVE, POSITIVE, Parameter, Statement,
    Values,
};

/// Dependence of coefficients of friction on the slip rate.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
#[serde(transparent)]
pub struct RateDependence {
    form: Form,
    #[serde(skip)]
    statement: Option<Statement>,
}

/// Its forms.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
enum Form {
    #[default]
    None,
    Decay(Decay),
    Logarithm(Logarithm),
    Table(Monotone),
}

/// `c + (1 - c) exp(-(v/v_s)^d) + k v`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Decay {
    /// `c`: kinetic over static coefficient.
    pub kinetic_over_static: f64,
    /// `v_s`.
    pub slip_rate: f64,
    /// `d`.
    pub exponent: f64,
    /// `k`, time per length.
    pub viscous: f64,
}

/// `1 + a ln(1 + v/v_0)`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Logarithm {
    /// `a`.
    pub factor: f64,
    /// `v_0`.
    pub slip_rate: f64,
    /// The rate beyond which the coefficients are constant.
    pub limit: Option<f64>,
}

/// The forms that can be called by their names.
pub static BY_RATE: &[&Declared<RateDependence>] = &[&STRIBECK, &LOGARITHM, &TABLE];

/// The decay from rest to fast slip, which decks state in a table of its own.
pub static DECAY: Declared<RateDependence> = Declared {
    name: "decay",
    summary: "Decay of friction from rest to fast slip, \
              `kinetic + (static - kinetic) exp(-rate/slip_rate)`.",
    parameters: &[
        Parameter::number(
            "kinetic_over_static",
            NOT_NEGATIVE,
            NO_UNIT,
            "Coefficients in fast slip over those at rest, which the law states.",
        ),
        Parameter::number(
            "slip_rate",
            POSITIVE,
            "length per time",
            "Rate of slip at which the difference has fallen to 1/e.",
        ),
    ],
    build: |values| {
        RateDependence::decaying(Decay {
            kinetic_over_static: values.number("kinetic_over_static"),
            slip_rate: values.number("slip_rate"),
            exponent: 1.0,
            viscous: 0.0,
        })
    },
    fit: None,
};

static STRIBECK: Declared<RateDependence> = Declared {
    name: "stribeck",
    summary: "Coefficients times `c + (1 - c) exp(-(v/v_s)^d) + k v`, Stribeck's curve.",
    parameters: &[
        Parameter::number(
            "kinetic_over_static",
            NOT_NEGATIVE,
            NO_UNIT,
            "`c`, coefficients in fast slip without the viscous part over those at rest, which \
             the law states.",
        ),
        Parameter::number("slip_rate", POSITIVE, "length per time", "`v_s`."),
        Parameter::number("exponent", &[Bound::AtLeast(1.0)], NO_UNIT, "`d`.")
            .or(Absent::Number(2.0)),
        Parameter::number(
            "viscous",
            NOT_NEGATIVE,
            "time per length",
            "`k`, the viscous part over the coefficients at rest.",
        )
        .or(Absent::Number(0.0)),
    ],
    build: |values| {
        RateDependence::decaying(Decay {
            kinetic_over_static: values.number("kinetic_over_static"),
            slip_rate: values.number("slip_rate"),
            exponent: values.number("exponent"),
            viscous: values.number("viscous"),
        })
    },
    fit: None,
};

static LOGARITHM: Declared<RateDependence> = Declared {
    name: "logarithm",
    summary: "Coefficients times `1 + a ln(1 + v/v_0)`.",
    parameters: &[
        Parameter::number(
            "factor",
            ANY,
            NO_UNIT,
            "`a`: positive for friction that rises with the slip rate, negative for friction \
             that falls.",
        ),
        Parameter::number("slip_rate", POSITIVE, "length per time", "`v_0`."),
        Parameter::number(
            "limit",
            POSITIVE,
            "length per time",
            "Slip rate from which on the coefficients are constant; needed where they fall.",
        )
        .or(Absent::Nothing),
    ],
    build: |values| {
        let law = Logarithm {
            factor: finite("factor", values.number("factor"))?,
            slip_rate: positive("slip_rate", values.number("slip_rate"))?,
            limit: values.number_if_any("limit"),
        };
        if let Some(limit) = law.limit {
            positive("limit", limit)?;
        }
        let last = law.limit.map(|limit| law.at(limit));
        if law.factor < 0.0 && !last.is_some_and(|last| last > 0.0) {
            return Err(FrictionError::LogarithmVanishes {
                factor: law.factor,
                rate: law.slip_rate * (-1.0 / law.factor).exp_m1(),
            });
        }
        Ok(RateDependence::from(Form::Logarithm(law)))
    },
    fit: None,
};

static TABLE: Declared<RateDependence> = Declared {
    name: "table",
    summary: "Coefficients times a factor by the slip rate.",
    parameters: &[
        Parameter::numbers(
            "slip_rates",
            NOT_NEGATIVE,
            "length per time",
            "Slip rates, at least two, ascending.",
        ),
        Parameter::numbers(
            "factors",
            POSITIVE,
            NO_UNIT,
            "Factor at each slip rate: monotone and smooth between them, constant beyond the \
             first and the last.",
        ),
    ],
    build: |values| {
        let names = ["slip_rates", "factors"];
        let [places, factors] = names.map(|name| values.numbers(name));
        let table = Monotone::through(places, factors, names)?;
        Ok(RateDependence::from(Form::Table(table)))
    },
    fit: None,
};

impl Kind for RateDependence {
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

impl From<Form> for RateDependence {
    fn from(form: Form) -> Self {
        let statement = None;
        Self { form, statement }
    }
}

impl RateDependence {
    /// Coefficients that decay from those at rest.
    ///
    /// # Errors
    /// When a constant is out of range.
    pub fn decay(decay: Decay) -> Result<Self, FrictionError> {
        let values = [
            ("kinetic_over_static", decay.kinetic_over_static),
            ("slip_rate", decay.slip_rate),
            ("exponent", decay.exponent),
            ("viscous", decay.viscous),
        ];
        STRIBECK.made(&values.into())
    }

    fn decaying(decay: Decay) -> Result<Self, FrictionError> {
        not_negative("kinetic_over_static", decay.kinetic_over_static)?;
        positive("slip_rate", decay.slip_rate)?;
        let steep = decay.exponent >= 1.0;
        within("exponent", decay.exponent, "at least 1, and finite", steep)?;
        not_negative("viscous", decay.viscous)?;
        Ok(Self::from(Form::Decay(decay)))
    }

    /// Coefficients that go with the logarithm of the rate.
    ///
    /// # Errors
    /// When a constant is out of range, or coefficients fall without a limit or to zero before
    /// it.
    pub fn logarithm(law: Logarithm) -> Result<Self, FrictionError> {
        let values = Values::from([("factor", law.factor), ("slip_rate", law.slip_rate)]);
        LOGARITHM.made(&values.with_any("limit", law.limit))
    }

    /// Coefficients that are those stated times `factors` at `rates`: a monotone cubic between
    /// them, constant beyond the first and the last.
    ///
    /// # Errors
    /// When there are fewer than two rates or not as many factors, rates do not ascend from zero
    /// or above, or a factor is not positive.
    pub fn table(rates: &[f64], factors: &[f64]) -> Result<Self, FrictionError> {
        let values = [("slip_rates", rates.into()), ("factors", factors.into())];
        TABLE.made(&values.into_iter().collect())
    }

    /// Returns whether there is any.
    pub fn is_some(&self) -> bool {
        self.form != Form::None
    }

    /// Rate up to which the dependence is visible; `None` if there is none.
    pub fn scale(&self) -> Option<f64> {
        match &self.form {
            Form::None => None,
            Form::Decay(decay) => Some(5.0 * decay.slip_rate),
            Form::Logarithm(law) => Some(law.limit.map_or(100.0 * law.slip_rate, |v| 1.1 * v)),
            Form::Table(table) => Some(1.1 * table.last()),
        }
    }

    /// The rate at which friction has fallen most, `None` where it falls nowhere.
    pub fn weakest_rate(&self) -> Option<f64> {
        match &self.form {
            Form::None => None,
            Form::Decay(decay) => decay.weakest_rate(),
            Form::Logarithm(law) => law.limit.filter(|_| law.factor < 0.0),
            Form::Table(table) => {
                let points = table.points();
                let falls = points.windows(2).position(|pair| pair[1][1] < pair[0][1])?;
                let after = points[falls..].iter();
                after
                    .min_by(|one, other| one[1].total_cmp(&other[1]))
                    .map(|[rate, _]| *rate)
            }
        }
    }

    /// Largest coefficient over that at rest.
    pub fn largest_over_rest(&self) -> f64 {
        match &self.form {
            Form::None => 1.0,
            Form::Decay(decay) if decay.viscous > 0.0 => f64::INFINITY,
            Form::Decay(decay) => decay.kinetic_over_static.max(1.0),
            Form::Logarithm(law) if law.factor > 0.0 => {
                law.limit.map_or(f64::INFINITY, |limit| law.at(limit))
            }
            Form::Logarithm(_) => 1.0,
            Form::Table(table) => {
                let factors = table.points().iter().map(|[_, factor]| *factor);
                factors.fold(0.0, f64::max) / table.points()[0][1]
            }
        }
    }

    /// The coefficient at a rate, of the stated one `mu`.
    pub(super) fn of<D: DualNum<Primitive = f64> + Copy>(&self, mu: f64, rate: D) -> D {
        let mu_s = D::from(mu);
        match &self.form {
            Form::None => mu_s,
            Form::Decay(decay) => decay.of(mu_s, rate),
            Form::Logarithm(law) => mu_s * law.at(rate),
            Form::Table(table) => mu_s * table.at(rate),
        }
    }
}

impl fmt::Display for RateDependence {
    /// The formula of `R` with its constants.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.form {
            Form::None => write!(f, "1"),
            Form::Decay(decay) => {
                let Decay {
                    kinetic_over_static: c,
                    slip_rate,
                    exponent,
                    viscous,
                } = decay;
                write!(f, "{c} + (1 - {c}) exp(-")?;
                match *exponent == 1.0 {
                    true => write!(f, "v/{slip_rate})")?,
                    false => write!(f, "(v/{slip_rate})^{exponent})")?,
                }
                match *viscous > 0.0 {
                    true => write!(f, " + {viscous} v"),
                    false => Ok(()),
                }
            }
            Form::Logarithm(law) => {
                let (sign, size) = (if law.factor < 0.0 { '-' } else { '+' }, law.factor.abs());
                write!(f, "1 {sign} {size} ln(1 + v/{})", law.slip_rate)?;
                match law.limit {
                    Some(limit) => write!(f, ", constant from v = {limit} on"),
                    None => Ok(()),
                }
            }
            Form::Table(table) => write!(f, "{table}"),
        }
    }
}

impl Decay {
    fn of<D: DualNum<Primitive = f64> + Copy>(&self, mu_s: D, rate: D) -> D {
        let mu_k = mu_s * self.kinetic_over_static;
        let x = rate / self.slip_rate;
        let power = if self.exponent == 1.0 {
            x
        } else if x.re() > 0.0 && x.re().is_finite() {
            (x.ln() * self.exponent).exp()
        } else {
            D::from(x.re())
        };
        let decayed = mu_k + (mu_s - mu_k) * (-power).exp();
        match self.viscous > 0.0 {
            true => decayed + mu_s * rate * self.viscous,
            false => decayed,
        }
    }

    /// Rate at which `(1 - c) g(u) = k v_s` with `g(u) = d u^(d-1) exp(-u^d)` beyond its largest
    /// value, which is at `u^d = (d - 1)/d`.
    fn weakest_rate(&self) -> Option<f64> {
        let (fall, d) = (1.0 - self.kinetic_over_static, self.exponent);
        let rise = self.viscous * self.slip_rate;
        let excess = |u: f64| {
            let power = u.powf(d);
            fall * d * u.powf(d - 1.0) * (-power).exp() - rise
        };
        let mut low = ((d - 1.0) / d).powf(1.0 / d);
        if excess(low) <= 0.0 {
            return None;
        }
        if rise == 0.0 {
            return Some(f64::INFINITY);
        }
        let mut high = 2.0 * low.max(1.0);
        while excess(high) > 0.0 {
            high *= 2.0;
        }
        for _ in 0..100 {
            let middle = 0.5 * (low + high);
            match excess(middle) > 0.0 {
                true => low = middle,
                false => high = middle,
            }
        }
        Some(high * self.slip_rate)
    }
}

impl Logarithm {
    fn at<D: DualNum<Primitive = f64> + Copy>(&self, rate: D) -> D {
        let rate = match self.limit {
            Some(limit) if rate.re() > limit => D::from(limit),
            _ => rate,
        };
        (rate / self.slip_rate).ln_1p() * self.factor + 1.0
    }
}
