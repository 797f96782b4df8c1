//! Stick and slip by predictor and corrector, as in Table 1 of the paper.
//!
//! A closed node has a label, its status, that decides which rows it states and
//! that changes between iterations only. With the turned slip `s = K^-1 du` and the
//! radius `rho = varpi/omega` of the inflated slip surface,
//!
//! ```text
//! stick: du = 0                                  the predictor of every increment
//! slip : z = rho y/|y|,   y = z + r_t s          radial return of the trial `y`
//!
//! stick -> slip   if |z| > (1 + tol_s) rho
//! slip  -> stick  if s . z < 0                   turn-around; its direction is forgotten
//! ```
//!
//! A node that just left stick has no slip yet, so its first return is along `z`.
//!
//! `0 < omega <= 1` keeps nodes from slipping under pressures that are far from
//! final: the slip surface is inflated as long as bodies penetrate,
//!
//! ```text
//! omega = max(0.2, 1/(1 + |g|/g_0)),
//! ```
//!
//! never falls within an increment and is 1 once the gap is closed. The return
//! is radial for every law; for a table `rho` is that of the direction of `z`
//! or `y`.
//!
//! Source: Jones & Papadopoulos (2006), Table 1 and equation (59), with `rho` for
//! the erroneous `omega varpi`. The paper's `tol_s` is read as an overshoot of
//! the slip surface relative to it, up to which a sticking node stays so.

use nalgebra::Vector2;

use crate::unknowns::Status;

/// Smallest `omega`.
const LEAST: f64 = 0.2;
/// Gap over the local size at which the inflation is over.
const CLOSED: f64 = 1e-6;

/// Inputs of the labels of an iteration besides the node.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Corrector {
    /// Overshoot `tol_s` of the slip surface at which a node leaves stick.
    pub stick_tolerance: f64,
    /// Inflation of the slip surface.
    pub inflation: Inflation,
}

/// Inflation of the slip surface while bodies penetrate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Inflation {
    omega: f64,
    first_gap: Option<f64>,
}

impl Default for Inflation {
    fn default() -> Self {
        Self {
            omega: LEAST,
            first_gap: None,
        }
    }
}

impl Inflation {
    /// The inflation of the iteration after one with the largest `gap`, over the local size.
    pub fn after(self, gap: f64) -> Self {
        let first_gap = self.first_gap.unwrap_or(gap);
        // The formula tends to one without reaching it, and no increment may be accepted before.
        let omega = if gap < CLOSED {
            1.0
        } else {
            // Never inflated again: friction that shrank and grew by turns would make labels cycle.
            (1.0 / (1.0 + gap / first_gap)).max(self.omega)
        };
        Self {
            omega,
            first_gap: Some(first_gap),
        }
    }

    /// Returns whether the slip surface is the true one again.
    pub fn is_over(self) -> bool {
        self.omega == 1.0
    }

    /// `1/omega`.
    pub fn factor(self) -> f64 {
        1.0 / self.omega
    }
}

impl Corrector {
    /// The status of a closed node that had the status `before`, with its `z`, its
    /// turned slip and the radius of the inflated slip surface.
    pub fn status(&self, before: Status, z: [f64; 2], turned: [f64; 2], radius: f64) -> Status {
        let (z, turned) = (Vector2::from(z), Vector2::from(turned));
        let slips = match before {
            // Friction opposes slip, so `z` and the slip it belongs to have to point the same way.
            Status::Slip => z.norm() > 0.0 && turned.dot(&z) >= 0.0,
            Status::Stick | Status::Open => z.norm() > (1.0 + self.stick_tolerance) * radius,
        };
        if slips { Status::Slip } else { Status::Stick }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn corrector() -> Corrector {
        Corrector {
            stick_tolerance: 0.1,
            inflation: Inflation::default(),
        }
    }

    #[test]
    fn a_node_leaves_stick_beyond_the_tolerance_only() {
        let status = |z: f64| corrector().status(Status::Stick, [0.0, z], [0.0; 2], 2.0);
        assert_eq!(status(2.19), Status::Stick);
        assert_eq!(status(2.21), Status::Slip);
        let touching = corrector().status(Status::Open, [1.0, 0.0], [0.0; 2], 2.0);
        assert_eq!(touching, Status::Stick);
    }

    #[test]
    fn a_node_that_turns_around_sticks() {
        let status = |s: [f64; 2]| corrector().status(Status::Slip, [1.0, 0.0], s, 1.0);
        assert_eq!(status([0.1, 5.0]), Status::Slip);
        assert_eq!(status([-0.1, 5.0]), Status::Stick);
        assert_eq!(status([0.0, 0.0]), Status::Slip);
    }

    #[test]
    fn the_inflation_never_grows_and_ends_when_the_gap_is_closed() {
        let mut inflation = Inflation::default();
        assert_eq!(inflation.factor(), 5.0);
        let mut last = inflation.factor();
        for gap in [1.0, 0.1, 0.5, 1e-3, 2e-6] {
            inflation = inflation.after(gap);
            assert!(inflation.factor() <= last && !inflation.is_over());
            last = inflation.factor();
        }
        assert!(inflation.after(1e-7).is_over());
        assert!(Inflation::default().after(0.0).is_over());
    }
}
