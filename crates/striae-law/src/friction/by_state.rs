//! Coefficients of friction that depend on the slip rate and on a state of the surface.
//!
//! Static and kinetic friction with healing is in `by_state/healing.rs`. The
//! friction of Dieterich and Ruina: with the slip rate `v`, a state `theta` in units of time,
//! and the stated coefficient `mu`, that of steady slip at the rate `v_0`,
//!
//! ```text
//! mu(v, theta) = a asinh( v/(2 v_0) exp[(mu + b ln(v_0 theta/D))/a] )
//!              ~ mu + a ln(v/v_0) + b ln(v_0 theta/D)                   a > 0 ,  b >= 0
//!
//! ageing law    d theta/dt = 1 - v theta/D
//! slip law      d theta/dt = -(v theta/D) ln(v theta/D)
//! ```
//!
//! The inverse hyperbolic sine is the regularisation of Rice, Lapusta & Ranjith (2001), which is
//! zero without slip. There is no stick: a surface creeps at any traction, far below strength at
//! rates that are next to none. In steady slip `theta = D/v`.
//!
//! # Increments
//!
//! In an increment of the time `dt` the rate is `v = |du|/dt`, and the state goes along the exact
//! solution for this rate. With `u = v dt/D`
//!
//! ```text
//! ageing law    theta = theta_n exp(-u) + dt (1 - exp(-u))/u
//! slip law      ln theta = exp(-u) ln theta_n + (1 - exp(-u)) ln(D/v)
//! ```
//!
//! so that friction at the end of the increment is a function of `v` alone. It rises with the
//! slip `d = v dt` by the direct effect and falls by the change of state, by at most
//!
//! ```text
//! - d mu/d d <= b c/D ,   c = 1 (ageing) ,   c = 1.1 + max(0, ln(theta_n/dt)) (slip)
//! ```
//!
//! of the ageing law since `-d ln theta/du` is a weighted mean of exponents between 0 and 1, of
//! the slip law since it is `(1 - exp(-u))/u + exp(-u) ln(u theta_n/dt)`. A surface that resists
//! with more than this slope times the pressure has one solution in every increment.
//!
//! All functions are of `x = ln v`, as rates far below strength are smaller than the smallest
//! number of a computer.
//!
//! Sources: Dieterich (1979), "Modeling of rock friction 1", J. Geophys. Res. 84, 2161-2168; Ruina
//! (1983), "Slip instability and state variable friction laws", J. Geophys. Res. 88, 10359-10370;
//! Rice, Lapusta & Ranjith (2001), "Rate and state dependent friction and the stability of sliding
//! between elastically deformable solids", J. Mech. Phys. Solids 49, 1865-1898.

mod healing;

use std::{convert::Infallible, fmt};

use num_dual::DualNum;
use serde::Serialize;

use super::error::{FrictionError, not_negative, positive};
pub use healing::{Healing, HealingCourse};

use striae_declared::{
    Absent, Declared, Kind, NO_UNIT, NOT_NEGATIVE, POSITIVE, Parameter, Statement, Values,
};

/// Dependence of coefficients of friction on slip rate and state.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
#[serde(transparent)]
pub struct StateDependence {
    form: Form,
    #[serde(skip)]
    statement: Option<Statement>,
}

/// Its forms.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
#[serde(untagged)]
enum Form {
    #[default]
    None,
    RateAndState(RateAndState),
    Healing(Healing),
}

/// Constants of friction that depends on rate and state.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct RateAndState {
    /// Law by which the state evolves.
    pub evolution: Evolution,
    /// `a`, the direct effect of the slip rate.
    pub direct_effect: f64,
    /// `b`, the effect of the state.
    pub evolution_effect: f64,
    /// `v_0`, the rate at which the coefficient in steady slip is that stated.
    pub slip_rate: f64,
    /// `D`, the slip over which the state evolves.
    pub slip_distance: f64,
    /// `theta` at the start.
    pub state: f64,
}

/// Law by which the state evolves.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub enum Evolution {
    /// `d theta/dt = 1 - v theta/D`: the state is the age of contact, and grows at rest.
    Ageing,
    /// `d theta/dt = -(v theta/D) ln(v theta/D)`: the state changes with slip only.
    Slip,
}

/// The forms that can be called by their names.
pub static BY_STATE: &[&Declared<StateDependence>] = &[
    &AGEING,
    &SLIP,
    &healing::STATIC_KINETIC,
    &healing::LOGARITHMIC,
];

const PARAMETERS: [Parameter; 5] = [
    Parameter::number(
        "direct_effect",
        POSITIVE,
        NO_UNIT,
        "`a`, by which the largest coefficient rises at once as the slip rate rises by a factor \
         of e.",
    ),
    Parameter::number(
        "evolution_effect",
        NOT_NEGATIVE,
        NO_UNIT,
        "`b`, by which it falls again as the state follows; above `a` for friction that is less \
         in faster steady slip.",
    ),
    Parameter::number(
        "slip_rate",
        POSITIVE,
        "length per time",
        "`v_0`, the rate at which coefficients in steady slip are those that the law states.",
    ),
    Parameter::number(
        "slip_distance",
        POSITIVE,
        "length",
        "`D`, the slip over which the state follows a change of the slip rate.",
    ),
    Parameter::number(
        "state",
        POSITIVE,
        "time",
        "`theta` at the start; by default that of steady slip at `slip_rate`.",
    )
    .or(Absent::Computed("slip_distance/slip_rate", |values| {
        values.number("slip_distance") / values.number("slip_rate")
    })),
];

static AGEING: Declared<StateDependence> = Declared {
    name: "ageing-law",
    summary: "Rate-and-state friction `mu + a ln(v/v_0) + b ln(v_0 theta/D)` with the ageing law \
              `d theta/dt = 1 - v theta/D`: contacts grow stronger at rest.",
    parameters: &PARAMETERS,
    build: |values| built(Evolution::Ageing, values),
    fit: None,
};

static SLIP: Declared<StateDependence> = Declared {
    name: "slip-law",
    summary: "Rate-and-state friction `mu + a ln(v/v_0) + b ln(v_0 theta/D)` with the slip law \
              `d theta/dt = -(v theta/D) ln(v theta/D)`: the state changes with slip only.",
    parameters: &PARAMETERS,
    build: |values| built(Evolution::Slip, values),
    fit: None,
};

fn built(evolution: Evolution, values: &Values) -> Result<StateDependence, FrictionError> {
    let above_zero = |name: &'static str| positive(name, values.number(name));
    Ok(StateDependence {
        form: Form::RateAndState(RateAndState {
            evolution,
            direct_effect: above_zero("direct_effect")?,
            evolution_effect: not_negative("evolution_effect", values.number("evolution_effect"))?,
            slip_rate: above_zero("slip_rate")?,
            slip_distance: above_zero("slip_distance")?,
            state: above_zero("state")?,
        }),
        statement: None,
    })
}

impl Kind for StateDependence {
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

impl From<Healing> for StateDependence {
    fn from(healing: Healing) -> Self {
        Self {
            form: Form::Healing(healing),
            statement: None,
        }
    }
}

impl StateDependence {
    /// Coefficients that fall with slip and heal with these constants.
    ///
    /// # Errors
    /// When a constant is out of range.
    pub fn healing(law: Healing) -> Result<Self, FrictionError> {
        law.made()
    }

    /// Coefficients that depend on rate and state with these constants.
    ///
    /// # Errors
    /// When a constant is not positive, or the effect of the state is negative.
    pub fn rate_and_state(law: RateAndState) -> Result<Self, FrictionError> {
        let values = Values::from([
            ("direct_effect", law.direct_effect),
            ("evolution_effect", law.evolution_effect),
            ("slip_rate", law.slip_rate),
            ("slip_distance", law.slip_distance),
            ("state", law.state),
        ]);
        match law.evolution {
            Evolution::Ageing => AGEING.made(&values),
            Evolution::Slip => SLIP.made(&values),
        }
    }

    /// Returns whether there is any.
    pub fn is_some(&self) -> bool {
        self.form != Form::None
    }

    /// The constants of rate and state, if they are of such friction.
    pub fn constants(&self) -> Option<&RateAndState> {
        match &self.form {
            Form::RateAndState(law) => Some(law),
            Form::None | Form::Healing(_) => None,
        }
    }

    /// The constants of healing, if they are of such friction.
    pub fn of_healing(&self) -> Option<&Healing> {
        match &self.form {
            Form::Healing(law) => Some(law),
            Form::None | Form::RateAndState(_) => None,
        }
    }
}

impl fmt::Display for StateDependence {
    /// The formula of the coefficient with its constants, of healing that of its factor.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let law = match &self.form {
            Form::None => return write!(f, "mu"),
            Form::Healing(law) => return write!(f, "{law}"),
            Form::RateAndState(law) => law,
        };
        let RateAndState {
            direct_effect: a,
            evolution_effect: b,
            slip_rate: v_0,
            slip_distance: d,
            ..
        } = law;
        write!(f, "mu + {a} ln(v/{v_0}) + {b} ln(theta {v_0}/{d}), ")?;
        match law.evolution {
            Evolution::Ageing => write!(f, "d theta/dt = 1 - v theta/{d}"),
            Evolution::Slip => write!(f, "d theta/dt = -(v theta/{d}) ln(v theta/{d})"),
        }
    }
}

/// Slip over `D` below which `(1 - exp(-u))/u` is its series, which is exact to round-off there.
const SHORT: f64 = 1e-5;
/// Slip over `D` after which nothing is left of the state before.
const LONG: f64 = 50.0;

impl RateAndState {
    /// `mu(v, theta)` for the stated coefficient `mu`, a slip rate `v >= 0` and a state.
    pub fn coefficient<D: DualNum<Primitive = f64> + Copy>(
        &self,
        mu: f64,
        slip_rate: D,
        state: D,
    ) -> D {
        match slip_rate.re() > 0.0 {
            true => self.at(mu, slip_rate.ln(), state.ln()),
            false => D::zero(),
        }
    }

    /// `mu(v, D/v)`, the coefficient in steady slip at a rate; at rest the one stated.
    pub fn steady<D: DualNum<Primitive = f64> + Copy>(&self, mu: f64, slip_rate: D) -> D {
        match slip_rate.re() > 0.0 {
            true => self.coefficient(mu, slip_rate, slip_rate.recip() * self.slip_distance),
            false => D::from(mu),
        }
    }

    /// The state after the time `elapsed` at a slip rate `v >= 0`.
    pub fn state_after<D: DualNum<Primitive = f64> + Copy>(
        &self,
        state: f64,
        slip_rate: D,
        elapsed: f64,
    ) -> D {
        if slip_rate.re() > 0.0 && elapsed > 0.0 {
            return self.log_state_after(state, slip_rate.ln(), elapsed).exp();
        }
        match self.evolution {
            Evolution::Ageing => D::from(state + elapsed),
            Evolution::Slip => D::from(state),
        }
    }

    /// `-d mu/d d` over the slip `d` of an increment, at most.
    pub fn largest_weakening(&self, state: f64, elapsed: f64) -> f64 {
        let factor = match self.evolution {
            Evolution::Ageing => 1.0,
            Evolution::Slip => 1.1 + (state / elapsed).ln().max(0.0),
        };
        factor * self.evolution_effect / self.slip_distance
    }

    /// The coefficient at the end of an increment with `x = ln v`.
    pub(super) fn after<D: DualNum<Primitive = f64> + Copy>(
        &self,
        mu: f64,
        log_rate: D,
        state: f64,
        elapsed: f64,
    ) -> D {
        self.at(mu, log_rate, self.log_state_after(state, log_rate, elapsed))
    }

    /// `a asinh(exp(A))` with `A = [mu + b ln(v_0 theta/D)]/a + ln(v/(2 v_0))`.
    fn at<D: DualNum<Primitive = f64> + Copy>(&self, mu: f64, log_rate: D, log_state: D) -> D {
        let aged = log_state + (self.slip_rate / self.slip_distance).ln();
        let exponent = (aged * self.evolution_effect + mu) / self.direct_effect + log_rate
            - (2.0 * self.slip_rate).ln();
        let inverse = match exponent.re() > 0.0 {
            true => exponent + ((exponent * -2.0).exp() + 1.0).sqrt().ln_1p(),
            false => exponent.exp().asinh(),
        };
        inverse * self.direct_effect
    }

    /// `ln theta` at the end of an increment.
    fn log_state_after<D: DualNum<Primitive = f64> + Copy>(
        &self,
        state: f64,
        log_rate: D,
        elapsed: f64,
    ) -> D {
        let steady = -log_rate + self.slip_distance.ln();
        let u = (log_rate + (elapsed / self.slip_distance).ln()).exp();
        if u.re() > LONG {
            return steady;
        }
        let left = (-u).exp();
        match self.evolution {
            Evolution::Ageing => {
                let mean = match u.re() < SHORT {
                    true => u * u / 6.0 - u / 2.0 + 1.0,
                    false => -(-u).exp_m1() / u,
                };
                (left * state + mean * elapsed).ln()
            }
            Evolution::Slip => left * state.ln() - (-u).exp_m1() * steady,
        }
    }
}
