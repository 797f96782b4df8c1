//! Static and kinetic friction with healing: coefficients that fall with slip and rise at rest.
//!
//! Coefficients are the stated ones times a factor `H` of a state that slip renews and time heals.
//!
//! ```text
//! static-kinetic        H = c + (1 - c) psi ,          d psi/dt = (1 - psi)/T - psi v/D
//! logarithmic-healing   H = 1 + f ln(1 + theta/T) ,    d theta/dt = 1 - theta v/D
//! ```
//!
//! Of the first, `psi` from 0 to 1 is the share of junctions that have formed: they form in the
//! time `T` and break over the slip `D`, so that friction falls exponentially with slip from the
//! static coefficient, stated, to `c` times it, and comes back exponentially at rest; in steady
//! slip `psi = 1/(1 + v T/D)`. Of the second, `theta` is the age of contact, which grows with the
//! time at rest; friction above the kinetic coefficient, stated, goes with its logarithm, and in
//! steady slip `theta = D/v`.
//!
//! # Increments
//!
//! Over an increment of the time `dt` at the rate `v` the states follow exactly. With `u = v dt/D`
//! and `h = dt/T`
//!
//! ```text
//! psi   = psi_n exp(-(h + u)) + h [1 - exp(-(h + u))]/(h + u)
//! theta = theta_n exp(-u) + dt [1 - exp(-u)]/u
//! ```
//!
//! Both are means of `exp(-u s)` over `0 <= s <= 1` with positive weights, for `psi` of a sum of at
//! most 1. So friction is a convex function of the slip `d = v dt`, which falls by at most
//!
//! ```text
//! -dH/dd <= (1 - c)/D  (static-kinetic) ,   f/D  (logarithmic-healing) ,
//! ```
//!
//! and an increment of any length has one solution where the surroundings resist with more than
//! this times `mu p` per area. All functions are smooth at rest; there is a threshold below which
//! nodes stick.
//!
//! Sources: population of junctions by Schallamach (1963), "A theory of dynamic rubber friction",
//! Wear 6, 375-382; an exponentially healing state that slip renews by Ampuero & Ben-Zion (2008),
//! "Cracks, pulses and macroscopic asymmetry of dynamic rupture on a bimaterial interface with
//! velocity-weakening friction", Geophys. J. Int. 173, 674-692; `ln(1 + t/T)` by Dieterich (1972),
//! "Time-dependent friction in rocks", J. Geophys. Res. 77, 3690-3697; the age by Ruina (1983),
//! "Slip instability and state variable friction laws", J. Geophys. Res. 88, 10359-10370.

use std::fmt;

use num_dual::DualNum;
use serde::Serialize;

use super::StateDependence;
use crate::friction::{
    error::{FactorFailure, FrictionError, not_negative, positive, within},
    factor::{
        Course, Factor, FactorBatch, FactorLane, FactorLaw, FactorPoint, FactorPoints, FactorRange,
        PointWise,
    },
};
use striae_declared::{
    Absent, Bound, Declared, NO_UNIT, NOT_NEGATIVE, POSITIVE, Parameter, Values,
};

/// Constants of friction that heals.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Healing {
    /// Course of healing.
    pub course: HealingCourse,
    /// `D`, the slip over which friction falls to 1/e.
    pub slip_distance: f64,
    /// `T`, the time of healing.
    pub healing_time: f64,
    /// State at the start: `psi`, or `theta`.
    pub state: f64,
}

/// Course of healing with time.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub enum HealingCourse {
    /// Exponential, to a static coefficient.
    Exponential {
        /// `c`.
        kinetic_over_static: f64,
    },
    /// Logarithmic, without a limit.
    Logarithmic {
        /// `f`.
        factor: f64,
    },
}

/// Slip over `D` below which `(1 - exp(-u))/u` is its series, which is exact to round-off there.
const SHORT: f64 = 1e-5;
/// Slip over `D` after which nothing is left of the state before.
const FAR: f64 = 1e3;

pub(super) static STATIC_KINETIC: Declared<StateDependence> = Declared {
    name: "static-kinetic",
    summary: "Coefficients times `c + (1 - c) psi`, `d psi/dt = (1 - psi)/T - psi v/D`: friction \
              falls with slip from static to kinetic and heals exponentially at rest.",
    parameters: &[
        Parameter::number(
            "kinetic_over_static",
            &[Bound::AtLeast(0.0), Bound::AtMost(1.0)],
            NO_UNIT,
            "`c`, coefficients after long slip without healing over those healed, which the law \
             states.",
        ),
        SLIP_DISTANCE,
        Parameter::number(
            "healing_time",
            POSITIVE,
            "time",
            "`T`, after which the difference has fallen to 1/e at rest.",
        ),
        Parameter::number(
            "state",
            &[Bound::AtLeast(0.0), Bound::AtMost(1.0)],
            NO_UNIT,
            "`psi` at the start, from 0 for kinetic to 1 for healed.",
        )
        .or(Absent::Number(1.0)),
    ],
    build: |values| {
        let share = |name: &'static str| {
            let value = values.number(name);
            within(name, value, "from 0 to 1", (0.0..=1.0).contains(&value))
        };
        let kinetic_over_static = share("kinetic_over_static")?;
        let course = HealingCourse::Exponential {
            kinetic_over_static,
        };
        built(course, share("state")?, values)
    },
    fit: None,
};

pub(super) static LOGARITHMIC: Declared<StateDependence> = Declared {
    name: "logarithmic-healing",
    summary: "Coefficients times `1 + f ln(1 + theta/T)`, `d theta/dt = 1 - theta v/D`: friction \
              falls with slip to kinetic and heals with the logarithm of the time at rest.",
    parameters: &[
        Parameter::number(
            "factor",
            NOT_NEGATIVE,
            NO_UNIT,
            "`f`, by which coefficients rise over the kinetic ones, which the law states, as the \
             time at rest grows by a factor of e.",
        ),
        SLIP_DISTANCE,
        Parameter::number(
            "healing_time",
            POSITIVE,
            "time",
            "`T`, the time at rest from which on friction goes with the logarithm.",
        ),
        Parameter::number(
            "state",
            NOT_NEGATIVE,
            "time",
            "`theta` at the start, the time that surfaces have been at rest.",
        )
        .or(Absent::Number(0.0)),
    ],
    build: |values| {
        let factor = not_negative("factor", values.number("factor"))?;
        let state = not_negative("state", values.number("state"))?;
        built(HealingCourse::Logarithmic { factor }, state, values)
    },
    fit: None,
};

const SLIP_DISTANCE: Parameter = Parameter::number(
    "slip_distance",
    POSITIVE,
    "length",
    "`D`, the slip over which what has healed falls to 1/e.",
);

fn built(
    course: HealingCourse,
    state: f64,
    values: &Values,
) -> Result<StateDependence, FrictionError> {
    Ok(StateDependence::from(Healing {
        course,
        slip_distance: positive("slip_distance", values.number("slip_distance"))?,
        healing_time: positive("healing_time", values.number("healing_time"))?,
        state,
    }))
}

impl Healing {
    /// Returns the dependence with these constants.
    pub(super) fn made(&self) -> Result<StateDependence, FrictionError> {
        let values = |name: &'static str, value: f64| {
            Values::from([
                (name, value),
                ("slip_distance", self.slip_distance),
                ("healing_time", self.healing_time),
                ("state", self.state),
            ])
        };
        match self.course {
            HealingCourse::Exponential {
                kinetic_over_static,
            } => STATIC_KINETIC.made(&values("kinetic_over_static", kinetic_over_static)),
            HealingCourse::Logarithmic { factor } => LOGARITHMIC.made(&values("factor", factor)),
        }
    }

    /// `H` of a state.
    pub fn factor<D: DualNum<Primitive = f64> + Copy>(&self, state: D) -> D {
        match self.course {
            HealingCourse::Exponential {
                kinetic_over_static: c,
            } => state * (1.0 - c) + c,
            HealingCourse::Logarithmic { factor } => {
                (state / self.healing_time).ln_1p() * factor + 1.0
            }
        }
    }

    /// State after the time `elapsed` at a slip rate `v >= 0`.
    pub fn state_after<D: DualNum<Primitive = f64> + Copy>(
        &self,
        state: f64,
        slip_rate: D,
        elapsed: f64,
    ) -> D {
        let u = slip_rate * (elapsed / self.slip_distance);
        match self.course {
            HealingCourse::Exponential { .. } => {
                let h = elapsed / self.healing_time;
                let whole = u + h;
                (-whole).exp() * state + mean(whole) * h
            }
            HealingCourse::Logarithmic { .. } => (-u).exp() * state + mean(u) * elapsed,
        }
    }

    /// State in steady slip; at rest, for logarithmic healing, that of no healing.
    pub fn steady_state<D: DualNum<Primitive = f64> + Copy>(&self, slip_rate: D) -> D {
        let renewed = slip_rate / self.slip_distance;
        match self.course {
            HealingCourse::Exponential { .. } => (renewed * self.healing_time + 1.0).recip(),
            HealingCourse::Logarithmic { .. } if slip_rate.re() == 0.0 => D::zero(),
            HealingCourse::Logarithmic { .. } => renewed.recip(),
        }
    }

    /// `-dH/dd` over the slip `d` of an increment, at most.
    pub fn largest_weakening(&self) -> f64 {
        let fall = match self.course {
            HealingCourse::Exponential {
                kinetic_over_static: c,
            } => 1.0 - c,
            HealingCourse::Logarithmic { factor } => factor,
        };
        fall / self.slip_distance
    }

    /// Course with the slip rate.
    pub(in crate::friction) fn by_rate(&self) -> Course {
        let falls = self.largest_weakening() > 0.0;
        Course {
            goes_with_rate: falls,
            falls,
            largest_over_rest: 1.0,
            steepest: self.largest_weakening(),
        }
    }
}

/// `(1 - exp(-u))/u`.
fn mean<D: DualNum<Primitive = f64> + Copy>(u: D) -> D {
    match u.re() < SHORT {
        true => u * u / 6.0 - u / 2.0 + 1.0,
        false => -(-u).exp_m1() / u,
    }
}

impl FactorLaw for Healing {
    fn name(&self) -> &str {
        match self.course {
            HealingCourse::Exponential { .. } => STATIC_KINETIC.name,
            HealingCourse::Logarithmic { .. } => LOGARITHMIC.name,
        }
    }

    fn range(&self) -> FactorRange {
        FactorRange {
            slip_rate: 10.0 * self.slip_distance / self.healing_time,
            time: self.healing_time,
            elapsed: self.healing_time,
            ..FactorRange::default()
        }
    }

    fn initial_state(&self) -> Vec<f64> {
        vec![self.state]
    }

    fn state_after(&self, at: &FactorPoint, before: &[f64]) -> Vec<FactorLane> {
        vec![self.state_after(before[0], at.slip_rate, at.elapsed)]
    }

    fn factor(&self, _: &FactorPoint, state: &[FactorLane]) -> FactorLane {
        self.factor(state[0])
    }
}

impl FactorBatch for Healing {
    fn name(&self) -> &str {
        FactorLaw::name(self)
    }

    fn range(&self) -> FactorRange {
        FactorLaw::range(self)
    }

    fn initial_state(&self) -> Vec<f64> {
        FactorLaw::initial_state(self)
    }

    fn factors(&self, points: &FactorPoints) -> Result<Vec<Factor>, FactorFailure> {
        PointWise(*self).factors(points)
    }

    fn states_after(&self, points: &FactorPoints) -> Result<Vec<f64>, FactorFailure> {
        PointWise(*self).states_after(points)
    }

    fn fast(&self, elapsed: f64) -> f64 {
        match elapsed > 0.0 {
            true => FAR * self.slip_distance / elapsed,
            false => 0.0,
        }
    }
}

impl fmt::Display for Healing {
    /// The formula of `H` with its constants.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (d, t) = (self.slip_distance, self.healing_time);
        match self.course {
            HealingCourse::Exponential {
                kinetic_over_static: c,
            } => write!(
                f,
                "{c} + (1 - {c}) psi, d psi/dt = (1 - psi)/{t} - psi v/{d}"
            ),
            HealingCourse::Logarithmic { factor } => write!(
                f,
                "1 + {factor} ln(1 + theta/{t}), d theta/dt = 1 - theta v/{d}"
            ),
        }
    }
}
