//! Bulk laws from outside the crate.

use serde::{Serialize, Serializer};
use std::fmt;
use std::sync::Arc;

use super::{Field, LameConstants, Past, Present, Response, ResponseError};
use nalgebra::Matrix3;

/// A user-defined law, for [`Material::own`](super::Material::own).
///
/// The solver takes energy, stress and tangent as they are given: Newton's method
/// converges quadratically only if the tangent is the derivative of the stress, and the
/// balance of energies holds only if the stress is that of the energy. A law with a memory
/// also has [`variables`](Self::variables) and [`respond`](Self::respond).
/// [`battery`](super::battery) finds out.
pub trait BulkLaw: fmt::Debug + Send + Sync {
    /// The name of the law in messages and summaries.
    fn name(&self) -> &str;

    /// Energy, first Piola-Kirchhoff stress and tangent at the deformation gradient `F`; of a
    /// law with a memory what a point at rest answers at once.
    ///
    /// # Errors
    ///
    /// A deformation the law does not allow; the increment is then cut back.
    fn response(&self, deformation_gradient: &Matrix3<f64>) -> Result<Response, ResponseError>;

    /// Number of internal variables of a point; all are zero at rest.
    fn variables(&self) -> usize {
        0
    }

    /// The response after what a point has been through. The tangent is the derivative of
    /// the stress with that held.
    ///
    /// # Errors
    ///
    /// As [`response`](Self::response).
    fn respond(
        &self,
        deformation_gradient: &Matrix3<f64>,
        _past: Past,
        _present: &mut Present,
    ) -> Result<Response, ResponseError> {
        self.response(deformation_gradient)
    }

    /// Variables that are written with the results.
    fn fields(&self) -> Vec<Field> {
        Vec::new()
    }

    /// The Lame constants of the small-strain limit, from which the solver takes the
    /// scale of stiffness.
    fn lame_constants(&self) -> LameConstants;
}

/// A shared user-defined law; equal to itself only.
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

/// Written as its own description.
impl Serialize for Own {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(&format_args!("{:?}", self.0))
    }
}

impl PartialEq for Own {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}
