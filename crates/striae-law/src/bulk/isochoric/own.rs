//! Isochoric energies beside those of the crate.

use super::Invariant;
use serde::{Serialize, Serializer};
use std::fmt;
use std::sync::Arc;

/// An isochoric energy of invariants, for [`Isochoric::own`](super::Isochoric::own).
///
/// Energy is all that is stated; stress and tangent follow by dual numbers. The description by
/// [`fmt::Debug`] tells all constants, as laws of the same description are the same to checkpoints.
pub trait IsochoricLaw: fmt::Debug + Send + Sync {
    /// The name of the law in messages and figures.
    fn name(&self) -> &str;

    /// The shear modulus `G` at rest, `2 (dW/dI1 + dW/dI2)`.
    fn shear(&self) -> f64;

    /// `W_iso` of the invariants of the isochoric deformation, both of which are 3 at rest, where
    /// the energy is 0.
    fn energy(&self, i1: Invariant, i2: Invariant) -> Invariant;

    /// The value of `I1 - 3` at which the law ends, if there is one.
    fn limit(&self) -> Option<f64> {
        None
    }
}

/// A shared isochoric energy; equal to others of the same description.
#[derive(Clone, Debug)]
pub struct OwnIsochoric(Arc<dyn IsochoricLaw>);

impl OwnIsochoric {
    pub(super) fn new(law: impl IsochoricLaw + 'static) -> Self {
        Self(Arc::new(law))
    }

    /// The law.
    pub fn law(&self) -> &dyn IsochoricLaw {
        &*self.0
    }
}

/// Written as its own description.
impl Serialize for OwnIsochoric {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(&format_args!("{:?}", self.0))
    }
}

impl PartialEq for OwnIsochoric {
    fn eq(&self, other: &Self) -> bool {
        format!("{:?}", self.0) == format!("{:?}", other.0)
    }
}
