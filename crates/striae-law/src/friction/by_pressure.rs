//! Coefficients of friction that depend on the pressure.
//!
//! The bound on friction is `varpi = mu P(p)` with a function `P` that has the unit of pressure
//! and is `p` for a constant coefficient; the coefficient is `mu P(p)/p`.
//!
//! ```text
//! power law     P = p0 (p/p0)^m                     mu at the pressure p0
//! adhesion      P = p + p_ad                        mu for p >> p_ad (Derjaguin)
//! saturation    P = (tau/mu) tanh(mu p/tau)         mu for p -> 0, varpi below tau
//! table         P = f(p) p                          f monotone and cubic between points
//! ```
//!
//! # Pressures near zero
//!
//! A power law with `m < 1` has an infinite slope at `p = 0`, and with adhesion `P` jumps there
//! from the zero of an open contact. The increment is not well posed with either: the slip row of
//! a node that closes has the slope `varpi'`. So below a floor `p_f` friction is the parabola that
//! leaves zero and continues `P` with its value and slope,
//!
//! ```text
//! P = (2 V - S p_f) x + (S p_f - V) x^2 ,   x = p/p_f ,   V = P(p_f) ,   S = P'(p_f) .
//! ```
//!
//! As `S p_f <= V` in both, `P` is concave there, ascends, and its largest slope is
//! `(2 V - S p_f)/p_f`: of a power law `(2 - m) (p_f/p0)^(m-1)`, with adhesion
//! `1 + 2 p_ad/p_f`.
//!
//! # Admissible functions
//!
//! Slip dissipates `varpi` times what the law of the directions does, so `P > 0` for `p > 0`
//! suffices; all slopes `P'` are finite. Only a table can let friction fall as the pressure rises;
//! [`falling`](PressureDependence::falling) finds where.
//!
//! Sources: power law by Archard (1957), "Elastic deformation and the laws of friction", Proc. R.
//! Soc. Lond. A 243, 190-205, `m = 2/3` for a single elastic contact; the offset by Derjaguin
//! (1934), "Molekulartheorie der äußeren Reibung", Z. Phys. 88, 661-675.

use std::{convert::Infallible, fmt};

use num_dual::{Dual64, DualNum};
use serde::Serialize;

use super::error::{FrictionError, positive};
use super::monotone::Monotone;
use striae_declared::{
    Absent, Declared, Kind, NO_UNIT, NOT_NEGATIVE, POSITIVE, Parameter, Statement, Values,
};

/// Dependence of coefficients of friction on the pressure.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
#[serde(transparent)]
pub struct PressureDependence {
    form: Form,
    #[serde(skip)]
    statement: Option<Statement>,
}

/// Its forms.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
enum Form {
    #[default]
    None,
    PowerLaw {
        exponent: f64,
        pressure: f64,
        floor: f64,
    },
    Adhesion {
        pressure: f64,
        floor: f64,
    },
    Saturation {
        shear_stress: f64,
    },
    Table(Monotone),
}

/// Floor of a power law over its reference pressure, where none is given.
pub const FLOOR_OF_POWER_LAW: f64 = 1e-3;
/// Floor of adhesion over its pressure, where none is given.
pub const FLOOR_OF_ADHESION: f64 = 0.05;

/// Number of points of an interval of a table at which its slope is checked.
const SAMPLES: u32 = 64;

/// Pressure over that of a power law below which there is no friction: with `m > 1` it has
/// vanished long before.
const VANISHING: f64 = 1e-90;

/// The forms that can be called by their names.
pub static BY_PRESSURE: &[&Declared<PressureDependence>] =
    &[&POWER_LAW, &ADHESION, &SATURATION, &TABLE];

static POWER_LAW: Declared<PressureDependence> = Declared {
    name: "power-law",
    summary: "Friction `mu p0 (p/p0)^m`, coefficients `mu (p/p0)^(m - 1)`.",
    parameters: &[
        Parameter::number(
            "exponent",
            POSITIVE,
            NO_UNIT,
            "`m`, below 1 for coefficients that fall with the pressure; 2/3 for one elastic \
             contact.",
        ),
        Parameter::number(
            "pressure",
            POSITIVE,
            "force per area",
            "`p0`, the pressure at which the coefficients are those that the law states.",
        ),
        Parameter::number(
            "floor",
            POSITIVE,
            "force per area",
            "Pressure below which, for `m` below 1, friction goes to zero along a parabola, with \
             a finite slope.",
        )
        .or(Absent::Computed("p0/1000", |values| {
            FLOOR_OF_POWER_LAW * values.number("pressure")
        })),
    ],
    build: |values| {
        Ok(PressureDependence::from(Form::PowerLaw {
            pressure: positive("pressure", values.number("pressure"))?,
            exponent: positive("exponent", values.number("exponent"))?,
            floor: positive("floor", values.number("floor"))?,
        }))
    },
    fit: None,
};

static ADHESION: Declared<PressureDependence> = Declared {
    name: "adhesion",
    summary: "Friction `mu (p + p_ad)` with a pressure by adhesion, Derjaguin's law.",
    parameters: &[
        Parameter::number("pressure", POSITIVE, "force per area", "`p_ad`."),
        Parameter::number(
            "floor",
            POSITIVE,
            "force per area",
            "Pressure below which friction goes to zero along a parabola, with a finite slope.",
        )
        .or(Absent::Computed("p_ad/20", |values| {
            FLOOR_OF_ADHESION * values.number("pressure")
        })),
    ],
    build: |values| {
        Ok(PressureDependence::from(Form::Adhesion {
            pressure: positive("pressure", values.number("pressure"))?,
            floor: positive("floor", values.number("floor"))?,
        }))
    },
    fit: None,
};

static SATURATION: Declared<PressureDependence> = Declared {
    name: "saturation",
    summary: "Friction `tau tanh(mu p/tau)`, which comes smoothly to a shear stress.",
    parameters: &[Parameter::number(
        "shear_stress",
        POSITIVE,
        "force per area",
        "`tau`. The coefficients that the law states are those of low pressures.",
    )],
    build: |values| {
        Ok(PressureDependence::from(Form::Saturation {
            shear_stress: positive("shear_stress", values.number("shear_stress"))?,
        }))
    },
    fit: None,
};

static TABLE: Declared<PressureDependence> = Declared {
    name: "table",
    summary: "Coefficients times a factor by the pressure.",
    parameters: &[
        Parameter::numbers(
            "pressures",
            NOT_NEGATIVE,
            "force per area",
            "Pressures, at least two, ascending.",
        ),
        Parameter::numbers(
            "factors",
            POSITIVE,
            NO_UNIT,
            "Factor at each pressure: monotone and smooth between them, constant beyond the \
             first and the last.",
        ),
    ],
    build: |values| {
        let names = ["pressures", "factors"];
        let [places, factors] = names.map(|name| values.numbers(name));
        let table = Monotone::through(places, factors, names)?;
        Ok(PressureDependence::from(Form::Table(table)))
    },
    fit: None,
};

impl Kind for PressureDependence {
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

impl From<Form> for PressureDependence {
    fn from(form: Form) -> Self {
        let statement = None;
        Self { form, statement }
    }
}

impl PressureDependence {
    /// Coefficients that are the stated ones at the pressure `p0` and vary with `(p/p0)^(m-1)`;
    /// below `floor`, by default [`FLOOR_OF_POWER_LAW`] times `p0`, as the module describes.
    ///
    /// # Errors
    /// When a constant is not positive.
    pub fn power_law(
        exponent: f64,
        pressure: f64,
        floor: Option<f64>,
    ) -> Result<Self, FrictionError> {
        let values = Values::from([("exponent", exponent), ("pressure", pressure)]);
        POWER_LAW.made(&values.with_any("floor", floor))
    }

    /// Friction that adhesion adds to, `varpi = mu (p + p_ad)`; below `floor`, by default
    /// [`FLOOR_OF_ADHESION`] times `p_ad`, as the module describes.
    ///
    /// # Errors
    /// When a constant is not positive.
    pub fn adhesion(pressure: f64, floor: Option<f64>) -> Result<Self, FrictionError> {
        ADHESION.made(&Values::from([("pressure", pressure)]).with_any("floor", floor))
    }

    /// Friction that approaches the shear stress `tau` smoothly, `varpi = tau tanh(mu p/tau)` at
    /// rest.
    ///
    /// # Errors
    /// When the shear stress is not positive.
    pub fn saturation(shear_stress: f64) -> Result<Self, FrictionError> {
        SATURATION.made(&[("shear_stress", shear_stress)].into())
    }

    /// Coefficients that are those stated times `factors` at `pressures`: a monotone cubic
    /// between them, constant beyond the first and the last.
    ///
    /// # Errors
    /// When there are fewer than two pressures or not as many factors, pressures do not ascend
    /// from zero or above, or a factor is not positive.
    pub fn table(pressures: &[f64], factors: &[f64]) -> Result<Self, FrictionError> {
        let values = [("pressures", pressures.into()), ("factors", factors.into())];
        TABLE.made(&values.into_iter().collect())
    }

    /// Returns whether there is any.
    pub fn is_some(&self) -> bool {
        self.form != Form::None
    }

    /// Largest coefficient over the stated one.
    pub fn largest_factor(&self) -> f64 {
        match &self.form {
            Form::None | Form::Saturation { .. } => 1.0,
            Form::PowerLaw { exponent, .. } if *exponent > 1.0 => f64::INFINITY,
            Form::PowerLaw {
                exponent,
                pressure,
                floor,
            } => (2.0 - exponent) * (floor / pressure).powf(exponent - 1.0),
            Form::Adhesion { pressure, floor } => 1.0 + 2.0 * pressure / floor,
            Form::Table(table) => table.points().iter().map(|[_, f]| *f).fold(0.0, f64::max),
        }
    }

    /// Pressure up to which the dependence is visible; `None` if there is none.
    pub fn scale(&self) -> Option<f64> {
        match &self.form {
            Form::None => None,
            Form::PowerLaw { pressure, .. } => Some(3.0 * pressure),
            Form::Adhesion { pressure, .. } => Some(10.0 * pressure),
            Form::Saturation { shear_stress } => Some(10.0 * shear_stress),
            Form::Table(table) => Some(1.1 * table.last()),
        }
    }

    /// Pressures between which friction falls as the pressure rises, `P' < 0`, if it does
    /// anywhere: those of the first interval of a table.
    pub fn falling(&self) -> Option<[f64; 2]> {
        let Form::Table(table) = &self.form else {
            return None;
        };
        let points = table.points().windows(2);
        points
            .map(|pair| [pair[0][0], pair[1][0]])
            .find(|[from, to]| {
                (0..SAMPLES).any(|i| {
                    let p = from + (to - from) * f64::from(i) / f64::from(SAMPLES);
                    let p = Dual64::from(p).derivative();
                    (table.at(p) * p).eps < 0.0
                })
            })
    }

    /// `P(p)` for `p > 0` and the coefficient `mu`.
    pub(super) fn at<D: DualNum<Primitive = f64> + Copy>(&self, mu: f64, p: D) -> D {
        match &self.form {
            Form::None => p,
            &Form::PowerLaw {
                exponent,
                pressure,
                floor,
            } => {
                if exponent < 1.0 && p.re() < floor {
                    let value = pressure * (floor / pressure).powf(exponent);
                    return from_zero(p / floor, value, exponent * value);
                }
                let x = p / pressure;
                if x.re() < VANISHING {
                    return D::zero();
                }
                (x.ln() * exponent).exp() * pressure
            }
            &Form::Adhesion { pressure, floor } => {
                if p.re() < floor {
                    from_zero(p / floor, floor + pressure, floor)
                } else {
                    p + pressure
                }
            }
            &Form::Saturation { shear_stress } => {
                if mu == 0.0 {
                    return p;
                }
                tanh(p * (mu / shear_stress)) * (shear_stress / mu)
            }
            Form::Table(table) => table.at(p) * p,
        }
    }
}

/// The hyperbolic tangent, for arguments of any size: hyperbolic functions overflow, and their
/// quotients with them.
fn tanh<D: DualNum<Primitive = f64> + Copy>(x: D) -> D {
    if x.re() < 0.0 {
        return -tanh(-x);
    }
    let e = (x * -2.0).exp_m1();
    -e / (e + 2.0)
}

impl fmt::Display for PressureDependence {
    /// The formula of `P` with its constants.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.form {
            Form::None => write!(f, "p"),
            Form::PowerLaw {
                exponent,
                pressure,
                floor,
            } => {
                write!(f, "{pressure} (p/{pressure})^{exponent}")?;
                match *exponent < 1.0 {
                    true => write!(f, ", a parabola below p = {floor}"),
                    false => Ok(()),
                }
            }
            Form::Adhesion { pressure, floor } => {
                write!(f, "p + {pressure}, a parabola below p = {floor}")
            }
            Form::Saturation { shear_stress } => {
                write!(f, "({shear_stress}/mu) tanh(mu p/{shear_stress})")
            }
            Form::Table(table) => write!(f, "p times {table}"),
        }
    }
}

/// The parabola over `x` that is zero at 0, and at 1 has a value and a slope.
fn from_zero<D: DualNum<Primitive = f64> + Copy>(x: D, value: f64, slope: f64) -> D {
    (x * (slope - value) + (2.0 * value - slope)) * x
}
