//! Factors of coefficients of friction that functions from outside the crate state.
//!
//! ```text
//! varpi = mu R(v) W(s) P(p) F ,   F = F(p, v, s, x, t, n, a, b, theta)
//! theta = U(theta_n, p, v, s, x, t, dt)
//! ```
//!
//! with pressure `p`, slip rate `v = |du|/dt` of the increment of the time `dt`, accumulated slip
//! `s` and position `x` at its start, time `t` at its end, unit normal `n`, textures `a` and `b` of
//! both surfaces as in [`Textures`], and state variables `theta` of the law's own. The state at the
//! end of the increment enters `F`, so friction is implicit in it; `U` integrates the state at the
//! rate of the increment.
//!
//! A [`FactorLaw`] states `F` and `U` at a point in dual numbers over `p`, `v`, `n`, `a` and `b`, a
//! [`FactorBatch`] both for many points at once with derivatives as numbers. Accumulated slip and
//! position are those up to the increment: they add nothing to the tangent, at the cost of an error
//! of first order in the increment.
//!
//! # Conditions
//!
//! Slip dissipates `varpi |du|` times what the law of the directions does, so `F >= 0` suffices.
//! Slopes by the slip rate must be finite at rest, as nodes that stick have rates of round-off.
//! `p F` must not fall as the pressure rises. Where friction falls with slip an increment has one
//! solution if the surroundings are stiffer, per area, than `-d varpi/d|du|`. `F` must be the same
//! seen from both surfaces. [`OwnFactor::new`] refuses negative factors, and
//! [`battery`](super::battery()) judges the rest.

mod points;
pub(super) mod samples;

use std::{any::Any, fmt, sync::Arc};

use nalgebra::Vector3;
use num_dual::DualSVec64;
use serde::{Serialize, Serializer};

use super::RequiredTextures;
use super::error::{FactorFailure, FrictionError};
use super::textures::Textures;

pub use points::FactorPoints;

/// First-order dual numbers over pressure, slip rate, normal and the textures of both surfaces.
pub type FactorLane = DualSVec64<11>;

/// Largest number of state variables of a law.
pub const LARGEST_STATE: usize = 8;

/// A point of a surface at the end of an increment.
#[derive(Clone, Copy, Debug)]
pub struct FactorPoint {
    /// Pressure, zero or compressive.
    pub pressure: FactorLane,
    /// Slip rate `|du|/dt`.
    pub slip_rate: FactorLane,
    /// Slip that the point has done up to the increment.
    pub accumulated_slip: f64,
    /// Position at the start of the increment.
    pub position: Vector3<f64>,
    /// Time at the end of the increment.
    pub time: f64,
    /// Duration of the increment.
    pub elapsed: f64,
    /// Unit normal of the surface that carries the point.
    pub normal: Vector3<FactorLane>,
    /// Textures; not known to [`FactorLaw::state_after`].
    pub textures: Textures<FactorLane>,
}

impl FactorPoint {
    /// Slip `|du|` of the increment.
    pub fn slip(&self) -> FactorLane {
        self.slip_rate * self.elapsed
    }
}

/// Largest values for which a law is made, from which the battery takes its samples.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FactorRange {
    /// Pressure.
    pub pressure: f64,
    /// Slip rate.
    pub slip_rate: f64,
    /// Accumulated slip.
    pub slip: f64,
    /// Components of positions.
    pub position: f64,
    /// Time.
    pub time: f64,
    /// Duration of an increment.
    pub elapsed: f64,
}

impl Default for FactorRange {
    /// One unit of everything.
    fn default() -> Self {
        Self {
            pressure: 1.0,
            slip_rate: 1.0,
            slip: 1.0,
            position: 1.0,
            time: 1.0,
            elapsed: 1.0,
        }
    }
}

/// A factor of all coefficients at a point, for [`OwnFactor::new`].
///
/// ```
/// use striae_law::friction::{
///     DualNum, FactorLane, FactorLaw, FactorPoint, FactorRange, Friction, OwnFactor, battery,
/// };
///
/// /// Friction that falls to a half as a film of the thickness `theta` builds up with slip.
/// #[derive(Debug)]
/// struct Film;
///
/// impl FactorLaw for Film {
///     fn name(&self) -> &str {
///         "film"
///     }
///
///     fn range(&self) -> FactorRange {
///         FactorRange { pressure: 1e6, slip_rate: 0.1, ..FactorRange::default() }
///     }
///
///     fn initial_state(&self) -> Vec<f64> {
///         vec![0.0]
///     }
///
///     fn state_after(&self, at: &FactorPoint, before: &[f64]) -> Vec<FactorLane> {
///         // d theta/d s = (1 - theta)/0.02, integrated exactly.
///         vec![(-at.slip() / 0.02).exp() * (before[0] - 1.0) + 1.0]
///     }
///
///     fn factor(&self, _: &FactorPoint, state: &[FactorLane]) -> FactorLane {
///         state[0] * -0.5 + 1.0
///     }
/// }
///
/// let friction = Friction::coulomb(0.4)?.with_factor(OwnFactor::of(Film)?)?;
/// assert_eq!(battery(&friction), []);
/// # Ok::<(), striae_law::friction::FrictionError>(())
/// ```
pub trait FactorLaw: fmt::Debug + Send + Sync {
    /// Name of the law in messages; states of one name continue where the law changes.
    fn name(&self) -> &str;

    /// Values up to which the law is judged.
    fn range(&self) -> FactorRange;

    /// Surfaces whose textures the law needs; by default none.
    fn required_textures(&self) -> RequiredTextures {
        RequiredTextures::Any
    }

    /// State at the start, at most [`LARGEST_STATE`] numbers; none by default.
    fn initial_state(&self) -> Vec<f64> {
        Vec::new()
    }

    /// State at the end of an increment.
    fn state_after(&self, _at: &FactorPoint, _before: &[f64]) -> Vec<FactorLane> {
        Vec::new()
    }

    /// Factor with the state at the end of the increment.
    fn factor(&self, at: &FactorPoint, state: &[FactorLane]) -> FactorLane;
}

/// A factor of all coefficients at many points at once.
pub trait FactorBatch: fmt::Debug + Send + Sync {
    /// Name of the law in messages; states of one name continue where the law changes.
    fn name(&self) -> &str;

    /// Values up to which the law is judged.
    fn range(&self) -> FactorRange;

    /// Surfaces whose textures the law needs.
    fn required_textures(&self) -> RequiredTextures {
        RequiredTextures::Any
    }

    /// State at the start.
    fn initial_state(&self) -> Vec<f64>;

    /// Factors at the end of the increment, from the states at its start.
    ///
    /// # Errors
    /// When the law has failed.
    fn factors(&self, points: &FactorPoints) -> Result<Vec<Factor>, FactorFailure>;

    /// States at the end of the increment, one point after the other.
    ///
    /// # Errors
    /// When the law has failed.
    fn states_after(&self, points: &FactorPoints) -> Result<Vec<f64>, FactorFailure>;

    /// The law itself, where it is to be found again in models.
    fn as_any(&self) -> Option<&dyn Any> {
        None
    }

    /// Slip rate in increments of a duration at which friction is taken to have fallen most.
    fn fast(&self, _elapsed: f64) -> f64 {
        self.range().slip_rate
    }
}

/// A factor with its derivatives, the state at the end of the increment included.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Factor {
    /// `F`.
    pub value: f64,
    /// Derivative by the pressure.
    pub by_pressure: f64,
    /// Derivative by the slip rate.
    pub by_slip_rate: f64,
    /// Derivatives by normal, own and opposite texture.
    pub by_surroundings: [f64; 9],
}

impl Factor {
    /// From a dual number.
    pub fn from_lane(lane: FactorLane) -> Self {
        let slopes = lane
            .eps
            .unwrap_generic(nalgebra::Const::<11>, nalgebra::Const::<1>);
        Self {
            value: lane.re,
            by_pressure: slopes[0],
            by_slip_rate: slopes[1],
            by_surroundings: std::array::from_fn(|at| slopes[2 + at]),
        }
    }

    fn is_sound(&self) -> bool {
        let slopes = [self.by_pressure, self.by_slip_rate];
        let all = slopes.iter().chain(&self.by_surroundings);
        self.value >= 0.0 && self.value.is_finite() && all.copied().all(f64::is_finite)
    }
}

/// A shared factor of one's own; equal to itself only.
#[derive(Clone, Debug)]
pub struct OwnFactor {
    law: Arc<dyn FactorBatch>,
    course: Course,
}

/// Course of a factor with the slip rate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Course {
    /// `true` if it depends on the slip rate, or on the slip of the increment.
    pub(super) goes_with_rate: bool,
    /// `true` if it falls anywhere as the rate rises.
    pub(super) falls: bool,
    /// Largest factor over that at rest.
    pub(super) largest_over_rest: f64,
    /// Largest `-dF/d|du|` that was found.
    pub(super) steepest: f64,
}

/// Written as its own description.
impl Serialize for OwnFactor {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(&format_args!("{:?}", self.law))
    }
}

impl PartialEq for OwnFactor {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.law, &other.law)
    }
}

impl OwnFactor {
    /// Shares a law that is stated at a point.
    ///
    /// # Errors
    /// When a factor is negative or not finite within the range of the law, or the law has too
    /// many state variables.
    pub fn of(law: impl FactorLaw + 'static) -> Result<Self, FrictionError> {
        Self::new(PointWise(law))
    }

    /// Shares a law that is stated for many points at once.
    ///
    /// # Errors
    /// When a factor is negative or not finite within the range of the law, the law fails, or it
    /// has too many state variables.
    pub fn new(law: impl FactorBatch + 'static) -> Result<Self, FrictionError> {
        let course = samples::course(&law)?;
        let law = Arc::new(law);
        Ok(Self { law, course })
    }

    /// The law.
    pub fn law(&self) -> &dyn FactorBatch {
        &*self.law
    }

    /// Course with the slip rate.
    pub(super) fn course(&self) -> Course {
        self.course
    }

    /// Largest slope `-dF/d|du|` by which the factor falls with the slip of an increment, as found
    /// in samples over its range.
    pub fn steepest_fall(&self) -> f64 {
        self.course.steepest
    }
}

/// Factors of a law, refused where they are not sound.
pub(super) fn sound_factors(
    law: &dyn FactorBatch,
    points: &FactorPoints,
) -> Result<Vec<Factor>, FactorFailure> {
    let failed = |cause: String| FactorFailure {
        law: law.name().to_owned(),
        cause,
    };
    let found = law.factors(points)?;
    if found.len() != points.len() {
        let cause = format!("{} values for {} points", found.len(), points.len());
        return Err(failed(cause));
    }
    match found.iter().position(|factor| !factor.is_sound()) {
        None => Ok(found),
        Some(at) => Err(failed(format!(
            "it is {} at {}, but must be finite, with finite derivatives, and zero or positive, so \
             that friction creates no energy",
            found[at].value,
            points.told(at)
        ))),
    }
}

/// A law at points as one for many.
#[derive(Debug)]
pub(super) struct PointWise<T>(pub(super) T);

impl<T: FactorLaw> PointWise<T> {
    fn state(&self, points: &FactorPoints, at: usize) -> (FactorPoint, Vec<FactorLane>) {
        let point = points.point(at);
        let bare = FactorPoint {
            textures: Textures::none(),
            ..point
        };
        let state = self.0.state_after(&bare, points.state(at));
        (point, state)
    }
}

impl<T: FactorLaw> FactorBatch for PointWise<T> {
    fn name(&self) -> &str {
        self.0.name()
    }

    fn range(&self) -> FactorRange {
        self.0.range()
    }

    fn required_textures(&self) -> RequiredTextures {
        self.0.required_textures()
    }

    fn initial_state(&self) -> Vec<f64> {
        self.0.initial_state()
    }

    fn factors(&self, points: &FactorPoints) -> Result<Vec<Factor>, FactorFailure> {
        let of = |at: usize| {
            let (point, state) = self.state(points, at);
            Factor::from_lane(self.0.factor(&point, &state))
        };
        Ok((0..points.len()).map(of).collect())
    }

    fn states_after(&self, points: &FactorPoints) -> Result<Vec<f64>, FactorFailure> {
        let of = |at: usize| self.state(points, at).1;
        let states = (0..points.len()).flat_map(of);
        Ok(states.map(|lane| lane.re).collect())
    }
}
