//! Friction from coefficients measured at many angles to the texture.
//!
//! Exactly one of the two surfaces carries the texture `a`. `phi` is the direction in
//! which the textured surface slips relative to the other one: its angle from `a`,
//! counter-clockwise as seen from outside the textured surface. So 0 is against a
//! nap, a half turn with it, and at a quarter turn either way slip follows the grooves
//! `-s` and `s`. With the largest coefficient `mu` of the table as scale, `varpi = mu p`,
//!
//! ```text
//! -tau = z ,   |z| <= varpi rho(phi) ,   rho(phi) = mu(phi)/mu ,   du parallel to z on the rim
//! -tau = mu(phi) p d    while slipping
//! ```
//!
//! with `phi` the direction of `z` and `mu(phi)` the monotone periodic cubic through the table.
//! Friction opposes slip in all directions: a table of coefficients states the magnitude of
//! friction only, without a force across slip. The slip surface is the table itself as a polar
//! curve, star-shaped and convex or not.
//!
//! Source: star-shaped slip surfaces as measured and used by Walker & Leine (2019),
//! "Set-valued anisotropic dry friction laws: formulation, experimental verification
//! and instability phenomenon", Nonlinear Dyn. 96, 885-920,
//! doi:10.1007/s11071-019-04829-6; with Coulomb's slip rule instead of theirs, which
//! asks for a second curve.
//!
//! # Admissible tables
//!
//! Slip dissipates `mu(phi) p |du|`. The interpolant stays within the least and the
//! largest coefficient, so positive ones suffice.
//!
//! # Derivative
//!
//! With `r = z/|z|` and `t` a quarter turn from it, towards which `phi` grows,
//!
//! ```text
//! drho = rho'(phi) (t . dz)/|z| ,    z /= 0 .
//! ```
//!
//! Only rows of slip ask for it. The traction itself is linear in `z`: with the circle
//! `|z| <= varpi` and `-tau = rho(phi) z` instead, a node that sticks with little friction
//! has a traction that bends with the direction of `z`, and Newton's method turns `z` around
//! without end.

use nalgebra::Vector3;
use num_dual::DualNum;
use serde::Serialize;

use super::basis::Basis;
use super::coefficient::Coefficient;
use super::error::{FrictionError, finite};
use super::periodic::Periodic;
use super::star::Star;
use super::{Friction, Law};
use striae_declared::{ANY, Declared, NO_UNIT, POSITIVE, Parameter, Value, Values, degrees};

/// The law.
pub static TABULATED: Declared<Friction> = Declared {
    name: "tabulated",
    summary: "One textured surface with coefficients measured at many angles; friction opposes \
              slip.",
    parameters: &[
        Parameter::numbers(
            "angles",
            ANY,
            "degrees",
            "Directions in which the textured surface slips over the other one: angles from its \
             texture `a` (across the grooves, against a nap), counter-clockwise as seen from \
             outside it; at least three, ascending, less than a turn.",
        ),
        Parameter::numbers(
            "mu",
            POSITIVE,
            NO_UNIT,
            "Coefficient of friction at each angle; monotone and smooth between them.",
        ),
    ],
    build: |values| {
        let angles = values.numbers("angles").iter();
        let angles: Vec<f64> = angles.map(|angle| angle.to_radians()).collect();
        let mu = values.numbers("mu");
        let law = Tabulated::new(&angles, mu)?;
        let largest = mu.iter().copied().fold(0.0, f64::max);
        Ok(Friction::new(
            Law::Tabulated(law),
            Coefficient::constant(largest)?,
        ))
    },
    fit: Some(Basis::Table {
        angles: "angles",
        coefficients: "mu",
    }),
};

impl Friction {
    /// One textured surface with the coefficients of friction `mu` for slip at `angles`
    /// (radians) from its texture; see [`Tabulated`]. The coefficient of the result is
    /// the largest one.
    ///
    /// # Errors
    /// When there are fewer than three angles or not as many coefficients, the angles do
    /// not ascend or go around, or a coefficient is not positive.
    pub fn tabulated(angles: &[f64], mu: &[f64]) -> Result<Self, FrictionError> {
        let angles: Vec<f64> = angles.iter().map(|angle| degrees(*angle)).collect();
        let angles = ("angles", Value::from(angles));
        TABULATED.made(&Values::from_iter([angles, ("mu", Value::from(mu))]))
    }
}

/// Coefficients over the largest one, as a function of the angle.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Tabulated {
    rho: Periodic,
}

/// `rho(phi)` at a contact point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Radial<'a, D> {
    law: &'a Tabulated,
    /// Axes from which and towards which `phi` turns.
    axes: [Vector3<D>; 2],
}

/// Fewest angles of a table.
const LEAST: usize = 3;
/// Difference below which two angles are the same, in radians.
const SAME: f64 = 1e-9;

impl Tabulated {
    /// The coefficients `mu` at `angles` (radians), which ascend and span less than a turn.
    ///
    /// # Errors
    /// When there are fewer than three angles or not as many coefficients, the angles do
    /// not ascend or go around, or a coefficient is not positive.
    pub fn new(angles: &[f64], mu: &[f64]) -> Result<Self, FrictionError> {
        check(angles, mu)?;
        let largest = mu.iter().copied().fold(0.0, f64::max);
        let shares: Vec<f64> = mu.iter().map(|mu| mu / largest).collect();
        let rho = Periodic::through(angles, &shares);
        Ok(Self { rho })
    }

    /// The slip surface in the same axes.
    pub fn slip_surface(&self) -> Star {
        Star::new(self.rho.clone())
    }
}

impl<'a, D: DualNum<Primitive = f64> + Copy> Radial<'a, D> {
    /// Kernel of a table, with the axes from which and towards which `phi` rotates.
    pub(super) fn new(law: &'a Tabulated, axes: [Vector3<D>; 2]) -> Self {
        Self { law, axes }
    }

    /// `rho(phi)` in the direction of `z`; without derivatives at `z = 0`.
    ///
    /// The angle is that of the value of `z`, to which its variation adds
    /// `t . dz/|z|`; quotients of components would not do where one vanishes.
    pub(super) fn reach(&self, z: &Vector3<D>) -> D {
        let [x, y] = self.axes.map(|axis| axis.dot(z));
        let length = x.re().hypot(y.re());
        if length < f64::MIN_POSITIVE.sqrt() {
            return self.law.rho.at(D::zero());
        }
        let (cosine, sine) = (x.re() / length, y.re() / length);
        let (along, across) = (x * cosine + y * sine, y * cosine - x * sine);
        let phi = (across / along).atan() + sine.atan2(cosine);
        self.law.rho.at(phi)
    }
}

fn check(angles: &[f64], mu: &[f64]) -> Result<(), FrictionError> {
    if angles.len() != mu.len() {
        return Err(FrictionError::TableLengths {
            angles: angles.len(),
            coefficients: mu.len(),
        });
    }
    if angles.len() < LEAST {
        return Err(FrictionError::TableShort {
            angles: angles.len(),
            least: LEAST,
        });
    }
    for (angle, mu) in angles.iter().zip(mu) {
        finite("angle", *angle)?;
        if !(mu.is_finite() && *mu > 0.0) {
            return Err(FrictionError::TableCoefficient {
                mu: *mu,
                degrees: angle.to_degrees(),
            });
        }
    }
    for pair in angles.windows(2) {
        if pair[1] - pair[0] < SAME {
            return Err(FrictionError::TableOrder {
                degrees: pair[1].to_degrees(),
                before: pair[0].to_degrees(),
            });
        }
    }
    let (first, last) = (angles[0], angles[angles.len() - 1]);
    if first + std::f64::consts::TAU - last < SAME {
        return Err(FrictionError::TableSeam {
            first: first.to_degrees(),
            last: last.to_degrees(),
        });
    }
    Ok(())
}
