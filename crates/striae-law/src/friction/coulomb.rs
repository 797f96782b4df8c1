//! Isotropic Coulomb friction.
//!
//! ```text
//! |tau| <= mu p ,   tau = -mu p d while slipping
//! ```
//!
//! that is the kernel `L = K = I`, `eta = 0` with `varpi = mu p`. Admissible for
//! `mu >= 0`. Source: any textbook, e.g. Wriggers, *Computational Contact
//! Mechanics* (2006), chapter 4.

use super::ellipse::Ellipse;
use super::kernel::Kernel;
use super::slip_sample::SlipRule;
use num_dual::DualNum;

/// `L = K = I`, `eta = 0`.
pub(super) fn kernel<D: DualNum<Primitive = f64> + Copy>() -> Kernel<'static, D> {
    Kernel::identity()
}

/// The unit circle.
pub(super) fn slip_surface() -> Ellipse {
    Ellipse::new(1.0, 1.0, 0.0, SlipRule::Opposing)
}
