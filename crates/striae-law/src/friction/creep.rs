//! Friction of a surface that creeps: the rate at which friction and a stiffness share a traction.
//!
//! Friction that depends on rate and state has no threshold below which a surface sticks, and its
//! slope at rest is beyond all numbers. So rows of contact do not ask for friction at a rate, but
//! for the point of the curve at which it and a spring carry a length `|y|` together,
//!
//! ```text
//! rho varpi(v) + k v = |y| ,   varpi(v) = mu(v, theta(v)) W(s) P(p) .
//! ```
//!
//! The resolvent of the curve, `rho varpi` as a function of `|y|`, has slopes below 1, is nearly
//! `|y|` where the surface hardly creeps, and nearly constant where it slips. With
//! `k > -rho d varpi/dv` where friction falls there is one solution. It is found in `x = ln v` by
//! Newton's method between bounds; its derivatives follow from the equation,
//!
//! ```text
//! h dx = d|y| - varpi drho - rho varpi,p dp - v dk ,   h = rho varpi,x + k v .
//! ```

use nalgebra::Const;
use num_dual::{DualNum, DualSVec64};

use super::{Friction, RateAndState};

/// Sufficient number of iterations: bisection alone takes fewer from any bounds.
const LARGEST_ITERATIONS: usize = 200;

/// Stiffness over the one with which the solution is just unique.
const SURPLUS: f64 = 2.0;

/// History of a point of a surface up to an increment, and the time of the increment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Past {
    /// Accumulated slip.
    pub slip: f64,
    /// State `theta`.
    pub state: f64,
    /// Time of the increment, positive and finite.
    pub elapsed: f64,
}

/// Point of the curve of friction over the slip rate, with its derivatives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Creep {
    /// Slip rate `v`.
    pub slip_rate: f64,
    /// `rho varpi`.
    pub radius: f64,
    /// Derivative of the radius by `|y|`.
    pub by_length: f64,
    /// Derivative of the radius by the pressure.
    pub by_pressure: f64,
    /// Derivative of the radius by the reach `rho`.
    pub by_reach: f64,
    /// Derivative of the radius by the stiffness `k`.
    pub by_stiffness: f64,
}

impl Friction {
    /// Constants of rate and state, where friction depends on them.
    pub fn rate_and_state(&self) -> Option<&RateAndState> {
        let law = self.coefficient.by_state().constants();
        law.filter(|_| !self.is_frictionless())
    }

    /// Stiffness over `rho`, force per area and slip, with which the solution of [`Self::creep`]
    /// is unique at a pressure.
    pub fn creep_stiffness<D: DualNum<Primitive = f64> + Copy>(
        &self,
        past: Past,
        pressure: D,
    ) -> D {
        match self.rate_and_state() {
            Some(law) if pressure.re() > 0.0 => {
                let slope = law.largest_weakening(past.state, past.elapsed);
                self.coefficient.scaled(pressure, past.slip) * (SURPLUS * slope)
            }
            _ => D::zero(),
        }
    }

    /// `varpi` at the end of an increment, by the logarithm of the slip rate.
    ///
    /// # Panics
    /// When friction does not depend on rate and state.
    pub fn creeping_cap<D: DualNum<Primitive = f64> + Copy>(
        &self,
        past: Past,
        pressure: D,
        log_rate: D,
    ) -> D {
        if pressure.re() <= 0.0 {
            return D::zero();
        }
        let law = self.rate_and_state().expect("there is a state");
        let mu = law.after(
            self.coefficient.at_rest(),
            log_rate,
            past.state,
            past.elapsed,
        );
        self.capped(self.coefficient.scaled(pressure, past.slip) * mu)
    }

    /// The point of the curve that belongs to a length `|y|`, at a pressure, a reach `rho` and a
    /// stiffness `k`, force per area and slip rate.
    ///
    /// # Panics
    /// When friction does not depend on rate and state.
    pub fn creep(
        &self,
        past: Past,
        pressure: f64,
        reach: f64,
        stiffness: f64,
        length: f64,
    ) -> Creep {
        let freely = Creep {
            slip_rate: length / stiffness,
            radius: 0.0,
            by_length: 0.0,
            by_pressure: 0.0,
            by_reach: 0.0,
            by_stiffness: 0.0,
        };
        if pressure <= 0.0 || reach <= 0.0 {
            return freely;
        }
        if length <= 0.0 {
            // Next to rest the curve is steeper than any stiffness.
            return Creep {
                by_length: 1.0,
                ..freely
            };
        }
        let at = |x: f64| -> [f64; 3] {
            let x = DualSVec64::<2>::from_re(x).derivative(0);
            let pressure = DualSVec64::<2>::from_re(pressure).derivative(1);
            let varpi = self.creeping_cap(past, pressure, x);
            let slope = varpi.eps.unwrap_generic(Const::<2>, Const::<1>);
            [varpi.re, slope[0], slope[1]]
        };
        let x = solution(
            |x| {
                let [varpi, by_x, _] = at(x);
                let spring = stiffness * x.exp();
                [reach * varpi + spring - length, reach * by_x + spring]
            },
            (length / stiffness).ln(),
            length,
        );
        let [varpi, by_x, by_pressure] = at(x);
        let slip_rate = x.exp();
        let whole = reach * by_x + stiffness * slip_rate;
        let (sharing, rest) = match whole > 0.0 {
            true => (reach * by_x / whole, stiffness * slip_rate / whole),
            false => (1.0, 0.0),
        };
        Creep {
            slip_rate,
            radius: reach * varpi,
            by_length: sharing,
            by_pressure: rest * reach * by_pressure,
            by_reach: rest * varpi,
            by_stiffness: -sharing * slip_rate,
        }
    }
}

/// Zero of an ascending function, given with its slope, that is not negative at `high`; `scale`
/// is that of its values.
fn solution(function: impl Fn(f64) -> [f64; 2], mut high: f64, scale: f64) -> f64 {
    let (mut low, mut step) = (high - 1.0, 1.0);
    while function(low)[0] > 0.0 {
        high = low;
        step *= 2.0;
        low -= step;
    }
    let mut x = 0.5 * (low + high);
    for _ in 0..LARGEST_ITERATIONS {
        let [value, slope] = function(x);
        if value.abs() <= f64::EPSILON * scale {
            break;
        }
        match value > 0.0 {
            true => high = x,
            false => low = x,
        }
        let newton = x - value / slope;
        let next = match low < newton && newton < high {
            true => newton,
            false => 0.5 * (low + high),
        };
        if next == x {
            break;
        }
        x = next;
    }
    x
}
