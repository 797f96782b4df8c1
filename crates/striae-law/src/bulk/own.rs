//! Bulk laws from outside the crate.

use std::fmt;
use std::sync::Arc;

use super::{LameConstants, Response, ResponseError};
use nalgebra::Matrix3;

/// An elastic law of one's own, for [`Material::own`](super::Material::own).
///
/// The solver takes energy, stress and tangent as they are given: Newton's method
/// converges quadratically only if the tangent is the derivative of the stress, and the
/// balance of energies holds only if the stress is that of the energy.
/// [`battery`](super::battery) finds out.
pub trait BulkLaw: fmt::Debug + Send + Sync {
    /// The name of the law in messages and summaries.
    fn name(&self) -> &str;

    /// Energy, first Piola-Kirchhoff stress and tangent at the deformation gradient `F`.
    ///
    /// # Errors
    ///
    /// A deformation the law does not allow; the increment is then cut back.
    fn response(&self, deformation_gradient: &Matrix3<f64>) -> Result<Response, ResponseError>;

    /// The Lame constants of the small-strain limit, from which the solver takes the
    /// scale of stiffness.
    fn lame_constants(&self) -> LameConstants;
}

/// A shared law of one's own; equal to itself only.
#[derive(Clone, Debug)]
pub struct Own(Arc<dyn BulkLaw>);

impl Own {
    pub(super) fn new(law: impl BulkLaw + 'static) -> Self {
        Self(Arc::new(law))
    }

    /// The law.
    pub fn law(&self) -> &dyn BulkLaw {
        &*self.0
    }
}

impl PartialEq for Own {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}
