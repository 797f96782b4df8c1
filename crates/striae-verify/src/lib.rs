//! Checks of derivatives, rates and closed forms; used by tests and by the
//! cases of the program.
//!
//! - [`closed_forms`]: contact of spheres and cylinders with and without friction;
//! - [`derivative`]: a claimed derivative is right when the error of a finite
//!   difference falls *at the right order* as the step is halved;
//! - [`rate`]: rates of convergence fitted to errors on refined meshes;
//! - [`random`]: reproducible vectors, matrices and rotations.

pub mod closed_forms;
pub mod derivative;
pub mod random;
pub mod rate;

pub use derivative::{Difference, WrongDerivative, assert_derivative, assert_directional};
pub use random::Random;
pub use rate::fitted_rate;
