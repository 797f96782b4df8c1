//! Errors in the constants of a friction law.

use thiserror::Error;

/// Reason why a law has no factor.
#[derive(Clone, Debug, PartialEq, Error)]
#[error("factor of friction `{law}`: {cause}")]
pub struct FactorFailure {
    /// Name of the law.
    pub law: String,
    /// Cause, in words.
    pub cause: String,
}

/// A friction law whose constants are refused.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum FrictionError {
    /// A constant lies outside its range.
    #[error("{name} = {value} is refused: it must be {expected}")]
    Constant {
        /// Name of the constant.
        name: &'static str,
        /// Its value.
        value: f64,
        /// Requirement on the value, to complete "it must be ...".
        expected: &'static str,
    },
    /// Friction between two textured surfaces would create energy.
    #[error(
        "friction would create energy: textures with a_a . a_b' = I0 = {i0:.6} and slip with \
         a_ba . d = I1 = {i1:.6} give a dissipation -tau . d / varpi = {dissipation:.6}"
    )]
    CreatesEnergy {
        /// Cosine of the angle between the textures.
        i0: f64,
        /// Slip direction, `a_ba . d`.
        i1: f64,
        /// Dissipation over `varpi |du|`, zero or negative.
        dissipation: f64,
    },
    /// Friction on one textured surface would create energy.
    #[error(
        "friction would create energy: slip at {degrees:.3} degrees from the texture `a` gives a \
         dissipation -tau . d / p = {dissipation:.6}"
    )]
    CreatesEnergyAlong {
        /// Angle of slip from the texture, in degrees.
        degrees: f64,
        /// Dissipation over `p |du|`, zero or negative.
        dissipation: f64,
    },
    /// Friction by a law from outside would create energy.
    #[error(
        "friction would create energy: at {theta:.3} degrees between the textures, slip at \
         {degrees:.3} degrees from them gives a dissipation -tau . d / varpi = {dissipation:.6}"
    )]
    CreatesEnergyAt {
        /// Angle between the textures, in degrees; 0 where there are not two.
        theta: f64,
        /// Angle of slip from the texture or the bisector of the two, in degrees.
        degrees: f64,
        /// Dissipation over `varpi |du|`, zero or negative.
        dissipation: f64,
    },
    /// A factor of one's own is not sound.
    #[error(transparent)]
    Factor(#[from] FactorFailure),
    /// A factor of one's own and the law need textures of different surfaces.
    #[error(
        "factor `{factor}` and law `{law}` need textures of different surfaces, one of them of both \
         and the other of one alone"
    )]
    FactorTextures {
        /// Name of the factor.
        factor: String,
        /// Name of the law.
        law: String,
    },
    /// The forces of a law from outside do not surround the origin.
    #[error(
        "law `{law}` has no slip surface at {theta:.3} degrees between the textures: `L` must be \
         regular in the tangent plane and `|L^-1 eta|` below 1"
    )]
    NoSlipSurface {
        /// Name of the law.
        law: String,
        /// Angle between the textures, in degrees.
        theta: f64,
    },
    /// A table has not one coefficient an angle.
    #[error(
        "the table has angles: {angles}, but coefficients: {coefficients}; each angle needs one"
    )]
    TableLengths {
        /// Number of angles.
        angles: usize,
        /// Number of coefficients.
        coefficients: usize,
    },
    /// A table has too few angles.
    #[error("a table with angles: {angles} is refused: it must have at least {least}")]
    TableShort {
        /// Number of angles.
        angles: usize,
        /// Fewest angles.
        least: usize,
    },
    /// A coefficient of a table is not positive.
    #[error(
        "mu = {mu} at the angle {degrees:.3} degrees is refused: it must be positive and finite, otherwise friction would create energy or vanish there"
    )]
    TableCoefficient {
        /// The coefficient.
        mu: f64,
        /// Its angle, in degrees.
        degrees: f64,
    },
    /// The angles of a table do not ascend.
    #[error(
        "the angle {degrees:.3} degrees after {before:.3} degrees is refused: the angles of a \
         table must ascend"
    )]
    TableOrder {
        /// The angle, in degrees.
        degrees: f64,
        /// The one before it, in degrees.
        before: f64,
    },
    /// The angles of a table go around.
    #[error(
        "angles from {first:.3} to {last:.3} degrees are refused: they must span less than a turn, \
         after which the table repeats"
    )]
    TableSeam {
        /// The first angle, in degrees.
        first: f64,
        /// The last one, in degrees.
        last: f64,
    },
    /// A table of factors is too short, or has not one factor a place.
    #[error(
        "the table has {of_places}: {places}, but {of_values}: {values}; it needs equally many of both, at least two"
    )]
    FactorLengths {
        /// Name of the places.
        of_places: &'static str,
        /// Their number.
        places: usize,
        /// Name of the values.
        of_values: &'static str,
        /// Their number.
        values: usize,
    },
    /// The places of a table of factors do not ascend.
    #[error("{of_places}: {place} after {before} is refused: they must ascend")]
    FactorOrder {
        /// Name of the places.
        of_places: &'static str,
        /// A place.
        place: f64,
        /// The one before it.
        before: f64,
    },
    /// Friction that falls with the logarithm of the slip rate vanishes.
    #[error(
        "factor = {factor} lets friction vanish at the slip rate {rate:.6}: a factor below zero \
         needs a limit below that rate, from which on friction is constant"
    )]
    LogarithmVanishes {
        /// The factor.
        factor: f64,
        /// Slip rate at which friction vanishes.
        rate: f64,
    },
}

/// Accepts a finite value that is positive.
pub(super) fn positive(name: &'static str, value: f64) -> Result<f64, FrictionError> {
    within(name, value, "positive and finite", value > 0.0)
}

/// Accepts a finite value that is not negative.
pub(super) fn not_negative(name: &'static str, value: f64) -> Result<f64, FrictionError> {
    within(name, value, "zero or positive, and finite", value >= 0.0)
}

/// Accepts a finite value.
pub(super) fn finite(name: &'static str, value: f64) -> Result<f64, FrictionError> {
    within(name, value, "finite", true)
}

pub(super) fn within(
    name: &'static str,
    value: f64,
    expected: &'static str,
    inside: bool,
) -> Result<f64, FrictionError> {
    if inside && value.is_finite() {
        Ok(value)
    } else {
        Err(FrictionError::Constant {
            name,
            value,
            expected,
        })
    }
}
