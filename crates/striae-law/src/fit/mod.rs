//! Constants of friction laws from measured friction, by least squares.
//!
//! A [`Reading`] is friction over pressure, `w = -tau/p`, in one direction of slip `d`: the
//! part of it that opposes slip, `w . d`, and, where the tester measures it, the part across
//! slip. In the frame `(e, e_perp)` of the law (the texture `a` of the only textured
//! surface, or the bisector of `a_a` and `a_b'`), every law that can be fitted states itself as
//!
//! ```text
//! w(d) = sum_k q_k w_k(d) ,
//! ```
//!
//! with parameters `q` that are its constants, or from which they follow as quotients
//! (two textures: `q = mu (1, c_mag, c_ang, c_ang c_cen)`). The parameters minimise
//!
//! ```text
//! sum_i [(w_i . d_i - w(d_i) . d_i)^2 + (across slip likewise)] / spread_i^2
//! subject to   w(d) . d >= m   for all d ,     m = 0.001 of the mean friction,
//! ```
//!
//! a convex problem, for dissipation is linear in `q`. So the law that is found is the
//! closest one that creates no energy; no start values are needed. Only orthotropic friction
//! with associated slip has `w_k` that depend on `q`, of degree zero; there the iteration
//! `q <- argmin` with the last `w_k` is the Gauss-Newton method. Of others it ends at once.
//!
//! # Confidence
//!
//! Readings are taken as independent and normal, with standard deviations in the proportion of
//! their `spread`. With `n` numbers, `k` parameters and the least sum of squares `S`,
//!
//! ```text
//! s^2 = S/(n - k) ,   cov q = s^2 (J^T W J)^-1 ,   q_k +- t sqrt(cov_kk) ,
//! ```
//!
//! with Student's `t` for `n - k` degrees of freedom at the level asked for: exact where the
//! law is linear in its constants. Readings of several specimens are independent from specimen
//! to specimen only; then the scatter between specimens gives the intervals, see
//! [`Fit::specimens`]. Quotients have Fieller's interval (1954, "Some problems in
//! interval estimation", J. R. Stat. Soc. B 16, 175-185), exact too, and without end where
//! the divisor may be zero. Each interval is about one constant; for all `k` together ask for
//! the level `1 - (1 - level)/k` (Bonferroni). There are none without degrees of freedom, nor
//! where the bound on dissipation shapes the law: see [`Standing`].
//!
//! Angles are in radians, friction has no unit.

mod basis;
mod error;
mod least_squares;
mod range;
mod reading;
mod specimens;
mod student;
#[cfg(test)]
mod tests;

use std::fmt;

use nalgebra::{DMatrix, DVector, Vector2};

pub use error::FitError;
pub use range::{LARGEST_FRICTION, SPREADS};
pub use reading::Reading;

use crate::friction::{Basis, Direction, Friction, LAWS};
use basis::Shape;
use reading::mean_friction;
use specimens::Equations;
use striae_declared::{self as declared, Absent, Declared, Value, Values};

/// Least dissipation of a fitted law over the mean measured friction.
const LEAST_DISSIPATION: f64 = 1e-3;
/// Iterations of the Gauss-Newton method for laws whose basis depends on the parameters.
const ITERATIONS: usize = 200;
/// Change of the parameters, over their size, that ends it.
const SETTLED: f64 = 1e-14;

/// A law whose constants are sought.
#[derive(Clone, Debug)]
pub struct Sought {
    law: &'static Declared<Friction>,
    basis: &'static Basis,
    words: Values,
}

/// A law with the constants that were found.
#[derive(Clone, Debug)]
pub struct Fit {
    /// The law.
    pub friction: Friction,
    /// Its constants, in the order of the deck.
    pub constants: Vec<Constant>,
    /// Standard deviation `s` of a reading with the spread 1, where there are degrees of
    /// freedom.
    pub deviation: Option<f64>,
    /// Measured numbers less parameters.
    pub degrees_of_freedom: usize,
    /// The level of the intervals, such as 0.95.
    pub level: f64,
    /// Influences that shape the law.
    pub standing: Standing,
    /// The specimens, by number, where there are several. Their scatter gives the intervals,
    /// with one degree of freedom less than there are specimens.
    pub specimens: Vec<Specimen>,
}

/// A specimen beside the law that was fitted to all.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Specimen {
    /// Its number, see [`Reading::specimen`].
    pub number: usize,
    /// Factor by which its friction is that of the law, by least squares (no unit).
    pub factor: f64,
}

/// A constant of a law.
#[derive(Clone, Debug, PartialEq)]
pub struct Constant {
    /// Name of the constant.
    pub name: ConstantName,
    /// Its value.
    pub value: f64,
    /// The interval in which it lies with the probability asked for; its ends may be infinite.
    pub interval: Option<[f64; 2]>,
}

/// Name of a constant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ConstantName {
    /// The key of a deck.
    Key(&'static str),
    /// The coefficient of a table at an angle (radians).
    MuAt(f64),
}

impl fmt::Display for ConstantName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Key(key) => f.write_str(key),
            Self::MuAt(angle) => {
                write!(
                    f,
                    "mu at {} degrees",
                    (angle.to_degrees() * 1e9).round() / 1e9
                )
            }
        }
    }
}

/// Influences that shape a fitted law.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Standing {
    /// The measurements alone.
    Free,
    /// Also that friction must not create energy, as the law that is closest to the
    /// measurements would. The measurements are not those of such a law, or their
    /// directions are reversed.
    AtBound,
}

impl Sought {
    /// Returns a declared law, with the first of the words of each parameter that takes one;
    /// `None` where measurements do not give its constants.
    pub fn new(law: &'static Declared<Friction>) -> Option<Self> {
        let words = law.parameters.iter().filter_map(|one| match one.absent {
            Absent::Word(word) => Some((one.name, Value::Word(word))),
            _ => None,
        });
        Some(Self {
            law,
            basis: law.fit.as_ref()?,
            words: words.collect(),
        })
    }

    /// Returns the law by its name among those that are known, if it can be sought.
    pub fn named(name: &str) -> Option<Self> {
        declared::named(LAWS, name).and_then(Self::new)
    }

    /// Returns the law with another word of a parameter.
    pub fn with(self, name: &str, word: &'static str) -> Self {
        let words = self.words.iter().map(|(known, value)| match known == name {
            true => (known, Value::Word(word)),
            false => (known, value.clone()),
        });
        let words = words.collect();
        Self { words, ..self }
    }

    /// Returns the law that is sought.
    pub fn law(&self) -> &'static Declared<Friction> {
        self.law
    }

    /// Returns whether friction is the same in all directions, so that readings need no angles.
    pub fn is_isotropic(&self) -> bool {
        match self.basis {
            // One direction in which it dissipates stands for all.
            Basis::Sum(sum) => (sum.judged)().len() == 1,
            Basis::Table { .. } => false,
        }
    }

    /// Readings that determine the constants.
    fn needed(&self) -> &'static str {
        match self.basis {
            Basis::Sum(sum) => sum.needed,
            Basis::Table { .. } => "readings at three or more angles",
        }
    }
}

/// Finds the constants of a law, with their intervals at a level of confidence.
///
/// ```
/// use striae_law::fit::{fit, Reading, Sought};
///
/// let reading = |degrees: f64, mu| Reading::against(degrees.to_radians(), mu);
/// let readings = [reading(180.0, 0.11), reading(0.0, 0.15), reading(90.0, 0.19),
///     reading(180.0, 0.12), reading(0.0, 0.14), reading(-90.0, 0.21)];
/// let nap = Sought::named("nap").expect("the law has a fit");
/// let found = fit(&nap, &readings, 0.95)?;
/// assert!((found.constants[0].value - 0.115).abs() < 1e-12); // mu_forward
/// # Ok::<(), striae_law::fit::FitError>(())
/// ```
///
/// # Errors
/// When readings are not finite, out of range or do not oppose slip, or do not determine the
/// constants.
pub fn fit(sought: &Sought, readings: &[Reading], level: f64) -> Result<Fit, FitError> {
    if !(level > 0.0 && level < 1.0) {
        return Err(FitError::Level(level));
    }
    let mean = mean_friction(readings)?;
    let undetermined = || FitError::Undetermined {
        law: sought.law.name,
        needed: sought.needed(),
    };
    if readings.is_empty() {
        return Err(undetermined());
    }
    let shape = Shape::new(sought, readings);
    let (q, free, inverse) = parameters(&shape, readings, mean).ok_or_else(undetermined)?;
    let friction = shape.friction(&q)?;
    let equations = equations(&shape, readings, &q);
    let degrees_of_freedom = equations.measured.len() - q.len();
    let residual = equations.residuals(&q).norm_squared();
    let variance = (degrees_of_freedom > 0).then(|| residual / degrees_of_freedom as f64);
    let specimens = match specimens::numbers(readings) {
        one if one.len() < 2 => Vec::new(),
        several => several,
    };
    let spread = match (variance, free) {
        (Some(_), true) if !specimens.is_empty() => Some((
            equations.covariance(&q, &inverse, &specimens),
            student::two_sided(level, specimens.len() - 1),
        )),
        (Some(variance), true) => Some((
            inverse * variance,
            student::two_sided(level, degrees_of_freedom),
        )),
        _ => None,
    };
    let meanings = shape.constants().into_iter();
    let constants = meanings.map(|(name, meaning)| Constant {
        name,
        value: meaning.value(&q),
        interval: spread
            .as_ref()
            .map(|(covariance, t)| meaning.interval(&q, covariance, *t)),
    });
    Ok(Fit {
        friction,
        constants: constants.collect(),
        deviation: variance.map(f64::sqrt),
        degrees_of_freedom,
        level,
        standing: if free {
            Standing::Free
        } else {
            Standing::AtBound
        },
        specimens: equations.factors(&q, &specimens),
    })
}

/// The parameters, whether no bound holds them, and `(J^T W J)^-1`.
fn parameters(
    shape: &Shape<'_>,
    readings: &[Reading],
    mean: f64,
) -> Option<(DVector<f64>, bool, DMatrix<f64>)> {
    let least = LEAST_DISSIPATION * mean;
    let mut q = DVector::from_element(shape.count(), mean);
    let mut result = None;
    for _ in 0..ITERATIONS {
        let Equations { rows, measured, .. } = equations(shape, readings, &q);
        let bounds = bounds(shape, &q);
        let found = least_squares::least_squares(&rows, &measured, &bounds, least)?;
        let change = (&found.q - &q).norm();
        q.copy_from(&found.q);
        result = Some((found.q, found.free, found.inverse));
        if change <= SETTLED * q.norm() {
            break;
        }
    }
    result
}

/// Rows and right-hand sides, over the spread.
fn equations(shape: &Shape<'_>, readings: &[Reading], q: &DVector<f64>) -> Equations {
    let mut rows: Vec<f64> = Vec::new();
    let mut measured = Vec::new();
    let mut specimens = Vec::new();
    for (number, reading) in readings.iter().enumerate() {
        let (sine, cosine) = reading.slip.sin_cos();
        let direction = Direction::new(reading.theta, reading.slip);
        let basis = shape.basis(number, direction, q);
        let mut note = |direction: Vector2<f64>, value: f64| {
            rows.extend(basis.iter().map(|w| w.dot(&direction) / reading.spread));
            measured.push(value / reading.spread);
            specimens.push(reading.specimen);
        };
        note(Vector2::new(cosine, sine), reading.against);
        if let (Some(across), true) = (reading.across, shape.knows_across()) {
            note(Vector2::new(-sine, cosine), across);
        }
    }
    Equations {
        rows: DMatrix::from_row_slice(measured.len(), shape.count(), &rows),
        measured: DVector::from_vec(measured),
        specimens,
    }
}

/// Rows of the parameters that must not fall below the least dissipation.
fn bounds(shape: &Shape<'_>, q: &DVector<f64>) -> DMatrix<f64> {
    let rows = shape.judged();
    let mut bounds = DMatrix::zeros(rows.len(), shape.count());
    for (row, (node, direction)) in rows.into_iter().enumerate() {
        for (k, w) in shape.basis(node, direction, q).iter().enumerate() {
            bounds[(row, k)] = w.dot(&direction.d());
        }
    }
    bounds
}
